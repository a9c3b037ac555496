#include "sweep/point_store.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "run/version.hpp"

namespace chute::sweep {
namespace {

using Json = nlohmann::ordered_json;

// JSON has no NaN: what was not seen is null, and so is an error that is not known.
Json to_json(const measure::Estimate& e) {
  return {std::isfinite(e.mean) ? Json(e.mean) : Json(), e.error ? Json(*e.error) : Json()};
}
measure::Estimate estimate_from(const Json& json) {
  measure::Estimate e{NAN, {}};
  if (!json.at(0).is_null()) e.mean = json.at(0);
  if (!json.at(1).is_null()) e.error = json.at(1).get<double>();
  return e;
}

Json to_json(const measure::Flow& flow) {
  return {{"verdict", name(flow.verdict)},
          {"from", flow.from},
          {"v_x", to_json(flow.v_x)},
          {"omega", to_json(flow.omega)},
          {"kinetic", to_json(flow.kinetic)}};
}
measure::Flow flow_from(const Json& json) {
  return {measure::verdict_named(json.at("verdict").get<std::string>()).value(), json.at("from"),
          estimate_from(json.at("v_x")), estimate_from(json.at("omega")), estimate_from(json.at("kinetic"))};
}

}  // namespace

PointStore::PointStore(std::filesystem::path folder) : folder_(std::move(folder)) {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error) throw WorkError(folder_.string() + ": cannot be made: " + error.message());
}

std::filesystem::path PointStore::file_of(const std::string& scene) const {
  // Two sums: with one of 32 bits, two of ten thousand points would share a file once in a hundred sweeps.
  const auto* bytes = reinterpret_cast<const Bytef*>(scene.data());
  return folder_ /
         fmt::format("{:08x}{:08x}.json", crc32_z(0, bytes, scene.size()), adler32_z(1, bytes, scene.size()));
}

std::optional<Outcome> PointStore::find(const scene::Scene& scene) const {
  const auto text = scene::to_toml(scene);
  try {
    const auto json = Json::parse(read_file(file_of(text)));
    if (json.at("commit") != run::commit || json.at("scene") != text) return {};
    Outcome outcome;
    outcome.left_physics = json.at("left_physics");
    for (const auto& start : json.at("starts")) outcome.starts.push_back(flow_from(start));
    return outcome;
  } catch (const std::exception&) {
    return {};  // not there, or damaged: it is made again
  }
}

void PointStore::put(const scene::Scene& scene, const Outcome& outcome) const {
  const auto text = scene::to_toml(scene);
  Json json{{"commit", run::commit}, {"left_physics", outcome.left_physics}, {"starts", Json::array()}};
  for (const auto& start : outcome.starts) json["starts"].push_back(to_json(start));
  json["scene"] = text;
  write_atomically(file_of(text), json.dump(1) + "\n");
}

Outcome PointStore::get(const scene::Scene& scene, const Report& progress) const {
  if (const auto known = find(scene)) return *known;
  if (!progress(0)) throw WorkError("stopped");
  const auto outcome = follow(scene, progress);
  put(scene, outcome);
  return outcome;
}

}  // namespace chute::sweep
