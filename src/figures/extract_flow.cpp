#include "figures/extract_flow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/statistics/linear_regression.hpp>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>

#include "common/angle.hpp"
#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "common/toml_reader.hpp"
#include "core/estimate.hpp"
#include "read/table.hpp"

namespace chute::figures {
namespace fs = std::filesystem;
namespace {

/// A run's scene, as it was written with every default.
toml::table scene_of(const fs::path& run) {
  const auto file = run / "scene.toml";
  return parse_toml(read_file(file), file.string());
}

/// The number at a key; of an angle, degrees. NaN if there is none.
double number_at(const toml::table& scene, const std::string& key) {
  const auto node = scene.at_path(key);
  if (const auto number = node.value<double>(); number && !node.is_string()) return *number;
  if (const auto text = node.value<std::string>())
    if (const auto angle = parse_angle(*text)) return *angle * 180 / std::numbers::pi;
  return NAN;
}

double tangent_of(const toml::table& scene) {
  if (const double tangent = number_at(scene, "incline.tan"); std::isfinite(tangent)) return tangent;
  if (const double sine = number_at(scene, "incline.sin"); std::isfinite(sine))
    return std::tan(std::asin(sine));
  return std::tan(number_at(scene, "incline.angle") * std::numbers::pi / 180);
}

/// Slope of the line through these points by least squares; NaN of fewer than two.
double slope_of(const std::vector<double>& x, const std::vector<double>& y) {
  if (x.size() < 2) return NAN;
  return boost::math::statistics::simple_ordinary_least_squares(x, y).second;
}

/// profiles.csv, and where its flow ends.
struct Layers {
  read::Table table;
  bool plane;  ///< two dimensions
  std::vector<double> h, eta;
  std::size_t top = 0;  ///< layers below the surface
  double surface = 0;

