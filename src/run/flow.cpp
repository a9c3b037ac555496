#include "run/flow.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <vector>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "scene/start.hpp"

namespace chute::run {

measure::Flow judge_run(std::span<const measure::SeriesRow> series, const scene::Scene& scene,
                        const GrainsView& grains) {
  const double mass = std::accumulate(grains.mass.begin(),
                                      grains.mass.begin() + static_cast<std::ptrdiff_t>(grains.moving), 0.0);
  std::vector<double> time, x, omega, kinetic;
  for (const auto& row : series) {
    time.push_back(row.time);
    x.push_back(row.x);
    omega.push_back(row.omega);
    kinetic.push_back((row.energy.translation + row.energy.rotation) / mass);
  }
  const bool bed = scene.bed.kind != scene::Bed::Kind::none;
  const double length = bed ? grains.period[0] / static_cast<double>(scene.bed.count) : scene.mean_diameter();
  auto flow = measure::judge_flow({time, x, omega, kinetic}, {length, scene.incline.gravity});
  flow.kinetic.mean *= mass;
  if (flow.kinetic.error) *flow.kinetic.error *= mass;
  return flow;
}

nlohmann::ordered_json to_json(const measure::Flow& flow) {
  nlohmann::ordered_json json{{"verdict", measure::name(flow.verdict)}, {"from", flow.from}};
  const auto add = [&](const std::string& key, const measure::Estimate& estimate) {
    json[key] = estimate.mean;  // not a number becomes null
    json[key + "_err"] = estimate.error ? nlohmann::ordered_json(*estimate.error) : nullptr;
  };
  add("v_x", flow.v_x);
  add("omega", flow.omega);
  add("kinetic", flow.kinetic);
  return json;
}

measure::Flow read_flow(const std::filesystem::path& directory) {
  const auto file = directory / "run.json";
  try {
    const auto json = nlohmann::json::parse(read_file(file)).at("flow");
    const auto number = [&](const std::string& key) -> std::optional<double> {
      const auto& value = json.at(key);
      return value.is_null() ? std::nullopt : std::optional(value.get<double>());
    };
    const auto estimate = [&](const std::string& key) {
      return measure::Estimate{number(key).value_or(NAN), number(key + "_err")};
    };
    const auto verdict = measure::verdict_named(json.at("verdict").get<std::string>());
    if (!verdict) throw InputError("its verdict is not known");
    return {*verdict, number("from").value_or(NAN), estimate("v_x"), estimate("omega"), estimate("kinetic")};
  } catch (const nlohmann::json::exception&) {
    throw InputError(file.string() + ": does not tell what became of the flow; run it again with --force");
  }
}

}  // namespace chute::run
