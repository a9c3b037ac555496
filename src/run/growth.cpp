#include "run/growth.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <map>
#include <sstream>

#include "common/error.hpp"
#include "common/toml_reader.hpp"
#include "io/checkpoint_file.hpp"
#include "scene/world.hpp"

namespace chute::run {
namespace {

constexpr const char* step_key = "engine.time_step";

/// Every key with its value as text: `wall[0].radius`.
void list_keys(const toml::node& node, const std::string& path, std::map<std::string, std::string>& keys) {
  if (const auto* table = node.as_table()) {
    for (const auto& [key, value] : *table)
      list_keys(value, fmt::format("{}{}{}", path, path.empty() ? "" : ".", key.str()), keys);
  } else if (node.is_array_of_tables()) {
    for (std::size_t i = 0; i < node.as_array()->size(); ++i)
      list_keys(*node.as_array()->get(i), fmt::format("{}[{}]", path, i), keys);
  } else {
    std::ostringstream text;
    node.visit([&](const auto& value) { text << value; });
    // toml++ would write 0.1 as 0.10000000000000001
    keys[path] = node.is_floating_point() ? fmt::format("{}", *node.value<double>()) : text.str();
  }
}

std::map<std::string, std::string> keys_of(const std::string& scene) {
  std::map<std::string, std::string> keys;
  list_keys(parse_toml(scene, "scene"), "", keys);
  return keys;
}

bool may_differ(const std::string& key) {
  return key == "title" || key == "run.duration" || key.starts_with("output.");
}

using KeyValues = std::map<std::string, std::string>;

std::optional<std::string> difference(const KeyValues& there, const KeyValues& here,
                                      const std::function<bool(const std::string& key)>& may_differ) {
  const auto value = [](const KeyValues& keys, const std::string& key) {
    const auto found = keys.find(key);
    return found == keys.end() ? std::string("not given") : found->second;
  };
  auto all = there;
  all.insert(here.begin(), here.end());
  // Defaults of outputs follow from other keys, of which those are named that differ.
  for (const bool outputs : {false, true}) {
    std::vector<std::string> different;
    for (const auto& [key, any] : all)
      if (key.starts_with("output.") == outputs && !may_differ(key) && value(there, key) != value(here, key))
        different.push_back(
            fmt::format("{} is {} there, and {} here", key, value(there, key), value(here, key)));
    if (!different.empty()) return fmt::format("{}", fmt::join(different, "; "));
  }
  return {};
}

double step_of(const scene::Scene& scene) { return scene.engine->step(scene::setting_of(scene)); }

/// Times that a schedule counts in steps should be whole numbers of them; where they came with the scene, the step was
/// chosen for them.
void check_intervals(const scene::Scene& scene, const scene::Scene& before, double step,
                     const std::string& where) {
  constexpr double whole = 1e-6;  // of a step, far above what doubles lose
  for (std::size_t k = 0; k < scene.output.size(); ++k) {
    const auto& output = scene.output[k];
    const double every = output->rhythm();
    const bool as_before = before.output[k]->wanted() && before.output[k]->rhythm() == every;
    if (!output->wanted() || !std::isfinite(every) || as_before) continue;
    const double steps = every / step;
    if (std::abs(steps - std::round(steps)) <= whole * std::max(1.0, steps)) continue;
    const double below = std::floor(steps), above = below + 1;
    throw InputError(fmt::format(
        "{}: output.{}: {:.10g} between two looks is no whole number of the run's steps of {:.10g}; {}{:.10g} is",
        where, output.word(), every, step, below > 0 ? fmt::format("{:.10g} or ", below * step) : "",
        above * step));
  }
}

}  // namespace

std::optional<std::string> difference_that_matters(const std::string& before, const std::string& now) {
  return difference(keys_of(before), keys_of(now), may_differ);
}

std::optional<std::string> difference_that_matters(
    const std::string& before, const std::string& now,
    const std::function<bool(const std::string& key)>& may_differ) {
  return difference(keys_of(before), keys_of(now), may_differ);
}

scene::Scene parse_to_go_on(std::string_view text, const std::string& name, std::vector<std::string> settings,
                            const std::filesystem::path& directory) {
  const auto checkpoint = directory / "checkpoint";
  if (!std::filesystem::exists(checkpoint)) return scene::parse_scene(text, name, settings);
  auto table = parse_toml(text, name);
  for (const auto& setting : settings) set_by_path(table, setting);
  if (!table.at_path("output.series.every")) {
    const auto before = parse_toml(io::read_checkpoint(checkpoint).scene, checkpoint.string());
    if (const auto every = before.at_path("output.series.every").value<double>())
      settings.push_back(fmt::format("output.series.every={}", *every));
  }
  return scene::parse_scene(text, name, settings);
}

scene::Scene grown(const scene::Scene& wanted, const std::string& before, const std::string& where) {
  const auto text = scene::to_toml(wanted);
  if (text == before) return wanted;
  const auto old = scene::parse_scene(before, where);
  const double step = step_of(old);
  auto there = keys_of(before), here = keys_of(text);
  const bool same_step = step_of(wanted) == step;
  // The step of a run that grew stands among its keys, where the scene that it came from leaves it open.
  const bool open = here.count(step_key) == 0;
  const bool pins = open && (!same_step || there.count(step_key) > 0);
  if (open || same_step) there.erase(step_key), here.erase(step_key);
  if (const auto other = difference(there, here, may_differ))
    throw InputError(
        fmt::format("{}: belongs to another scene: {}; what may change is {}", where, *other, may_change));
  check_intervals(wanted, old, step, where);
  return pins ? scene::parse_scene(text, where, {fmt::format("{}={}", step_key, step)}) : wanted;
}

}  // namespace chute::run
