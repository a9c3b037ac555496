#include <fmt/format.h>

#include <charconv>

#include "app/interrupt.hpp"
#include "app/progress.hpp"
#include "app/say.hpp"
#include "app/verbs.hpp"
#include "common/error.hpp"
#include "sweep/sweep.hpp"

namespace chute::app {
namespace {

struct SweepArguments {
  std::string scene, directory, shard;
  std::vector<std::string> settings;
  int jobs = 1;
  bool resume = false, quiet = false;
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

void run(const SweepArguments& arguments) {
  const sweep::Base base{arguments.scene, arguments.settings};
  sweep::SweepOptions options;
  options.directory = arguments.directory;
  options.jobs = arguments.jobs;
  options.resume = arguments.resume;
  if (!arguments.shard.empty()) read_shard(arguments.shard, options);
  Progress progress("sweep", arguments.quiet);
  watch_for_interrupt();
  options.progress = [&](double part) {
    progress.show(part);
    return !interrupted();
  };
  const bool whole = sweep::run_sweep(base, options);
  if (arguments.quiet) return;
  if (whole)
    tell("sweep: tables in {}\n", arguments.directory);
  else
    tell("sweep: shard {} of {} done; the tables follow when all are\n", options.shard, options.shards);
}

}  // namespace

void add_sweep(CLI::App& app) {
  auto* verb =
      app.add_subcommand("sweep", "Simulate a grid of parameters, or find phase boundaries, into one table");
  auto a = std::make_shared<SweepArguments>();
  verb->add_option("scene", a->scene, "scene file (TOML) with [sweep]")->required();
  verb->add_option("-o,--output", a->directory, "folder for the tables and the finished points")->required();
  verb->add_option("--set", a->settings, "change a key of the scene")->allow_extra_args(false);
  verb->add_option("--jobs", a->jobs, "points side by side; results do not depend on it")
      ->check(CLI::Range(1, 1024));
  verb->add_option("--shard", a->shard, "I/N: do only the I-th of N parts; the parts share the folder");
  verb->add_flag("--resume", a->resume, "go on with an interrupted sweep");
  verb->add_flag("--quiet", a->quiet, "no progress line");
  verb->footer(
      "Example: chute sweep scenes/sweep-ball.toml -o out/sweep --jobs 2\n"
      "In an array job: chute sweep SCENE -o DIR --shard $SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT");
  verb->callback([a] { run(*a); });
}

}  // namespace chute::app
