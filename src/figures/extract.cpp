#include "figures/extract.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "common/fields.hpp"
#include "core/estimate.hpp"
#include "figures/extract_fields.hpp"
#include "figures/extract_flow.hpp"
#include "figures/extract_hard.hpp"
#include "figures/peaks.hpp"
#include "read/table.hpp"
#include "read/vtk_points.hpp"
#include "run/flow.hpp"

namespace chute::figures {
namespace fs = std::filesystem;
namespace {

/// What happened in one run, row by row: its impacts in order of time, or the rows of one of its tables.
class Rows {
 public:
  Rows(const Curve& curve, const fs::path& run) : file_(run / curve.file.value_or("impacts.vtp")) {
    if (curve.file)
      read_table(curve);
    else
      read_impacts();
    passes_.assign(column(curve.column).size(), true);
    for (const auto& where : curve.where) {
      const auto& values = column(where.column);
      for (std::size_t i = 0; i < values.size(); ++i) {
        if (!where.takes(values[i])) passes_[i] = false;
      }
    }
  }

  const std::vector<double>& column(const std::string& name) const {
    if (const auto known = columns_.find(name); known != columns_.end()) return known->second;
    std::vector<std::string> known;
    for (const auto& [word, values] : columns_) known.push_back(word);
    const auto hint = nearest(name, known);
    throw InputError(fmt::format("{}: {} no column {}{}", file_.string(),
                                 is_table_ ? "there is" : "impacts have", name,
                                 hint.empty() ? "" : ", did you mean " + hint + "?"));
  }
  /// Does the curve's `where` let this row pass?
  bool passes(std::size_t row) const { return passes_[row]; }

 private:
  fs::path file_;
  std::map<std::string, std::vector<double>> columns_;
  std::vector<bool> passes_;
  bool is_table_ = false;

