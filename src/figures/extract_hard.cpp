#include "figures/extract_hard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "core/estimate.hpp"
#include "read/run_frames.hpp"
#include "read/table.hpp"
#include "read/vtk_points.hpp"
#include "theory/hard_gas.hpp"

namespace chute::figures {
namespace fs = std::filesystem;
namespace {

struct Points {
  std::vector<double> x, y;
};

/// y at x, straight between neighbours; nothing outside. The x ascend.
std::optional<double> between(const Points& points, double x) {
  const auto after = std::lower_bound(points.x.begin(), points.x.end(), x);
  if (after == points.x.end() || x < points.x.front()) return {};
  const auto k = static_cast<std::size_t>(after - points.x.begin());
  if (k == 0) return points.y[0];
  const double part = (x - points.x[k - 1]) / (points.x[k] - points.x[k - 1]);
  return points.y[k - 1] + part * (points.y[k] - points.y[k - 1]);
}

/// At each of these x the mean over those that reach so far.
std::vector<FigureRow> mean_of(const Curve& curve, const std::vector<Points>& all,
                               const std::vector<double>& at) {
  std::vector<FigureRow> rows;
  for (const double x : at) {
    std::vector<double> values;
    for (const auto& points : all)
      if (const auto y = between(points, x)) values.push_back(*y);
    if (values.size() < all.size()) continue;
    const auto [mean, error] = estimate_of(values);
    rows.push_back({curve.panel, curve.series, x, mean, {}, error});
  }
  return rows;
}

/// One point of a curve, the mean over the runs that know it.
std::vector<FigureRow> one_point(const Curve& curve, const std::vector<double>& values) {
  if (values.empty()) return {};
  const auto [mean, error] = estimate_of(values);
  return {{curve.panel, curve.series, curve.x(), mean, {}, error}};
}

}  // namespace

std::vector<FigureRow> cooling(const Curve& curve, std::span<const fs::path> runs) {
  std::vector<Points> all;
  for (const auto& run : runs) {
    const auto table = read::read_table(run / "moments.csv");
    const auto time = table.column("time"), T = table.column("temperature"), y = table.column(curve.column);
    const double tau = theory::haff_time_of_discs(curve.packing, curve.restitution, T.front());
    Points points;
    for (std::size_t k = 0; k < time.size(); ++k) {
      points.x.push_back(time[k] / tau);
      points.y.push_back(curve.column == "temperature" ? std::sqrt(T.front() / T[k]) : y[k]);
    }
    all.push_back(std::move(points));
  }
  return mean_of(curve, all, all.front().x);
}

std::vector<FigureRow> rate(const Curve& curve, std::span<const fs::path> runs) {
  std::vector<double> rates;
  for (const auto& run : runs) {
    const auto table = read::read_table(run / "series.csv");
    const auto time = table.column("time"), y = table.column(curve.column);
    if (time.size() < 2)
      throw InputError(fmt::format("{}: a rate needs two rows", (run / "series.csv").string()));
    rates.push_back(curve.scale * (y.back() - y.front()) / (time.back() - time.front()));
  }
  return one_point(curve, rates);
}

std::vector<FigureRow> record(const Curve& curve, std::span<const fs::path> runs) {
  std::vector<double> values;
  for (const auto& run : runs) {
    const auto file = run / "run.json";
    try {
      const auto value =
          nlohmann::json::parse(read_file(file)).at(nlohmann::json::json_pointer("/" + curve.column));
      if (!value.is_null()) values.push_back(curve.scale * value.get<double>());
    } catch (const nlohmann::json::exception&) {
      throw InputError(fmt::format("{}: has no number {}", file.string(), curve.column));
    }
  }
  return one_point(curve, values);
}

std::vector<FigureRow> network(const Curve& curve, std::span<const fs::path> runs) {
  const auto frame = read::find_frames(runs.front()).back();
  if (frame.contacts.empty())
    throw InputError(fmt::format("{}: no contacts beside its frames", runs.front().string()));
  const auto file = read::parse_vtk(read_file(frame.contacts), frame.contacts);
  const auto array = [&](const char* name) -> const read::PointArray& {
    for (const auto& a : file.cell_arrays)
      if (a.name == name) return a;
    throw InputError(fmt::format("{}: has no array {}", frame.contacts.string(), name));
  };
  const auto &F = array("normal_force"), &partner = array("b");
  const bool branch = curve.column == "branch";
  const auto& pair = array(branch ? "branch" : "point");
  std::vector<FigureRow> rows;
  for (std::size_t k = 0; k < F.values.size(); ++k) {
    if (curve.column == "force") {
      rows.push_back({curve.panel, curve.series, static_cast<double>(k + 1), curve.scale * F.values[k]});
      continue;
    }
    const double far = branch && partner.values[k] < 0 ? 2 : 1;  // as if a grain stood behind the wall
    rows.push_back({curve.panel, curve.series, far * pair.values[3 * k], far * pair.values[3 * k + 1]});
  }
  return rows;
}

std::vector<FigureRow> depth(const Curve& curve, std::span<const fs::path> runs) {
  std::vector<Points> all;
  double shallowest = INFINITY, step = 1;
  for (const auto& run : runs) {
    const auto table = read::read_table(run / "profiles.csv");
    const auto h = table.column("h"), eta = table.column("eta"), y = table.column(curve.column);
    const double half = *std::max_element(eta.begin(), eta.end()) / 2;
    std::size_t top = eta.size();
    while (top > 1 && eta[top - 1] < half) --top;
    if (top < 3) throw WorkError(fmt::format("{}: no layers to take a depth in", run.string()));
    double surface = h[top - 1];
    if (top < eta.size())
      surface += (h[top] - h[top - 1]) * (eta[top - 1] - half) / (eta[top - 1] - eta[top]);
    Points points;
    for (std::size_t k = top; k-- > 0;) points.x.push_back(surface - h[k]), points.y.push_back(y[k]);
    step = h[1] - h[0];
    shallowest = std::min(shallowest, points.x.back());
    all.push_back(std::move(points));
  }
  std::vector<double> at;
  for (double x = step; x <= shallowest; x += step) at.push_back(x);
  return mean_of(curve, all, at);
}

/// For each λ the best σ_∞ is linear least squares; λ by minimising over its logarithm.
Janssen fit_janssen(const std::vector<FigureRow>& rows) {
  if (rows.size() < 3) throw WorkError("Janssen's law needs three depths to be fitted to");
  const auto best_stress = [&](double lambda) {
    double above = 0, below = 0;
    for (const auto& r : rows) {
      const double f = -std::expm1(-r.x / lambda);
      above += f * r.y, below += f * f;
    }
    return above / below;
  };
  const auto misfit = [&](double log_lambda) {
    const double lambda = std::exp(log_lambda), stress = best_stress(lambda);
    double sum = 0;
    for (const auto& r : rows) {
      const double off = r.y + stress * std::expm1(-r.x / lambda);
      sum += off * off;
    }
    return sum;
  };
  const double largest = rows.back().x;
  constexpr double widest = 100;  // λ within this factor of the largest depth
  constexpr int bits = 40;
  const double lambda = std::exp(boost::math::tools::brent_find_minima(misfit, std::log(largest / widest),
                                                                       std::log(largest * widest), bits)
                                     .first);
  return {best_stress(lambda), lambda, largest};
}

std::vector<FigureRow> janssen(const Curve& curve, std::span<const fs::path> runs) {
  const auto fit = fit_janssen(depth(curve, runs));
  std::vector<FigureRow> rows;
  constexpr int points = 100;
  for (int k = 0; k <= points; ++k) {
    const double z = fit.largest * k / points;
    rows.push_back({curve.panel, curve.series, z, -fit.stress * std::expm1(-z / fit.length)});
  }
  return rows;
}

std::string janssen_note(const Curve& curve, std::span<const fs::path> runs) {
  const auto fit = fit_janssen(depth(curve, runs));
  return fmt::format("{}: sigma = {:.4g} (1 - exp(-z/{:.4g})), fitted up to z = {:.4g}", curve.series,
                     fit.stress, fit.length, fit.largest);
}

}  // namespace chute::figures
