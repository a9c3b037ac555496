#include <fmt/format.h>

#include <charconv>
#include <filesystem>

#include "app/input.hpp"
#include "app/interrupt.hpp"
#include "app/progress.hpp"
#include "app/say.hpp"
#include "app/settings.hpp"
#include "app/verbs.hpp"
#include "common/error.hpp"
#include "run/machine.hpp"
#include "sweep/sweep.hpp"
#include "sweep/sweep_file.hpp"

namespace chute::app {
namespace {

namespace fs = std::filesystem;

struct SweepArguments {
  std::string scene, directory, shard;
  std::vector<std::string> settings, more;
  int jobs = 1;
  bool resume = false, keep_runs = false, quiet = false, beyond_machine = false;
};

/// "3/8" as shard 3 of 8.
void read_shard(const std::string& text, sweep::SweepOptions& options) {
  const char *at = text.data(), *end = at + text.size();
  const auto first = std::from_chars(at, end, options.shard);
  const bool slash = first.ec == std::errc{} && first.ptr != end && *first.ptr == '/';
  const auto second = slash ? std::from_chars(first.ptr + 1, end, options.shards) : first;
  if (!slash || second.ec != std::errc{} || second.ptr != end || options.shard < 1 ||
      options.shard > options.shards)
    throw InputError(fmt::format("--shard {}: expected I/N with 1 <= I <= N, such as 3/8", text));
}

/// The first place and the last have the least and the most of whatever grows along an axis.
void refuse_beyond_machine(const sweep::Base& base, const std::string& name, const fs::path& directory) {
  const auto places = sweep::grid(sweep::read_sweep(base).axes);
  for (const auto* place : {&places.front(), &places.back()})
    run::refuse_beyond_machine(base.scene(place->set), name, directory);
}

void run(const SweepArguments& arguments) {
  // A sweep in place of a scene: what it says of itself, and it goes on where it lies.
  const bool of_sweep = fs::is_directory(arguments.scene);
  if (!of_sweep && arguments.directory.empty())
    throw InputError("sweep: say with -o where the tables and the finished points go");
  sweep::Base base{of_sweep ? fs::path(arguments.scene) / "sweep.toml" : fs::path(arguments.scene),
                   arguments.settings};
  if (!of_sweep) refuse_recipe({arguments.scene, base.text});
  if (!arguments.more.empty()) base.set.push_back(sweep::with_more_values(base, arguments.more));
  sweep::SweepOptions options;
  options.directory = arguments.directory.empty() ? arguments.scene : arguments.directory;
  options.jobs = arguments.jobs;
  options.resume = arguments.resume;
  options.keep_runs = arguments.keep_runs || (arguments.resume && fs::exists(options.directory / "runs"));
  options.command_line = command_line();
  if (!arguments.shard.empty()) read_shard(arguments.shard, options);
  if (!arguments.beyond_machine) refuse_beyond_machine(base, arguments.scene, options.directory);
  Progress progress("sweep", arguments.quiet);
  watch_for_interrupt();
  options.progress = [&](double part) {
    progress.show(part);
    return !interrupted();
  };
  bool whole = false;
  try {
    whole = sweep::run_sweep(base, options);
  } catch (const WorkError&) {
    if (!interrupted()) throw;
    throw WorkError(fmt::format("stopped; what is done is kept: go on with: chute sweep {} --resume{}",
                                options.directory.string(),
                                arguments.shard.empty() ? "" : " --shard " + arguments.shard));
  }
  if (arguments.quiet) return;
  if (whole)
    tell("sweep: tables in {}\n", options.directory.string());
  else
    tell("sweep: shard {} of {} done; the tables follow when all are\n", options.shard, options.shards);
}

}  // namespace

void add_sweep(CLI::App& app) {
  auto* verb =
      app.add_subcommand("sweep", "Simulate a grid of parameters, or find phase boundaries, into one table");
  auto a = std::make_shared<SweepArguments>();
  verb->add_option("scene", a->scene, "scene file (TOML) with [sweep], or the folder of a sweep")->required();
  verb->add_option("-o,--output", a->directory, "folder for the tables and the finished points");
  add_settings(*verb, "--add", "KEY=VALUE,VALUE", a->more,
               "more values of an axis, or an axis more; with --resume what is done stays");
  add_settings(*verb, "--set", "KEY=VALUE", a->settings, "change a key of the scene");
  verb->add_option("--jobs", a->jobs, "points side by side; results do not depend on it")
      ->check(CLI::Range(1, 1024));
  verb->add_option("--shard", a->shard, "I/N: do only the I-th of N parts; the parts share the folder");
  verb->add_flag("--resume", a->resume,
                 "go on with an interrupted sweep, or with one whose [sweep] has grown: what is done stays");
  verb->add_flag("--keep-runs", a->keep_runs, "keep every run in runs/, with all outputs of the scene");
  verb->add_flag("--beyond-machine", a->beyond_machine,
                 "begin, though memory or disk will hardly do for one of its runs");
  verb->add_flag("--quiet", a->quiet, "no progress line");
  verb->footer(
      "Example: chute sweep scenes/sweep-ball.toml -o out/sweep --jobs 2\n"
      "In an array job: chute sweep SCENE -o DIR --shard $SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT");
  verb->callback([a] { run(*a); });
}

}  // namespace chute::app