  void read_table(const Curve& curve) {
    is_table_ = true;
    const auto table = read::read_table(file_);
    std::vector<std::string> wanted{curve.column, curve.against};
    for (const auto& where : curve.where) wanted.push_back(where.column);
    for (const auto& name : wanted)
      if (!name.empty()) columns_[name] = table.column(name);
  }
  void read_impacts() {
    const auto points = read::parse_vtk(read_file(file_), file_);
    for (const auto& array : points.point_arrays)
      if (array.components == 1) columns_[array.name] = array.values;
    // Velocities along the line and towards it, (4.4) and (4.5) solved for v_x and v_z
    const auto &gamma = column(std::string(fields::gamma.name)), &v_n = column(std::string(fields::v_n.name)),
               &v_t = column(std::string(fields::v_t.name));
    std::vector<double> v_x, v_z;
    for (std::size_t i = 0; i < gamma.size(); ++i) {
      v_x.push_back(v_n[i] * std::sin(gamma[i]) + v_t[i] * std::cos(gamma[i]));
      v_z.push_back(-(v_n[i] * std::cos(gamma[i]) - v_t[i] * std::sin(gamma[i])));
    }
    // What the same grain's impact before was, and how long ago, from onset to onset
    const auto &time = column(std::string(fields::time.name)), &phi = column(std::string(fields::phi.name)),
               &grain = column(std::string(fields::grain.name));
    std::vector<double> interval, phi_before;
    std::map<double, std::size_t> last;
    for (std::size_t i = 0; i < time.size(); ++i) {
      const auto before = last.find(grain[i]);
      interval.push_back(before == last.end() ? NAN : time[i] - time[before->second]);
      phi_before.push_back(before == last.end() ? NAN : phi[before->second]);
      last[grain[i]] = i;
    }
    columns_["v_x"] = std::move(v_x), columns_["v_z"] = std::move(v_z);
    columns_["interval"] = std::move(interval), columns_["phi_before"] = std::move(phi_before);
  }
};

double folded(double angle, double period) {
  return period > 0 ? angle - period * std::floor(angle / period) : angle;
}

/// The curve's column, of all runs.
struct Joined {
  std::vector<double> values;
  std::vector<bool> passes;
};
Joined joined(const Curve& curve, std::span<const fs::path> runs) {
  Joined all;
  for (const auto& run : runs) {
    const Rows rows(curve, run);
    const double scale = curve.scale * (curve.times_velocity ? run::read_flow(run).v_x.mean : 1);
    const auto& column = rows.column(curve.column);
    for (std::size_t i = 0; i < column.size(); ++i) {
      if (!std::isfinite(column[i])) continue;  // unknown
      all.values.push_back(scale * folded(curve.absolute ? std::abs(column[i]) : column[i], curve.fold));
      all.passes.push_back(rows.passes(i));
    }
  }
  return all;
}

std::vector<FigureRow> histogram(const Curve& curve, std::span<const fs::path> runs) {
  const auto [values, passes] = joined(curve, runs);
  if (values.empty())
    throw WorkError(fmt::format("series {}: nothing was recorded, so there is no histogram", curve.series));
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const double low = curve.range ? (*curve.range)[0] : *least, high = curve.range ? (*curve.range)[1] : *most;
  const auto bins = static_cast<std::size_t>(curve.bins);
  const double width = (high - low) / static_cast<double>(bins);
  std::vector<double> counts(bins);
  double inside = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double v = values[i];
    if (!(v >= low && v <= high)) continue;
    inside += 1;  // so that parts of a histogram add up to all of it
    if (passes[i]) counts[std::min(bins - 1, static_cast<std::size_t>((v - low) / width))] += 1;
  }
  std::vector<FigureRow> rows;
  for (std::size_t b = 0; b < bins; ++b) {
    const double x = low + (static_cast<double>(b) + 0.5) * width;
    rows.push_back({curve.panel, curve.series, x,
                    inside > 0 ? counts[b] / (inside * width) / (curve.over_sine ? std::sin(x) : 1) : 0});
  }
  return rows;
}

/// Keeps `most` rows, evenly taken from all of the time: a picture of dots needs no more.
void thin(std::vector<FigureRow>& rows, std::int64_t most) {
  const auto wanted = static_cast<std::size_t>(most), all = rows.size();
  if (all <= wanted) return;
  for (std::size_t k = 0; k < wanted; ++k) rows[k] = rows[k * all / wanted];
  rows.resize(wanted);
}

std::vector<FigureRow> return_map(const Curve& curve, std::span<const fs::path> runs) {
  std::vector<FigureRow> rows;
  for (const auto& run : runs) {
    const Rows impacts(curve, run);
    const auto &value = impacts.column(curve.column),
               &grain = impacts.column(std::string(fields::grain.name));
    std::map<double, double> last;  // of each grain
    for (std::size_t i = 0; i < value.size(); ++i) {
      if (const auto before = last.find(grain[i]); before != last.end())
        rows.push_back({curve.panel, curve.series, before->second, value[i]});
      last[grain[i]] = value[i];
    }
  }
  thin(rows, curve.most);
  return rows;
}

std::vector<FigureRow> scatter(const Curve& curve, std::span<const fs::path> runs) {
  std::vector<FigureRow> rows;
  for (const auto& run : runs) {
    const Rows impacts(curve, run);
    const auto &x = impacts.column(curve.against), &y = impacts.column(curve.column);
    for (std::size_t i = 0; i < x.size(); ++i)
      if (impacts.passes(i) && std::isfinite(x[i]) &&
          std::isfinite(y[i]))  // a grain's first impact knows no flight before it
        rows.push_back({curve.panel, curve.series,
                        folded(curve.absolute_x ? std::abs(x[i]) : x[i], curve.fold),
                        curve.absolute ? std::abs(y[i]) : y[i]});
  }
  thin(rows, curve.most);
  return rows;
}

/// One peak of the distribution over all runs; no row where it is not distinguishable.
std::vector<FigureRow> peak(const Curve& curve, std::span<const fs::path> runs) {
  const auto peaks = find_peaks(joined(curve, runs).values, curve.bandwidth);
  const auto wanted = static_cast<std::size_t>(curve.peak);
  if (wanted >= peaks.size() || peaks[wanted].width > curve.widest) return {};
  return {{curve.panel, curve.series, curve.at, peaks[wanted].position, {}, peaks[wanted].width}};
}

/// The rows of a table that tell something: a layer that is nearly always empty has an area fraction, but no
/// mean velocity worth drawing.
std::vector<bool> telling(const read::Table& table, const std::string& column) {
  constexpr double fewest = 0.2;  // grains in the layer, on average
  std::vector<bool> rows(table.rows.size(), true);
  if (!table.has("grains") || column.starts_with("eta")) return rows;
  const auto grains = table.column("grains");
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = grains[i] >= fewest;
  return rows;
}

/// Fewer runs than these tell nothing of how runs scatter: their own errors count then.
constexpr std::size_t fewest_runs = 3;

/// Of numbers that have these errors.
double error_of_mean(const std::vector<double>& errors) {
  double square = 0;
  for (const double error : errors) square += error * error;
  return std::sqrt(square) / static_cast<double>(std::max<std::size_t>(1, errors.size()));
}

/// Mean over runs with its error: from their scatter, or, of too few, from what they state themselves, if all do.
Estimate over_runs(const std::vector<double>& values, const std::vector<double>& own) {
  Estimate e = estimate_of(values);
  if (values.size() >= fewest_runs) return e;
  const double combined = error_of_mean(own);
  e.error = std::isfinite(combined) && combined > 0 ? std::optional(combined) : std::nullopt;
  return e;
}

/// Those of them that the curve's `where` lets pass.
void choose(std::vector<bool>& rows, const read::Table& table, const Curve& curve) {
  for (const auto& where : curve.where) {
    const auto values = table.column(where.column);
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = rows[i] && where.takes(values[i]);
  }
}

/// A column of a table against another, or against the first, averaged over runs at equal x; where a run has several such rows
/// (layers at several times), its mean of them counts, as one.
std::vector<FigureRow> averaged(const Curve& curve, std::span<const fs::path> runs, const std::string& file,
                                const std::string& other = "") {
  struct Values {
    std::vector<double> y, err;
  };
  std::map<double, Values> at;
  for (const auto& run : runs) {
    const auto table = read::read_table(run / file);
    const auto x = table.column(other.empty() ? table.header.front() : other), y = table.column(curve.column);
    auto tells = telling(table, curve.column);
    choose(tells, table, curve);
    const auto error = curve.column + "_err";
    const auto err = table.has(error) ? table.column(error) : std::vector<double>(x.size(), NAN);
    std::map<double, Values> here;
    for (std::size_t i = 0; i < x.size(); ++i)
      if (tells[i] && std::isfinite(y[i])) {
        auto& values = at_same(here, x[i]);
        values.y.push_back(y[i]), values.err.push_back(err[i]);
      }
    for (const auto& [place, own] : here) {
      auto& values = at_same(at, place);
      values.y.push_back(estimate_of(own.y).mean), values.err.push_back(error_of_mean(own.err));
    }
  }
  std::vector<FigureRow> rows;
  for (const auto& [x, values] : at) {
    const auto [mean, error] = over_runs(values.y, values.err);
    rows.push_back({curve.panel, curve.series, x, mean, {}, error});
  }
  return rows;
}

/// The end of the series, averaged over runs: one point of a curve along which something varies.
std::vector<FigureRow> last(const Curve& curve, std::span<const fs::path> runs) {
  std::vector<double> ends;
  for (const auto& run : runs)
    if (const double end = read::read_table(run / "series.csv").column(curve.column).back();
        std::isfinite(end))
      ends.push_back(end);
  if (ends.empty()) return {};
  const auto [mean, error] = over_runs(ends, std::vector<double>(ends.size(), NAN));
  return {{curve.panel, curve.series, curve.at, mean, {}, error}};
}

/// The one number that a table of each run has in this column, over the runs. Runs that have none do not count.
std::vector<FigureRow> value(const Curve& curve, std::span<const fs::path> runs) {
  std::vector<double> values, own;
  for (const auto& run : runs) {
    const auto table = read::read_table(run / *curve.file);
    const auto column = table.column(curve.column);
    if (column.size() != 1)
      throw InputError(
          fmt::format("{}: {} rows, and one is wanted", (run / *curve.file).string(), column.size()));
    if (!std::isfinite(column[0])) continue;
    values.push_back(curve.scale * column[0]);
    const auto error = curve.column + "_err";
    own.push_back(table.has(error) ? curve.scale * table.column(error)[0] : NAN);
  }
  if (values.empty()) return {};
  const auto [mean, error] = over_runs(values, own);
  return {{curve.panel, curve.series, curve.x(), mean, {}, error}};
}

/// The mean of a column over the rows of each run's table that pass. Its error is that over the runs, or of one run that
/// over its rows, which count as independent then.
std::vector<FigureRow> mean_of_rows(const Curve& curve, std::span<const fs::path> runs) {
  std::vector<double> means, own;
  for (const auto& run : runs) {
    const Rows rows(curve, run);
    const auto& column = rows.column(curve.column);
    std::vector<double> values;
    for (std::size_t i = 0; i < column.size(); ++i)
      if (rows.passes(i) && std::isfinite(column[i])) values.push_back(curve.scale * column[i]);
    if (values.empty()) continue;
    const auto [mean, error] = estimate_of(values);
    means.push_back(mean), own.push_back(error.value_or(NAN));
  }
  if (means.empty()) return {};
  const auto [mean, error] = over_runs(means, own);
  return {{curve.panel, curve.series, curve.x(), mean, {}, error}};
}

std::vector<FigureRow> line(const Curve& curve) {
  std::vector<FigureRow> rows;
  for (const double x : *curve.range) rows.push_back({curve.panel, curve.series, x, curve.slope * x});
  return rows;
}

}  // namespace

