#pragma once
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "common/toml_reader.hpp"
#include "experiments/recipe.hpp"
#include "figures/fits.hpp"
#include "figures/ratios.hpp"
#include "figures/sweep_curves.hpp"
#include "figures/table_source.hpp"

namespace chute::figures {

/// How a run's files become rows of the figure's table.
enum class Extract {
  histogram,   ///< of one column of the impacts; density with integral 1, x = middle of the bin
  return_map,  ///< a column of the impacts against the same of the impact before, grain by grain
  scatter,     ///< one column of the impacts against another, one row per impact
  peak,        ///< place (y) and width (y_err) of one peak of a column of the impacts, at `at` (x)
  profile,     ///< a column of profiles.csv (of profiles_fine.csv with `fine`) against h
  series,      ///< a column of series.csv against the clock
  last,        ///< a column of series.csv at the end of the run, against `at`
  pressure,    ///< a column of pressure.csv against the packing fraction
  value,       ///< the one number of a column of `file`, against the value of `vary`; averaged over the runs
  mean,        ///< the mean of a column of `file` over its rows, against the value of `vary`
  line,        ///< a straight line through the origin, to guide the eye
  map,         ///< a field of cells against x, one series a file
  spectrum,    ///< of that field's fluctuations in time
  avalanches,  ///< distribution of avalanches' sizes, of a pile as long as `length`
  mean_avalanche,  ///< their mean size, against `length`
  table,           ///< a column of `file` against another, averaged over the runs
  cooling,         ///< √(T_0/T) or a_2 of a gas against t/τ (extract_hard.hpp, as all that follow)
  rate,            ///< how fast a column of series.csv changes, against the value of `vary`
  record,          ///< a number of run.json, against that
  network,         ///< contacts of the last frame
  depth,           ///< a column of profiles.csv against the depth below the surface
  janssen,         ///< Janssen's law fitted to that
  state,           ///< a number that a run is known by against another (extract_flow.hpp)
  history          ///< a column of history.csv against time, one series a height
};

/// Which rows count: those whose column lies in [low, high).
struct Where {
  std::string column;
  bool absolute = false;
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();

  bool takes(double value) const {
    const double v = absolute ? std::abs(value) : value;
    return v >= low && v < high;
  }
};

/// One series of one panel: which runs, and what is taken from them.
struct Curve {
  std::string panel, series;
  std::vector<std::string> set;    ///< key=value, on top of the recipe's
  std::vector<std::string> quick;  ///< and with --quick, on top of the recipe's `quick`
  std::vector<std::string> after;  ///< the runs begin with the ends of runs that have these settings besides
  std::vector<std::string>
      go_on;                 ///< and with these then, on top of all; the start is what the run before left
  std::int64_t threads = 1;  ///< of each run; of LAMMPS processes
  double length = 1;         ///< L of a pile
  std::optional<std::vector<double>> collapse;  ///< [τ, D]: s^τ P(s) against s/L^D
  std::vector<std::string>
      runs;  ///< instead of a scene: run directories that are there, relative to the recipe
  Extract extract = Extract::histogram;
  std::optional<std::string>
      file;            ///< histogram, scatter, value, mean, table: a CSV file of the run; default its impacts
  std::string column;  ///< what is drawn (y; x of a histogram)
  std::vector<Where> where;  ///< histogram, scatter, mean: only rows that all of these let pass
  bool over_sine = false;    ///< histogram: divided by the sine of x, the size of a ring on a sphere
  double scale = 1;          ///< histogram: x times this; value, mean, rate, record, network: y
  double x_power = 1,
         x_scale = 1;  ///< value, mean, rate, record: x is the value of `vary` to this power, times this
  bool times_velocity = false;  ///< histogram: and x times the run's mean velocity: a time becomes a way
  double packing = 0, restitution = 1;       ///< cooling: φ and e_n
  std::vector<double> bulk{0.3, 0.7};        ///< state: from where to where, in heights of the flow
  double slope = 1;                          ///< line
  std::string against;                       ///< scatter, table: the column for x
  std::int64_t bins = 100;                   ///< histogram
  std::optional<std::vector<double>> range;  ///< histogram: [low, high]; default: what occurs
  double fold = 0;                           ///< histogram, scatter: take angles modulo this; 0: as they are
  bool absolute = false;                     ///< histogram, scatter: the column's absolute value
  bool absolute_x = false;                   ///< scatter: the absolute value of `against`
  std::int64_t most = 20000;                 ///< return_map, scatter: no more dots than this, evenly taken
  bool fine = false;                         ///< profile: the fine bins
  std::int64_t peak = 1;                     ///< peak: which, counted from 0, the one at the least values
  double bandwidth = 4e-3;  ///< peak: of the density's kernel, in the column's unit (figures/peaks.hpp)
  double widest = std::numeric_limits<double>::infinity();  ///< peak: a wider cluster is a continuum, no peak
  std::optional<std::string> vary;          ///< a key of the scene that changes along the curve …
  std::vector<double> values;               ///< … and what it is, point by point
  std::optional<std::int64_t> quick_count;  ///< so many of them, evenly, are enough for a quick figure
  bool full_only = false;                   ///< this point is not one of those; not in the file
  double at = 0;                            ///< the value that this point of the curve has; not in the file

  /// Where the point of a curve stands along which something varies.
  double x() const { return x_scale * std::pow(at, x_power); }
};

/// The data half of a figure recipe: [data] and [[data.curve]].
struct DataRecipe {
  std::optional<std::string> scene;    ///< scene file, relative to the recipe
  std::optional<std::string> compute;  ///< instead: a computation that is no run of a scene, by name
  std::vector<experiments::ExperimentRecipe> experiments;  ///< instead: results of experiments
  bool runs = false;                                       ///< instead: every curve names its `runs`
  std::optional<std::string> table;                        ///< instead: a CSV file, relative to the recipe
  TableColumns columns;                                    ///< of it
  std::optional<FormulaCurve> formula;                     ///< instead: a line
  std::vector<std::string> set;                            ///< key=value for every run
  std::vector<std::string> quick;                          ///< and with --quick
  std::int64_t seeds = 1, quick_seeds = 1;                 ///< runs per curve, with seeds 1, 2, …
  std::string x, y;                ///< what x and y are, with units: comments of the CSV
  std::vector<std::string> notes;  ///< further comments
  std::vector<Curve> curves;
  std::vector<SweepCurve> sweeps;  ///< [[data.sweep]]: curves made from many runs
  std::vector<Fit> fits;           ///< [[data.fit]]: laws put through series that are there
  std::vector<Ratio> ratios;       ///< [[data.ratio]]: series divided by others
};

void describe(TomlReader& a, DataRecipe& recipe);
void describe(KeyLister& a, DataRecipe& recipe);

}  // namespace chute::figures
