#include "sweep/point_store.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "common/hash.hpp"
#include "run/flow.hpp"

namespace chute::sweep {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

PointStore::PointStore(std::filesystem::path folder) : folder_(std::move(folder)) {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error) throw WorkError(folder_.string() + ": cannot be made: " + error.message());
}

std::filesystem::path PointStore::file_of(const std::string& scene) const {
  return folder_ / (hash_of(build_hash() + scene).substr(0, 32) + ".json");
}

std::optional<Followed> PointStore::find(const scene::Scene& scene) const {
  const auto text = scene::to_toml(scene);
  try {
    const auto json = Json::parse(read_file(file_of(text)));
    if (json.at("build") != build_hash() || json.at("scene") != text) return {};
    Followed followed;
    followed.left_physics = json.at("left_physics");
    for (const auto& start : json.at("starts")) followed.starts.push_back(run::flow_from(start));
    return followed;
  } catch (const std::exception&) {
    return {};  // not there, or damaged: it is made again
  }
}

void PointStore::put(const scene::Scene& scene, const Followed& followed) const {
  const auto text = scene::to_toml(scene);
  Json json{{"build", build_hash()}, {"left_physics", followed.left_physics}, {"starts", Json::array()}};
  for (const auto& start : followed.starts) json["starts"].push_back(run::to_json(start));
  json["scene"] = text;
  write_atomically(file_of(text), json.dump(1) + "\n", Flush::later);
}

Followed PointStore::get(const scene::Scene& scene, const Report& progress) const {
  if (const auto known = find(scene)) return *known;
  if (only_known_) throw PointIsMissing{};
  if (!progress(0)) throw WorkError("stopped");
  auto followed = follow(scene, progress);
  put(scene, followed);
  return followed;
}

}  // namespace chute::sweep
