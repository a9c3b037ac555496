#include "figures/extract.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "common/fields.hpp"
#include "core/estimate.hpp"
#include "figures/peaks.hpp"
#include "read/table.hpp"
#include "read/vtk_points.hpp"

namespace chute::figures {
namespace fs = std::filesystem;
namespace {

/// The impacts of one run, in order of time.
class Impacts {
 public:
  explicit Impacts(const fs::path& run)
      : file_(run / "impacts.vtp"), points_(read::parse_vtk(read_file(file_), file_)) {
    // Velocities along the line and towards it, (4.4) and (4.5) solved for v_x and v_z
    const auto &gamma = column(fields::gamma.name), &v_n = column(fields::v_n.name),
               &v_t = column(fields::v_t.name);
    read::PointArray v_x{"v_x", 1, {}}, v_z{"v_z", 1, {}};
    for (std::size_t i = 0; i < gamma.size(); ++i) {
      v_x.values.push_back(v_n[i] * std::sin(gamma[i]) + v_t[i] * std::cos(gamma[i]));
      v_z.values.push_back(-(v_n[i] * std::cos(gamma[i]) - v_t[i] * std::sin(gamma[i])));
    }
    points_.point_arrays.push_back(std::move(v_x));
    points_.point_arrays.push_back(std::move(v_z));
  }

  const std::vector<double>& column(std::string_view name) const {
    for (const auto& array : points_.point_arrays)
      if (array.name == name && array.components == 1) return array.values;
    std::vector<std::string> known;
    for (const auto& field : fields::impact_fields) known.emplace_back(field.name);
    const auto hint = nearest(name, known);
    throw InputError(fmt::format("{}: impacts have no column {}{}", file_.string(), name,
                                 hint.empty() ? "" : ", did you mean " + hint + "?"));
  }

 private:
  fs::path file_;
  read::VtkPoints points_;
};

double folded(double angle, double period) {
  return period > 0 ? angle - period * std::floor(angle / period) : angle;
}

/// The curve's column, of all runs.
std::vector<double> joined(const Curve& curve, std::span<const fs::path> runs) {
  std::vector<double> values;
  for (const auto& run : runs) {
    const Impacts impacts(run);
    for (const double v : impacts.column(curve.column))
      if (std::isfinite(v))
        values.push_back(folded(curve.absolute ? std::abs(v) : v, curve.fold));  // else unknown
  }
  return values;
}

std::vector<FigureRow> histogram(const Curve& curve, std::span<const fs::path> runs) {
  const std::vector<double> values = joined(curve, runs);
  if (values.empty())
    throw WorkError(
        fmt::format("series {}: no impacts were recorded, so there is no histogram", curve.series));
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const double low = curve.range ? (*curve.range)[0] : *least, high = curve.range ? (*curve.range)[1] : *most;
  const auto bins = static_cast<std::size_t>(curve.bins);
  const double width = (high - low) / static_cast<double>(bins);
  std::vector<double> counts(bins);
  double inside = 0;
  for (double v : values) {
    if (!(v >= low && v <= high)) continue;  // nor what is not a number
    counts[std::min(bins - 1, static_cast<std::size_t>((v - low) / width))] += 1;
    inside += 1;
  }
  std::vector<FigureRow> rows;
  for (std::size_t b = 0; b < bins; ++b)
    rows.push_back({curve.panel, curve.series, low + (static_cast<double>(b) + 0.5) * width,
                    inside > 0 ? counts[b] / (inside * width) : 0});
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
    const Impacts impacts(run);
    const auto &value = impacts.column(curve.column), &grain = impacts.column(fields::grain.name);
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
    const Impacts impacts(run);
    const auto &x = impacts.column(curve.against), &y = impacts.column(curve.column);
    for (std::size_t i = 0; i < x.size(); ++i)
      if (std::isfinite(x[i]) && std::isfinite(y[i]))  // a grain's first impact knows no flight before it
        rows.push_back(
            {curve.panel, curve.series, folded(x[i], curve.fold), curve.absolute ? std::abs(y[i]) : y[i]});
  }
  thin(rows, curve.most);
  return rows;
}

/// One peak of the distribution over all runs; no row where it is not distinguishable.
std::vector<FigureRow> peak(const Curve& curve, std::span<const fs::path> runs) {
  const auto peaks = find_peaks(joined(curve, runs), curve.bandwidth);
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

/// A column of a table against another, or against the first, averaged over runs at equal x.
std::vector<FigureRow> averaged(const Curve& curve, std::span<const fs::path> runs, const std::string& file,
                                const std::string& other = "") {
  struct Values {
    std::vector<double> y, err;
  };
  std::map<double, Values> at;
  for (const auto& run : runs) {
    const auto table = read::read_table(run / file);
    const auto x = table.column(other.empty() ? table.header.front() : other), y = table.column(curve.column);
    const auto tells = telling(table, curve.column);
    const auto error = curve.column + "_err";
    const auto err = table.has(error) ? table.column(error) : std::vector<double>(x.size(), NAN);
    for (std::size_t i = 0; i < x.size(); ++i)
      if (tells[i] && std::isfinite(y[i])) at[x[i]].y.push_back(y[i]), at[x[i]].err.push_back(err[i]);
  }
  std::vector<FigureRow> rows;
  for (const auto& [x, values] : at) {
    auto [mean, error] = estimate_of(values.y);
    if (!error && std::isfinite(values.err[0])) error = values.err[0];
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
  const auto [mean, error] = estimate_of(ends);
  return {{curve.panel, curve.series, curve.at, mean, {}, error}};
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
  }
  return {};
}

}  // namespace chute::figures
