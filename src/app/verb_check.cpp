#include <fmt/format.h>

#include "app/progress.hpp"
#include "app/verbs.hpp"
#include "common/error.hpp"
#include "experiments/experiment.hpp"
#include "run/facts.hpp"
#include "run/session.hpp"
#include "sweep/sweep_file.hpp"

namespace chute::app {
namespace {

void check(const std::string& file, const std::vector<std::string>& settings) {
  std::string resolved;
  std::vector<Fact> facts;
  std::vector<std::string> warnings;
  if (experiments::is_experiment(file)) {
    const auto experiment = experiments::read_experiment(file, settings);
    resolved = to_toml(experiment), facts = experiments::facts(experiment);
  } else if (const sweep::Base base{file, settings}; sweep::is_sweep(base)) {
    const auto spec = sweep::read_sweep(base);
    const auto places = sweep::grid(spec.axes);
    for (const auto& place : places) run::Session(base.scene(place.set), 1);
    resolved = sweep::to_toml(base, spec), facts = run::facts(base.scene(places.front().set));
    facts.push_back(
        {"places", static_cast<double>(places.size()), "", "places of the grid; the rest is of the first"});
  } else {
    const auto scene = scene::read_scene(file, settings);
    const run::Session refuses_what_a_run_would(scene, 1);
    resolved = to_toml(scene), facts = run::facts(scene), warnings = run::warnings(scene);
  }
  fmt::print("# {}: the complete scene\n{}\n# what follows from it\n", file, resolved);
  for (const auto& fact : facts) {
    const auto value =
        fact.name == "cost" ? duration_text(fact.value) : fmt::format("{:.6g} {}", fact.value, fact.unit);
    fmt::print("# {:<16} {:<26} {}\n", fact.name, value, fact.meaning);
  }
  for (const auto& warning : warnings) fmt::print("# warning: {}\n", warning);
}

}  // namespace

void add_check(CLI::App& app) {
  auto* verb = app.add_subcommand("check", "Validate scenes; print each complete, with what follows from it");
  struct Arguments {
    std::vector<std::string> scenes, settings;
    bool keys = false;
  };
  auto a = std::make_shared<Arguments>();
  verb->add_option("scenes", a->scenes, "scene files (TOML)");
  verb->add_flag("--keys", a->keys, "print every key that a scene can have, with what it means");
  verb->add_option("--set", a->settings, "change a key: --set grains.count=100")->allow_extra_args(false);
  verb->footer("Example: chute check scenes/chute-2d.toml");
  verb->callback([a] {
    if (a->keys) fmt::print("{}", scene::keys_table());
    if (!a->keys && a->scenes.empty())
      throw InputError("check: name a scene file, or --keys for what can stand in one");
    for (const auto& file : a->scenes) check(file, a->settings);
  });
}

}  // namespace chute::app
