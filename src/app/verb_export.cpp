#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>

#include "app/input.hpp"
#include "app/say.hpp"
#include "app/settings.hpp"
#include "app/verbs.hpp"
#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "common/new_folder.hpp"
#include "common/toml_reader.hpp"
#include "engines/lammps/deck.hpp"
#include "measure/outputs.hpp"
#include "scene/world.hpp"

namespace chute::app {
namespace {

namespace fs = std::filesystem;

struct ExportArguments {
  std::string scene, folder;
  std::vector<std::string> settings;
  bool quiet = false;
};

toml::table table_of(const Input& input, const std::vector<std::string>& settings) {
  auto table = parse_toml(input.text, input.name);
  for (const auto& setting : settings) set_by_path(table, setting);
  return table;
}

/// What LAMMPS does is what the soft engine does with verlet; other methods are other physics.
void refuse_other_methods(const Input& input, const std::vector<std::string>& settings) {
  const auto table = table_of(input, settings);
  const TomlReader reader(table, input.name);
  const auto method = table["engine"]["method"].value_or(std::string("soft"));
  if (method != "soft" && method != "lammps")
    reader.fail("engine.method",
                fmt::format("\"{}\": LAMMPS moves soft grains; give \"soft\" or \"lammps\"", method));
  const auto integrator =
      table["engine"]["integrator"].value_or(std::string(method == "soft" ? "gear5" : "verlet"));
  if (integrator != "verlet")
    reader.fail(
        "engine.integrator",
        fmt::format("\"{}\"{} is no integrator of LAMMPS, which has verlet: --set engine.integrator=verlet",
                    integrator, table["engine"]["integrator"] ? "" : ", the default,"));
}

/// What watches single impacts has nothing to see in dumps: such outputs of the scene go.
void leave_out_impacts(const Input& input, std::vector<std::string>& settings) {
  const auto table = table_of(input, settings);
  for (const auto& kind : measure::list()) {
    const auto output = kind.make();
    if (!output->needs().impacts || !table["output"][kind.word]) continue;
    tell("export: output.{} is left out: LAMMPS tells of no impacts\n", kind.word);
    settings.push_back(fmt::format("output.{}=", kind.word));
  }
}

template <int D>
lammps::Deck deck_of(const scene::Scene& scene, double dt, const TomlReader& reader) {
  const auto made = lammps::make_deck<D>(scene::make_world<D>(scene), scene::setting_of(scene), dt);
  if (made.wrong) reader.fail(made.wrong->key, made.wrong->message);
  return made.deck;
}

void export_scene(const ExportArguments& a) {
  NewFolder made(a.folder, [](const fs::path& name) {
    return name == "scene.toml" || name == "grains.data" || name == "in.lammps";
  });
  const bool of_run = fs::is_directory(a.scene);
  const auto input = read_input(of_run ? (fs::path(a.scene) / "scene.toml").string() : a.scene);
  refuse_other_methods(input, a.settings);
  auto settings = a.settings;
  leave_out_impacts(input, settings);
  settings.emplace_back("engine.method=lammps");
  auto scene = scene::parse_scene(input.text, input.name, settings);
  // The step is part of what is exported: what comes back is looked at in other intervals.
  const double dt = scene.engine->step(scene::setting_of(scene));
  settings.push_back(fmt::format("engine.time_step={}", dt));
  scene = scene::parse_scene(input.text, input.name, settings);
  const auto table = table_of(input, settings);
  const TomlReader reader(table, input.name);
  const auto deck = scene.dimensions == 2 ? deck_of<2>(scene, dt, reader) : deck_of<3>(scene, dt, reader);
  const auto* frames = scene.wants<measure::FramesOutput>();
  const double every =
      frames && frames->frames ? frames->frames->every : scene.wants<measure::SeriesOutput>()->series.every;
  const auto steps = std::max(1LL, std::llround(scene.duration / dt)),
             between = std::max(1LL, std::llround(every / dt));
  const fs::path folder = a.folder;
  made.make();
  write_atomically(folder / "scene.toml", scene::to_toml(scene));
  write_atomically(folder / "grains.data", deck.data);
  write_atomically(folder / "in.lammps", lammps::input_script(deck, steps, between));
  made.keep();
  if (!a.quiet)
    tell(
        "export: {} steps, a dump every {}; there: mpirun -n RANKS lmp -in in.lammps; then: chute import {}\n",
        steps, between, a.folder);
}

}  // namespace

void add_export(CLI::App& app) {
  auto* verb =
      app.add_subcommand("export", "Write a scene as a folder that LAMMPS runs, here or on a cluster");
  auto a = std::make_shared<ExportArguments>();
  verb->add_option("scene", a->scene,
                   "scene file (TOML), or a run directory for its scene; -: standard input")
      ->required();
  verb->add_option("--lammps", a->folder, "folder for grains.data, in.lammps and scene.toml; new or empty")
      ->required();
  add_settings(*verb, "--set", "KEY=VALUE", a->settings,
               "change a key of the scene: engine.integrator=verlet");
  verb->add_flag("--quiet", a->quiet, "no word of what was written");
  verb->footer(
      "Example: chute export scenes/chute-3d.toml --set engine.integrator=verlet --lammps out/lammps");
  verb->callback([a] { export_scene(*a); });
}

}  // namespace chute::app
