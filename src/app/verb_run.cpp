#include <fmt/format.h>

#include <cmath>
#include <thread>

#include "app/input.hpp"
#include "app/interrupt.hpp"
#include "app/numbers.hpp"
#include "app/progress.hpp"
#include "app/say.hpp"
#include "app/settings.hpp"
#include "app/verbs.hpp"
#include "common/error.hpp"
#include "experiments/perform.hpp"
#include "run/facts.hpp"
#include "run/growth.hpp"
#include "run/machine.hpp"
#include "run/run.hpp"

namespace chute::app {
namespace {

namespace fs = std::filesystem;

struct RunArguments {
  std::string scene, directory;
  std::vector<std::string> settings;
  int threads = 1, ranks = 1;
  double checkpoint_minutes = 5;
  bool resume = false, force = false, quiet = false, beyond_machine = false;
};

/// An experiment takes seconds at most: there is nothing to show or to resume, but the results to print.
void experiment(const RunArguments& arguments, const Input& scene, const run::RunOptions& options) {
  const auto outcome = experiments::run_experiment(
      experiments::parse_experiment(scene.text, scene.name, arguments.settings), options);
  if (arguments.quiet) return;
  for (const auto& result : outcome.results)
    fmt::print("{:<14} {:<22} {}\n", result.name, fmt::format("{:.6g} {}", result.value, result.unit),
               result.meaning);
  tell("run: {} steps; files in {}\n", outcome.steps, options.directory.string());
}

void run(const RunArguments& arguments) {
  if (arguments.resume && arguments.force) throw InputError("--resume and --force exclude each other");
  // A run in place of a scene: its own scene, and it goes on where it lies.
  const bool of_run = std::filesystem::is_directory(arguments.scene);
  const auto input =
      read_input(of_run ? (fs::path(arguments.scene) / "scene.toml").string() : arguments.scene);
  run::RunOptions options;
  options.directory = !arguments.directory.empty() ? fs::path(arguments.directory)
                      : of_run                     ? fs::path(arguments.scene)
                                                   : fs::path("out") / fs::path(input.name).stem();
  options.existing = arguments.resume  ? run::Existing::resume
                     : arguments.force ? run::Existing::replace
                                       : run::Existing::refuse;
  options.threads = arguments.threads;
  options.checkpoint_seconds = 60 * arguments.checkpoint_minutes;
  options.command_line = command_line();
  options.way_on = fmt::format("go on with: chute run {} --resume", options.directory.string());
  // An interrupted run leaves a checkpoint, so that --resume goes on from there.
  watch_for_interrupt();
  refuse_recipe(input);
  if (experiments::is_experiment(input.text, input.name)) return experiment(arguments, input, options);
  const auto scene = arguments.resume
                         ? run::parse_to_go_on(input.text, input.name, arguments.settings, options.directory)
                         : scene::parse_scene(input.text, input.name, arguments.settings);
  const bool of_lammps = scene.engine.word() == "lammps";
  if (arguments.ranks > 1 && !of_lammps)
    throw InputError(
        fmt::format("--ranks: for engine.method = \"lammps\"; \"{}\" takes --threads", scene.engine.word()));
  if (of_lammps) options.threads = arguments.ranks;
  // What a run that goes on has written already would count twice against the disk.
  if (!arguments.beyond_machine && !arguments.resume)
    run::refuse_beyond_machine(scene, input.name, options.directory);
  // A run that goes on was told both when it began.
  if (!arguments.quiet && !arguments.resume) {
    for (const auto& warning : run::warnings(scene)) tell("warning: {}\n", warning);
    for (const auto& line : scene.chosen)
      if (line.starts_with("contact.")) tell("chosen: {}\n", line);
  }
  Progress progress("run", arguments.quiet);
  options.progress = [&](double part) {
    progress.show(part);
    return !interrupted();
  };
  options.warn = [](const std::string& what) { tell("warning: {}\n", what); };
  const auto result = run::run_scene(scene, options);
  if (!result.finished) throw WorkError("stopped; " + options.way_on);
  if (!arguments.quiet)
    tell(
        "run: {} steps in {}, {:.1f} million grain steps per second; files in {}\n"
        "run: to see what came of it: chute report {} -o report.html\n",
        result.steps, duration_text(result.seconds),
        static_cast<double>(result.steps) * static_cast<double>(result.grains) / result.seconds / 1e6,
        options.directory.string(), options.directory.string());
  if (const auto& account = result.account) {
    if (account->poor())
      tell(
          "warning: the energy account is off by {:.3g} % of what was turned over: do not trust this run; smaller steps "
          "(engine.steps_per_contact) or softer friction (contact.tangential.viscosity) help\n",
          100 * account->part);
    else if (!arguments.quiet)
      tell("run: the energy account closes to {:.2g} %: {}\n", 100 * std::abs(account->part), account->word);
  }
}

}  // namespace

void add_run(CLI::App& app) {
  auto* verb = app.add_subcommand("run", "Simulate a scene into a run directory");
  auto a = std::make_shared<RunArguments>();
  verb->add_option("scene", a->scene,
                   "scene file (TOML), or a run directory for its scene; -: standard input")
      ->required();
  verb->add_option("-o,--output", a->directory, "run directory; default out/NAME-OF-SCENE");
  add_settings(*verb, "--set", "KEY=VALUE", a->settings,
               "change a key of the scene: contact.normal.restitution=0.7");
  verb->add_option("--threads", a->threads, "threads; results do not depend on it")
      ->check(CLI::Range(1, 1024));
  verb->add_option("--ranks", a->ranks, "of engine.method = \"lammps\": processes of MPI (mpirun -n)")
      ->check(CLI::Range(1, 100000));
  verb->add_flag("--resume", a->resume,
                 "go on with a run; run.duration and what stands in [output] may be others than before");
  verb->add_option("--checkpoint-minutes", a->checkpoint_minutes,
                   "a checkpoint after so many minutes of the clock, too; 0: only those of the scene")
      ->check(not_negative)
      ->capture_default_str();
  verb->add_flag("--force", a->force, "replace a run that is already there");
  verb->add_flag("--beyond-machine", a->beyond_machine,
                 "begin, though memory or disk will hardly do by the estimate of `chute check`");
  verb->add_flag("--quiet", a->quiet, "no progress line");
  std::string methods = "Methods (engine.method); their keys: chute check --keys\n";
  for (const auto& kind : engines::list()) methods += fmt::format("  {:<15} {}\n", kind.word, kind.text);
  verb->footer(methods + "Example: chute run scenes/demo.toml -o out/demo --set incline.angle='\"20 deg\"'");
  verb->callback([a] { run(*a); });
}

}  // namespace chute::app
