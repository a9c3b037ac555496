#include "figures/data_recipe.hpp"

#include <fmt/format.h>

#include "common/keys.hpp"

namespace chute::figures {
namespace {
using namespace std::string_view_literals;
constexpr std::array extract_words{
    "histogram"sv, "return-map"sv, "scatter"sv,        "peak"sv,    "profile"sv, "series"sv,
    "last"sv,      "pressure"sv,   "value"sv,          "mean"sv,    "line"sv,    "map"sv,
    "spectrum"sv,  "avalanches"sv, "mean-avalanche"sv, "table"sv,   "cooling"sv, "rate"sv,
    "record"sv,    "network"sv,    "depth"sv,          "janssen"sv, "state"sv,   "history"sv};

bool is_point_by_point(Extract extract) {
  return extract == Extract::peak || extract == Extract::last || extract == Extract::pressure ||
         extract == Extract::value || extract == Extract::mean || extract == Extract::rate ||
         extract == Extract::record;
}
}  // namespace

template <class Archive>
static void describe(Archive& a, Where& where) {
  a.required("column", where.column, "only rows whose number in it lies in [low, high) count");
  a.value("absolute", where.absolute, "its absolute value");
  a.value("low", where.low, "default none");
  a.value("high", where.high, "default none");
}

template <class Archive>
static void describe(Archive& a, Curve& curve) {
  constexpr bool all = !Archive::reading;
  a.value("panel", curve.panel, "of the series");
  a.required("series", curve.series, "its name");
  a.value("set", curve.set, "key=value for its scene, on top of the recipe's");
  a.value("quick", curve.quick, "and with --quick");
  a.value("after", curve.after,
          "key=value: each run begins with what another, with these settings besides, ended with");
  a.value("go_on", curve.go_on,
          "with after: key=value of the run that goes on, such as grains.start.velocity, a push");
  a.check(curve.go_on.empty() || !curve.after.empty(), "go_on", "needs after, the run before");
  a.value("threads", curve.threads, between(1, 1024),
          "of each run; with engine.method = \"lammps\" processes");
  a.value("runs", curve.runs, "instead of a scene: run directories that are there, relative to the recipe");
  a.check(curve.runs.empty() || curve.set.empty(), "set",
          "changes a scene; runs that are there cannot be changed");
  a.choice("extract", curve.extract, extract_words, "how a run's files become rows");
  const bool line = curve.extract == Extract::line, table = curve.extract == Extract::table;
  const bool mean = curve.extract == Extract::mean, value = curve.extract == Extract::value || mean;
  const bool avalanches = curve.extract == Extract::avalanches;
  if (all || avalanches || curve.extract == Extract::mean_avalanche)
    a.required("length", curve.length, positive, "avalanches, mean-avalanche: L of the pile");
  if (all || !(avalanches || curve.extract == Extract::mean_avalanche || line))
    a.required("column", curve.column, "what is drawn: y, or x of a histogram");
  if (all || avalanches) {
    a.value("collapse", curve.collapse, "avalanches: [tau, D], for s^tau P(s) over s/L^D");
    a.check(!curve.collapse || curve.collapse->size() == 2, "collapse", "must be [tau, D]");
  }
  const bool scatter = curve.extract == Extract::scatter, histogram = curve.extract == Extract::histogram;
  const bool state = curve.extract == Extract::state;
  if (all || scatter || table || state)
    a.required("against", curve.against, "scatter, table: the column for x; state: the number for x");
  if (all || state) {
    a.value("bulk", curve.bulk, "state: which part of the flow its bulk is, in heights of the flow");
    a.check(
        curve.bulk.size() == 2 && 0 <= curve.bulk[0] && curve.bulk[0] < curve.bulk[1] && curve.bulk[1] <= 1,
        "bulk", "must be [low, high] with 0 <= low < high <= 1");
  }
  if (all || scatter) a.value("absolute_x", curve.absolute_x, "scatter: the absolute value of `against`");
  if (all || histogram || scatter)
    a.value("file", curve.file,
            "a CSV file of the run; default its impacts; required for value, mean, table");
  else if (value || table)
    a.required("file", curve.file);
  if (all || histogram || scatter || mean || table) a.sections("where", curve.where);
  const bool rate = curve.extract == Extract::rate || curve.extract == Extract::record;
  if (all || histogram || value || rate || state || curve.extract == Extract::network)
    a.value("scale", curve.scale, "histogram: x times this; value, mean, rate, record, network, state: y");
  if (all || value || rate)
    a.value("x_power", curve.x_power, at_least(0), "x is the varied value to this power");
  if (all || value || rate || state) a.value("x_scale", curve.x_scale, positive, "times this");
  if (all || curve.extract == Extract::cooling) {
    a.required("packing", curve.packing, between(1e-6, 0.9), "cooling: φ");
    a.required("restitution", curve.restitution, between(0, 1), "cooling: e_n");
  }
  if (all || line) a.required("slope", curve.slope, "of a line through the origin");
  if (all || histogram) {
    a.value("over_sine", curve.over_sine, "histogram: divided by sin x, a ring's size on a sphere");
    a.value("times_velocity", curve.times_velocity, "histogram: x times the run's mean velocity");
    a.value("bins", curve.bins, between(2, 100000), "histogram");
  }
  if (all || histogram || line) {
    a.value("range", curve.range, "histogram, line: [low, high] of x; default what occurs");
    a.check(!curve.range || (curve.range->size() == 2 && (*curve.range)[0] < (*curve.range)[1]), "range",
            "must be [low, high] with low < high");
  }
  if (all || histogram || scatter) {
    a.value("fold", curve.fold, non_negative, "take angles modulo this; 0: as they are");
    a.value("absolute", curve.absolute, "the column's absolute value");
  }
  if (all || scatter || curve.extract == Extract::return_map)
    a.value("most", curve.most, at_least(1), "no more dots than this, evenly taken");
  if (all || curve.extract == Extract::profile) a.value("fine", curve.fine, "profile: the fine bins");
  a.check(!line || curve.range, "range", "a line needs range = [low, high]");
  if (all || curve.extract == Extract::peak) {
    a.value("peak", curve.peak, between(0, 100), "which, counted from 0 at the least values");
    a.value("bandwidth", curve.bandwidth, positive, "peak: of the density's kernel");
    a.value("widest", curve.widest, positive, "peak: a wider cluster is no peak; default any");
  }
  if (all || is_point_by_point(curve.extract)) {
    a.required(
        "vary", curve.vary,
        "peak, last, pressure, value, mean, rate, record: the key along the curve; state: may be left out");
    a.required("values", curve.values, "what it is, point by point");
    a.check(!curve.values.empty(), "values", "must hold at least one value");
    a.value("quick_count", curve.quick_count, at_least(2), "so many of them are enough for a quick figure");
  } else if (state) {  // may be, or else each point is a curve of its own
    a.value("vary", curve.vary);
    if (curve.vary) a.required("values", curve.values);
    if (curve.vary) a.value("quick_count", curve.quick_count, at_least(2));
  }
  a.check(curve.series.find_first_of(",\"\n") == std::string::npos, "series",
          "must not hold commas, quotes or line breaks");
}

/// A curve along which a key of the scene changes becomes one curve per value, under the same name.
static std::vector<Curve> point_by_point(const std::vector<Curve>& curves) {
  std::vector<Curve> points;
  for (const auto& curve : curves) {
    if (!curve.vary) points.push_back(curve);
    const std::size_t all = curve.values.size();
    const auto few = static_cast<std::size_t>(curve.quick_count.value_or(static_cast<std::int64_t>(all)));
    for (std::size_t k = 0, taken = 0; k < all; ++k) {
      Curve point = curve;
      const double value = point.at = curve.values[k];
      // The first and the last one, and evenly between them
      point.full_only = few < all && k != taken * (all - 1) / (few - 1);
      if (!point.full_only) ++taken;
      point.set.push_back(fmt::format("{}={}", *curve.vary, value));
      points.push_back(std::move(point));
    }
  }
  return points;
}

template <class Archive>
static void describe_simulated(Archive& a, DataRecipe& recipe) {
  a.value("set", recipe.set, "key=value for every run");
  a.value("quick", recipe.quick, "and with --quick");
  a.value("seeds", recipe.seeds, between(1, 10000), "runs for each curve, with seeds 1, 2, …");
  a.value("quick_seeds", recipe.quick_seeds, between(1, 10000), "of a quick figure");
  a.required("x", recipe.x, "what x is, with its unit: a comment of the CSV");
  a.required("y", recipe.y, "what y is");
  a.value("notes", recipe.notes, "further comments");
  a.sections("curve", recipe.curves);
}

void describe(KeyLister& a, DataRecipe& recipe) {
  a.value("scene", recipe.scene, "a scene file to simulate, relative to the recipe");
  a.value("compute", recipe.compute, "a built-in computation, by name");
  a.value("table", recipe.table, "a CSV file, relative to the recipe: a run's, a sweep's, your own");
  a.value("expression", std::string(), "a formula of x for a line, read by muParser: \"0.3*(1-exp(-x/2))\"");
  describe_simulated(a, recipe);
  // What a table or a formula has instead; the plus says that these are keys of [data] itself.
  a.section("+table", recipe.columns);
  FormulaCurve line;
  a.section("+expression", line);
  a.sections("sweep", recipe.sweeps);
  a.sections("experiment", recipe.experiments);
  a.sections("fit", recipe.fits);
  a.sections("ratio", recipe.ratios);
}

void describe(TomlReader& a, DataRecipe& recipe) {
  a.value("scene", recipe.scene);
  a.value("compute", recipe.compute);
  a.value("table", recipe.table);
  a.sections("experiment", recipe.experiments);
  const bool line = a.has("expression");
  const int sources = (recipe.scene.has_value() || recipe.compute.has_value()) + recipe.table.has_value() +
                      !recipe.experiments.empty() + line;
  a.check(sources <= 1, "scene",
          "give one of scene (simulate; perhaps with compute, a built-in computation, beside it), "
          "experiment, table (a CSV file), expression (a formula), or curves with runs; several sources are "
          "several [[data]]");
  a.sections("fit", recipe.fits);
  a.sections("ratio", recipe.ratios);
  if (line) return describe(a, recipe.formula.emplace());
  if (recipe.table) return describe(a, recipe.columns);
  if (!recipe.scene && (recipe.compute || !recipe.experiments.empty())) return;
  describe_simulated(a, recipe);
  recipe.curves = point_by_point(recipe.curves);
  a.sections("sweep", recipe.sweeps);
  a.check(!recipe.curves.empty() || !recipe.sweeps.empty(), "curve",
          "a figure needs at least one [[data.curve]] or [[data.sweep]]");
  a.check(recipe.sweeps.empty() || recipe.scene, "sweep", "needs a scene to change");
  recipe.runs = !recipe.scene;
  for (const auto& curve : recipe.curves)
    a.check(
        curve.runs.empty() == !recipe.runs, "curve",
        recipe.runs ? "without a scene every curve names its runs" : "give either a scene or runs, not both");
}

}  // namespace chute::figures