  explicit Layers(const fs::path& run) : table(read::read_table(run / "profiles.csv")) {
    plane = !table.has("contact_zz");
    h = table.column("h"), eta = table.column("eta_exact");
    if (h.size() < 2) throw WorkError(fmt::format("{}: no layers to average over", run.string()));
    const double half = *std::max_element(eta.begin(), eta.end()) / 2;
    top = eta.size();
    while (top > 1 && eta[top - 1] < half) --top;
    surface = h[top - 1];
    if (top < eta.size())
      surface += (h[top] - h[top - 1]) * (eta[top - 1] - half) / (eta[top - 1] - eta[top]);
  }
  double stress(const char* along, std::size_t row) const {
    return table.column(std::string("kinetic_") + along)[row] +
           table.column(std::string("contact_") + along)[row];
  }
  double pressure(std::size_t row) const { return stress(plane ? "yy" : "zz", row); }
  double shear(std::size_t row) const { return std::abs(stress(plane ? "xy" : "xz", row)); }
};

/// Mean over the layers of the bulk of what `of` says of each; NaN if it has none.
template <class Of>
double mean_of_bulk(const Layers& layers, const Curve& curve, const Of& of) {
  std::vector<double> values;
  for (std::size_t k = 0; k < layers.top; ++k) {
    const double part = layers.h[k] / layers.surface;
    if (part < curve.bulk[0] || part > curve.bulk[1]) continue;
    if (const double value = of(k); std::isfinite(value)) values.push_back(value);
  }
  return estimate_of(values).mean;
}

double bulk_number(const std::string& what, const Curve& curve, const fs::path& run) {
  const Layers layers(run);
  if (what == "height") return layers.surface;
  if (what == "surface_speed") return layers.table.column("v_x")[layers.top - 1];
  if (what == "phi") return mean_of_bulk(layers, curve, [&](std::size_t k) { return layers.eta[k]; });
  if (what == "mu")
    return mean_of_bulk(layers, curve, [&](std::size_t k) { return layers.shear(k) / layers.pressure(k); });
  const auto half_shear = layers.table.column("half_shear");
  if (what == "shear_rate")
    return mean_of_bulk(layers, curve, [&](std::size_t k) { return 2 * std::abs(half_shear[k]); });
  const auto scene = scene_of(run);
  const double d = number_at(scene, "grains.diameter.mean"), density = number_at(scene, "grains.density");
  const double mass = density * std::numbers::pi / 6 * d * d * d;
  // γ̇ times this over √P is I
  const double factor = layers.plane ? std::sqrt(mass) : d * std::sqrt(density);
  return mean_of_bulk(layers, curve, [&](std::size_t k) {
    return factor * 2 * std::abs(half_shear[k]) / std::sqrt(layers.pressure(k));
  });
}

double discharge_rate(const fs::path& run) {
  const auto table = read::read_table(run / "discharge.csv");
  const auto time = table.column("time"), out = table.column("out");
  std::vector<double> x, y;
  for (std::size_t i = 0; i < time.size(); ++i)
    if (out[i] >= 0.2 * out.back() && out[i] <= 0.8 * out.back()) x.push_back(time[i]), y.push_back(out[i]);
  return slope_of(x, y);
}

nlohmann::json record_of(const fs::path& run) {
  const auto file = run / "run.json";
  try {
    return nlohmann::json::parse(read_file(file));
  } catch (const nlohmann::json::exception&) {
    throw InputError(fmt::format("{}: is no record of a run", file.string()));
  }
}

double turning_angle(const std::string& what, const fs::path& run) {
  const auto record = record_of(run);
  const auto value = record.value(nlohmann::json::json_pointer("/tilting/" + what), nlohmann::json());
  return value.is_number() ? value.get<double>() : NAN;
}

}  // namespace

double number_of_run(const std::string& what, const Curve& curve, const fs::path& run) {
  constexpr std::array of_bulk{"phi", "mu", "inertial_number", "shear_rate", "height", "surface_speed"};
  if (std::find(of_bulk.begin(), of_bulk.end(), what) != of_bulk.end()) return bulk_number(what, curve, run);
  if (what == "tan_theta") return tangent_of(scene_of(run));
  if (what == "start_angle" || what == "stop_angle") return turning_angle(what, run);
  if (what == "discharge") return discharge_rate(run);
  if (what == "seconds") {
    const auto record = record_of(run);
    return record.at("seconds").get<double>() / record.at("duration").get<double>();
  }
  if (what == "acceleration" || what == "speed") {
    const auto table = read::read_table(run / "series.csv");
    const auto time = table.column("time"), v_x = table.column("v_x");
    if (what == "acceleration") return slope_of(time, v_x);
    return estimate_of(std::span(v_x).subspan(v_x.size() / 2)).mean;
  }
  const auto scene = scene_of(run);
  constexpr std::string_view minus = " - ";
  const auto split = what.find(minus);
  const double number = split == std::string::npos ? number_at(scene, what)
                                                   : number_at(scene, what.substr(0, split)) -
                                                         number_at(scene, what.substr(split + minus.size()));
  if (std::isnan(number))
    throw InputError(fmt::format("{}: {} is neither a number that figures know of runs, nor one of its scene",
                                 run.string(), what));
  return number;
}

std::vector<FigureRow> state(const Curve& curve, std::span<const fs::path> runs) {
  std::vector<double> x, y;
  for (const auto& run : runs) {
    const double a = curve.x_scale * number_of_run(curve.against, curve, run);
    const double b = curve.scale * number_of_run(curve.column, curve, run);
    if (std::isfinite(a) && std::isfinite(b)) x.push_back(a), y.push_back(b);
  }
  if (x.empty()) return {};
  const auto known = [](const Estimate& e) {  // what the scene sets does not scatter
    return e.error && *e.error > 1e-12 * std::abs(e.mean) ? e.error : std::nullopt;
  };
  const auto at = estimate_of(x), value = estimate_of(y);
  return {{curve.panel, curve.series, at.mean, value.mean, known(at), known(value)}};
}

std::vector<FigureRow> history(const Curve& curve, std::span<const fs::path> runs) {
  std::map<double, std::map<double, std::vector<double>>> at;  // height, time
  // A time is one number at all heights, or maps of it have columns without cells.
  std::map<double, double> first_told;
  for (const auto& run : runs) {
    const auto table = read::read_table(run / "history.csv");
    const auto time = table.column("time"), h = table.column("h"), y = table.column(curve.column);
    for (std::size_t i = 0; i < time.size(); ++i) {
      double& t = at_same(first_told, time[i]);
      if (t == 0) t = time[i];
      if (std::isfinite(y[i])) at[h[i]][t].push_back(y[i]);
    }
  }
  std::vector<FigureRow> rows;
  for (const auto& [h, times] : at)
    for (const auto& [t, values] : times) {
      const auto [mean, error] = estimate_of(values);
      rows.push_back({curve.panel, fmt::format("{} h={:g}", curve.series, h), t, mean, {}, error});
    }
  return rows;
}

}  // namespace chute::figures
