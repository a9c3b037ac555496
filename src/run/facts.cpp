#include "run/facts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/toml_reader.hpp"
#include "scene/open_ends.hpp"
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
  const auto of_ends = scene::facts_of_open_ends(scene);
  list.insert(list.end(), of_ends.begin(), of_ends.end());
  list.push_back({"steps", std::ceil(scene.duration / scene.engine->step(setting)), "", "steps of the run"});
  if (const double cost = cost_of(scene); cost > 0)
    list.push_back({"cost", cost, "s", "rough time on one core"});
  list.push_back({"disk", disk_of(scene), "B", "that the run directory takes, about"});
  return list;
}

double cost_of(const scene::Scene& scene) {
  const auto setting = scene::setting_of(scene);
  return std::ceil(scene.duration / scene.engine->step(setting)) * scene.engine->seconds_per_step(setting);
}

double disk_of(const scene::Scene& scene) {
  // Measured on scenes/chute-2d.toml and chute-3d.toml: VTK's compressed files take 5 kB and 70 bytes a grain, in space 105, the network
  // about as much where most grains touch; a row of the series 230 and again as much in the checkpoint, with 400 to 550 a grain.
  const double grain_in_frame = scene.dimensions == 3 ? 105 : 70;
  constexpr double file = 5e3, network_of_grain = 100, row = 460, in_checkpoint = 500, rest = 1e4;
  const auto setting = scene::setting_of(scene);
  const auto grains = static_cast<double>(setting.grains);
  const double beads =
      setting.bead_spacing > 0
          ? std::max(1.0, setting.size[0] / setting.bead_spacing) *
                std::max(1.0, setting.dimensions == 3 ? setting.size[1] / setting.bead_spacing : 1)
          : 0;
  double bytes = rest + in_checkpoint * grains;
  for (const auto& output : scene.output) {
    if (!output->wanted() || !std::isfinite(output->rhythm())) continue;
    const double times = scene.duration / output->rhythm() + 1;
    if (output.word() == "frames") {
      const bool network = output->needs().contacts;
      bytes += times *
               (file + grain_in_frame * (grains + beads) + (network ? file + network_of_grain * grains : 0));
    } else if (output.word() == "series") {
      bytes += times * row;
    }
  }
  return bytes;
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

/// Outputs whose times are rounded to steps, for no step within reason divides all intervals.
std::vector<std::string> outputs_between_steps(const scene::Scene& scene) {
  constexpr double whole = 1e-6;  // of a step, far above what doubles lose
  const double step = scene.engine->step(scene::setting_of(scene));
  std::vector<std::string> told;
  for (const auto& output : scene.output) {
    if (!output->wanted() || !std::isfinite(output->rhythm())) continue;
    const double steps = output->rhythm() / step;
    if (steps > 1 && std::abs(steps - std::round(steps)) > whole * steps)
      told.push_back(fmt::format(
          "output.{}: {:g} between two looks is no whole number of steps: each comes at the step that is nearest",
          output.word(), output->rhythm()));
  }
  return told;
}

}  // namespace

std::vector<std::string> warnings(const scene::Scene& scene) {
  auto told = scene.engine->warnings(scene::setting_of(scene));
  for (auto& warning : scene::warnings_of_open_ends(scene)) told.push_back(std::move(warning));
  for (auto& warning : outputs_beyond_the_end(scene)) told.push_back(std::move(warning));
  for (auto& warning : outputs_between_steps(scene)) told.push_back(std::move(warning));
  return told;
}

}  // namespace chute::run
