#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>

#include "app/input.hpp"
#include "app/interrupt.hpp"
#include "app/progress.hpp"
#include "app/say.hpp"
#include "app/verbs.hpp"
#include "common/error.hpp"
#include "common/toml_reader.hpp"
#include "engines/lammps/dump_frame.hpp"
#include "run/run.hpp"

namespace chute::app {
namespace {

namespace fs = std::filesystem;

struct ImportArguments {
  std::string folder, directory;
  bool force = false, quiet = false;
};

/// LAMMPS may still be writing the last dump, or was killed while it did.
void leave_out_unfinished(std::vector<std::int64_t>& steps, const fs::path& dumps) {
  if (steps.empty()) return;
  try {
    lammps::read_dump_frame(dumps / fmt::format("grains.{:012}", steps.back()));
  } catch (const InputError& error) {
    tell("import: {}: left out\n", error.what());
    steps.pop_back();
  }
}

/// A dump in the middle that cannot be read would end the import when half of a run is written, and with --force in place of
/// a whole one.
void read_all_once(const std::vector<std::int64_t>& steps, const fs::path& dumps) {
  const auto contacts = dumps.parent_path() / "contacts";
  for (const auto step : steps) {
    lammps::read_dump_frame(dumps / fmt::format("grains.{:012}", step));
    const auto network = contacts / fmt::format("contacts.{:012}", step);
    if (fs::exists(network)) lammps::read_dump_frame(network);
  }
}

/// All outputs of the scene look at the dumps, no more and no less.
std::vector<std::string> settings_for(const Input& input, const fs::path& dumps) {
  const auto table = parse_toml(input.text, input.name);
  const TomlReader reader(table, input.name);
  const auto dt = table["engine"]["time_step"].value<double>();
  if (!dt || table["engine"]["method"].value_or(std::string()) != "lammps")
    reader.fail("engine",
                "is not the scene of an export: chute export writes method = \"lammps\" with its time_step");
  auto steps = lammps::steps_in(dumps, "grains");
  leave_out_unfinished(steps, dumps);
  if (steps.size() < 2)
    throw InputError(dumps.string() +
                     ": no dumps grains.STEP, two at least: has LAMMPS run there (lmp -in in.lammps)?");
  const auto between = steps[1] - steps[0];
  for (std::size_t k = 0; k < steps.size(); ++k)
    if (steps[k] != static_cast<std::int64_t>(k) * between)
      throw InputError(fmt::format("{}: the dump of step {} is missing", dumps.string(),
                                   static_cast<std::int64_t>(k) * between));
  read_all_once(steps, dumps);
  const double every = static_cast<double>(between) * *dt;
  std::vector<std::string> settings{fmt::format("engine.dumps={}", dumps.string()),
                                    fmt::format("run.duration={}", static_cast<double>(steps.back()) * *dt)};
  if (const auto* output = table["output"].as_table())
    for (const auto& [word, keys] : *output) {
      const auto* of = keys.as_table();
      if (!of || !(of->contains("every") || word == "profiles" || word == "fields")) continue;
      settings.push_back(fmt::format("output.{}.every={}", word.str(), every));
      if (of->contains("samples")) settings.push_back(fmt::format("output.{}.samples=1", word.str()));
      if (const auto from = (*of)["from"].value<double>(); from && *from > 0)
        settings.push_back(
            fmt::format("output.{}.from={}", word.str(), std::ceil(*from / every - 1e-9) * every));
    }
  return settings;
}

void import_run(const ImportArguments& a) {
  const fs::path folder = a.folder;
  const auto input = read_input((folder / "scene.toml").string());
  const auto scene = scene::parse_scene(input.text, input.name, settings_for(input, folder / "dumps"));
  run::RunOptions options;
  options.directory = a.directory.empty() ? folder / "run" : fs::path(a.directory);
  options.existing = a.force ? run::Existing::replace : run::Existing::refuse;
  options.checkpoint_seconds = 0;
  options.command_line = command_line();
  options.way_on = "the same command with --force begins again";
  watch_for_interrupt();
  Progress progress("import", a.quiet);
  options.progress = [&](double part) {
    progress.show(part);
    return !interrupted();
  };
  const auto result = run::run_scene(scene, options);
  if (!result.finished) throw WorkError("stopped; " + options.way_on);
  if (!a.quiet)
    tell("import: {} steps of {} grains; files in {}\n", result.steps, result.grains,
         options.directory.string());
}

}  // namespace

void add_import(CLI::App& app) {
  auto* verb = app.add_subcommand("import", "Take what LAMMPS made of an exported scene as a run");
  auto a = std::make_shared<ImportArguments>();
  verb->add_option("folder", a->folder, "folder of chute export, in which LAMMPS has run")->required();
  verb->add_option("-o,--output", a->directory, "run directory; default FOLDER/run");
  verb->add_flag("--force", a->force, "replace a run that is already there");
  verb->add_flag("--quiet", a->quiet, "no progress line");
  verb->footer("Example: chute import out/lammps -o out/from-lammps && chute render out/from-lammps");
  verb->callback([a] { import_run(*a); });
}

}  // namespace chute::app
