#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/input.hpp"
#include "app/progress.hpp"
#include "app/settings.hpp"
#include "app/verbs.hpp"
#include "common/error.hpp"
#include "common/toml_reader.hpp"
#include "experiments/experiment.hpp"
#include "run/facts.hpp"
#include "run/machine.hpp"
#include "run/session.hpp"
#include "sweep/sweep_file.hpp"

namespace chute::app {
namespace {

/// A scene as a run would take it, and what follows from it.
struct Checked {
  std::string name, resolved;
  std::vector<Fact> facts;
  std::vector<std::string> warnings, chosen{};
};

/// A session takes the memory that a run does, so that it is made only where that is there.
void refuse_what_a_run_would(const scene::Scene& scene, const std::string& name, bool beyond_machine) {
  if (!beyond_machine) run::refuse_beyond_machine(scene, name, {});
  if (run::beyond_machine(scene, {}).empty()) run::Session(scene, 1);
}

Checked check(const std::string& file, const std::vector<std::string>& settings, bool beyond_machine) {
  const auto input = read_input(file);
  refuse_recipe(input);
  Checked found{input.name, {}, {}, {}};
  const sweep::Base base{input.name, settings, input.text};
  if (experiments::is_experiment(input.text, input.name)) {
    const auto experiment = experiments::parse_experiment(input.text, input.name, settings);
    found.resolved = to_toml(experiment), found.facts = experiments::facts(experiment);
  } else if (sweep::is_sweep(base)) {
    const auto spec = sweep::read_sweep(base);
    const auto places = sweep::grid(spec.axes);
    double cost = 0;
    for (const auto& place : places) {
      const auto scene = base.scene(place.set);
      refuse_what_a_run_would(scene, input.name, beyond_machine);
      cost += run::cost_of(scene);
    }
    sweep::Base kept = base;
    kept.outputs = true;
    const auto runs = static_cast<double>(places.size()) * static_cast<double>(spec.seeds);
    constexpr double point = 4e3;  // bytes of a point's file
    found.resolved = sweep::to_toml(base, spec), found.facts = run::facts(base.scene(places.front().set));
    found.facts.push_back(
        {"places", static_cast<double>(places.size()), "", "places of the grid; the rest is of the first"});
    if (!spec.boundary) {
      found.facts.push_back({"runs", runs, "", "places times seeds"});
      found.facts.push_back({"cost of all", cost * static_cast<double>(spec.seeds), "s",
                             "rough time on one core; --jobs N shares it"});
      found.facts.push_back({"disk", point * runs, "B", "of the finished points, about"});
      found.facts.push_back({"disk of runs", run::disk_of(kept.scene(places.front().set)) * runs, "B",
                             "with --keep-runs, about"});
    }
  } else {
    const auto scene = scene::parse_scene(input.text, input.name, settings);
    refuse_what_a_run_would(scene, input.name, beyond_machine);
    found.resolved = to_toml(scene), found.facts = run::facts(scene), found.warnings = run::warnings(scene);
    found.chosen = scene.chosen;
  }
  return found;
}

/// "3.2 MB"
std::string size_text(double bytes) {
  constexpr std::array units{"B", "kB", "MB", "GB", "TB"};
  std::size_t k = 0;
  while (bytes >= 1000 && k + 1 < units.size()) bytes /= 1000, ++k;
  return fmt::format("{:.3g} {}", bytes, units[k]);
}

void show(const Checked& found) {
  fmt::print("# {}: the complete scene\n{}\n# what follows from it\n", found.name, found.resolved);
  for (const auto& fact : found.facts) {
    const auto value = fact.name.starts_with("cost")   ? duration_text(fact.value)
                       : fact.name.starts_with("disk") ? size_text(fact.value)
                                                       : fmt::format("{:.6g} {}", fact.value, fact.unit);
    fmt::print("# {:<16} {:<26} {}\n", fact.name, value, fact.meaning);
  }
  for (const auto& line : found.chosen) fmt::print("# chosen: {}\n", line);
  for (const auto& warning : found.warnings) fmt::print("# warning: {}\n", warning);
}

nlohmann::ordered_json as_json(const Checked& found) {
  std::ostringstream scene;
  scene << toml::json_formatter{parse_toml(found.resolved, found.name)};
  auto facts = nlohmann::ordered_json::array();
  for (const auto& fact : found.facts)
    facts.push_back(
        {{"name", fact.name}, {"value", fact.value}, {"unit", fact.unit}, {"meaning", fact.meaning}});
  return {{"file", found.name},
          {"scene", nlohmann::ordered_json::parse(scene.str())},
          {"facts", facts},
          {"chosen", found.chosen},
          {"warnings", found.warnings}};
}

}  // namespace

void add_check(CLI::App& app) {
  auto* verb = app.add_subcommand("check", "Validate scenes; print each complete, with what follows from it");
  struct Arguments {
    std::vector<std::string> scenes, settings;
    bool keys = false, json = false, beyond_machine = false;
  };
  auto a = std::make_shared<Arguments>();
  verb->add_option("scenes", a->scenes, "scene files (TOML); -: standard input");
  verb->add_flag("--keys", a->keys, "print every key that a scene can have, with what it means");
  verb->add_flag("--json", a->json, "for programs: keys as in README.md");
  add_settings(*verb, "--set", "KEY=VALUE", a->settings, "change a key: grains.count=100");
  verb->add_flag("--beyond-machine", a->beyond_machine,
                 "of a run for another machine: not refused for the memory and the disk of this one");
  verb->footer("Example: chute check scenes/chute-2d.toml");
  verb->callback([a] {
    if (a->keys) fmt::print("{}", scene::keys_table());
    if (!a->keys && a->scenes.empty())
      throw InputError("check: name a scene file, or --keys for what can stand in one");
    auto all = nlohmann::ordered_json::array();
    for (const auto& file : a->scenes) {
      const auto found = check(file, a->settings, a->beyond_machine);
      if (a->json)
        all.push_back(as_json(found));
      else
        show(found);
    }
    if (a->json)
      fmt::print("{}\n", nlohmann::ordered_json{{"scenes", all}}.dump(
                             2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
  });
}

}  // namespace chute::app