std::vector<FigureRow> extract(const Curve& curve, std::span<const fs::path> runs) {
  switch (curve.extract) {
    case Extract::histogram:
      return histogram(curve, runs);
    case Extract::return_map:
      return return_map(curve, runs);
    case Extract::scatter:
      return scatter(curve, runs);
    case Extract::peak:
      return peak(curve, runs);
    case Extract::profile:
      return averaged(curve, runs, curve.fine ? "profiles_fine.csv" : "profiles.csv", "h");
    case Extract::series:
      return averaged(curve, runs, "series.csv");
    case Extract::last:
      return last(curve, runs);
    case Extract::pressure:
      return averaged(curve, runs, "pressure.csv");
    case Extract::value:
      return value(curve, runs);
    case Extract::mean:
      return mean_of_rows(curve, runs);
    case Extract::table:
      return averaged(curve, runs, *curve.file, curve.against);
    case Extract::line:
      return line(curve);
    case Extract::map:
      return field_map(curve, runs);
    case Extract::spectrum:
      return spectrum(curve, runs);
    case Extract::avalanches:
      return avalanche_sizes(curve, runs);
    case Extract::mean_avalanche:
      return mean_avalanche(curve, runs);
    case Extract::cooling:
      return cooling(curve, runs);
    case Extract::rate:
      return rate(curve, runs);
    case Extract::record:
      return record(curve, runs);
    case Extract::network:
      return network(curve, runs);
    case Extract::depth:
      return depth(curve, runs);
    case Extract::janssen:
      return janssen(curve, runs);
    case Extract::state:
      return state(curve, runs);
    case Extract::history:
      return history(curve, runs);
  }
  return {};
}

std::optional<double> left_out(const Curve& curve, std::span<const fs::path> runs) {
  if (curve.where.empty()) return {};
  const auto passes = joined(curve, runs).passes;
  const auto passing = static_cast<double>(std::count(passes.begin(), passes.end(), true));
  return passes.empty() ? 0 : 1 - passing / static_cast<double>(passes.size());
}

}  // namespace chute::figures
