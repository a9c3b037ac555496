#include "run/facts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/toml_reader.hpp"
#include "scene/world.hpp"

namespace chute::run {

std::vector<Fact> facts(const scene::Scene& scene) {
  const auto setting = scene::setting_of(scene);
  const double d = setting.mean_diameter, d_bed = setting.bead_diameter;
  std::vector<Fact> list{{"theta", setting.theta * 180 / std::numbers::pi, "deg", "inclination"},
                         {"m", setting.mean_mass, setting.in("kg", "m"), "mass of a mean grain"}};
  const auto own = scene.engine->facts(setting);
  list.insert(list.end(), own.begin(), own.end());
  if (setting.bead_spacing > 0) {
    const double gap = setting.widest_spacing / d_bed - 1;
    list.push_back({"Phi", d / d_bed, "", "size ratio R/r"});
    list.push_back({"gamma_max", std::asin(std::min(1.0, (1 + gap) / (1 + d / d_bed))), "rad",
                    "largest impact angle on the bed, (4.21)"});
  }
  const auto of_bed = scene.bed->facts({scene.dimensions, static_cast<std::uint64_t>(scene.seed)});
  list.insert(list.end(), of_bed.begin(), of_bed.end());
  const double steps = std::ceil(scene.duration / scene.engine->step(setting));
  list.push_back({"steps", steps, "", "steps of the run"});
  if (const double cost = scene.engine->seconds_per_step(setting); cost > 0)
    list.push_back({"cost", steps * cost, "s", "rough time on one core"});
  return list;
}

namespace {

/// Outputs that will never have anything to write: their keys are read from the complete scene, whatever kind they are.
std::vector<std::string> outputs_beyond_the_end(const scene::Scene& scene) {
  std::vector<std::string> told;
  const auto complete = parse_toml(scene::to_toml(scene), scene.title);
  const auto* outputs = complete["output"].as_table();
  if (!outputs) return told;
  for (const auto& [name, node] : *outputs) {
    const auto* output = node.as_table();
    if (!output) continue;
    const auto beyond = [&, key = std::string(name.str())](const char* what, const char* follows) {
      const auto value = (*output)[what].value<double>();
      if (value && *value > scene.duration)
        told.push_back(fmt::format("output.{}.{} = {:g} lies beyond the end of the run at {:g}: {}", key,
                                   what, *value, scene.duration, follows));
      return value && *value > scene.duration;
    };
    if (!beyond("from", "it is written without anything in it"))
      beyond("every", "only its first time is written");
  }
  return told;
}

}  // namespace

std::vector<std::string> warnings(const scene::Scene& scene) {
  auto told = scene.engine->warnings(scene::setting_of(scene));
  for (auto& warning : outputs_beyond_the_end(scene)) told.push_back(std::move(warning));
  return told;
}

}  // namespace chute::run
