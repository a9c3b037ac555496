#include "run/run.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "io/checkpoint_file.hpp"
#include "run/engine_factory.hpp"
#include "run/flow.hpp"
#include "run/observers.hpp"
#include "run/record.hpp"
#include "run/version.hpp"

namespace chute::run {
namespace {

using Clock = std::chrono::steady_clock;

RunContext context(const scene::Scene& scene, const Made& made, const RunDirectory& directory) {
  const double theta = scene.incline.theta(), g = scene.incline.gravity;
  io::RunFacts facts;
  facts.units = scene.units == scene::Units::si ? "SI" : "reduced";
  facts.domain = {made.domain.lower[0], made.domain.lower[0] + made.domain.length[0]};
  facts.gravity = {g * std::sin(theta), -g * std::cos(theta), 0};
  return {scene, directory, facts, made.engine->time_step(), made.domain.length[0]};
}

/// One run: engine, observers, checkpoints.
class Run {
 public:
  Run(const scene::Scene& scene, const RunOptions& options)
      : scene_(scene),
        options_(options),
        resolved_(scene::to_toml(scene)),
        made_(make_engine(scene, options.threads)),  // may refuse the scene: before anything is written
        directory_(options.directory, options.existing),
        context_(context(scene, made_, directory_)),
        observers_(context_),
        dt_(made_.engine->time_step()),
        last_step_(std::max<std::int64_t>(1, std::llround(scene.duration / dt_))),
        checkpoint_due_(scene.output.checkpoint, scene.output.checkpoint, dt_) {}

  RunResult go() {
    const auto begin = Clock::now();
    begin_();
    const auto first = engine().step();
    bool wanted = true;
    while (engine().step() < last_step_ && wanted) {
      advance();
      observers_.look(engine());
      if (checkpoint_due_.index_at(engine().step()) >= 0) save();
      wanted = report();
    }
    save();
    const std::chrono::duration<double> took = Clock::now() - begin;
    const bool finished = engine().step() >= last_step_;
    write_run_json(finished ? "finished" : "interrupted", "", took.count());
    return {finished, engine().step() - first, took.count()};
  }

 private:
  const scene::Scene& scene_;
  const RunOptions& options_;
  std::string resolved_;
  Made made_;
  RunDirectory directory_;
  RunContext context_;
  Observers observers_;
  double dt_;
  std::int64_t last_step_;
  Schedule checkpoint_due_;
  std::int64_t steps_per_report_ = 1000;
  Clock::time_point reported_ = Clock::now();
  std::string started_ = RunRecord::now();

  Engine& engine() { return *made_.engine; }

  /// To the next step at which somebody looks.
  void advance() {
    const auto from = engine().step();
    const auto next = std::min(
        {observers_.next_after(from), checkpoint_due_.after(from), from + steps_per_report_, last_step_});
    const auto before = Clock::now();
    try {
      engine().advance_to(next);
    } catch (const WorkError& error) {
      write_run_json("left physics", error.what());
      throw;
    }
    tune_report(engine().step() - from, Clock::now() - before);
  }

  void begin_() {
    if (directory_.resumes()) {
      std::istringstream state(io::read_checkpoint(directory_.file("checkpoint"), resolved_));
      engine().restore(state);
      observers_.load(state);
      observers_.prepare(engine());
      return;
    }
    write_atomically(directory_.file("scene.toml"), resolved_);
    write_run_json("running");
    observers_.prepare(engine());
    observers_.look(engine());
    save();  // a run that leaves physics right away leaves a checkpoint too
  }

  /// Everything on disk as of now; the checkpoint last, so that it never promises files that are not there.
  void save() {
    observers_.write(engine().grains());
    io::write_checkpoint(directory_.file("checkpoint"), resolved_, [&](std::ostream& out) {
      engine().save(out);
      observers_.save(out);
    });
  }

  void write_run_json(const std::string& state, const std::string& why = "", double seconds = 0) {
    RunRecord record;
    record.command = options_.command_line;
    record.seed = scene_.seed;
    record.threads = options_.threads;
    record.started = started_;
    record.seconds = seconds;
    record.steps = engine().step();
    record.time_step = dt_;
    record.time = engine().time();
    record.end = state;
    record.why = why;
    const auto flow =
        observers_.saw_something() ? std::optional(observers_.flow(engine().grains())) : std::nullopt;
    write_record(directory_.file("run.json"), record, flow);
  }

  /// Slices of about a tenth of a second, so that progress and interruption feel prompt.
  void tune_report(std::int64_t steps, Clock::duration took) {
    const double seconds = std::chrono::duration<double>(took).count();
    if (steps < steps_per_report_ / 2 || seconds <= 0) return;
    const double wanted = static_cast<double>(steps) * 0.1 / seconds;
    steps_per_report_ = static_cast<std::int64_t>(std::clamp(wanted, 100.0, 1e7));
  }

  bool report() {
    if (!options_.progress) return true;
    if (Clock::now() - reported_ < std::chrono::milliseconds(100)) return true;
    reported_ = Clock::now();
    return options_.progress(static_cast<double>(engine().step()) / static_cast<double>(last_step_));
  }
};

}  // namespace

RunResult run_scene(const scene::Scene& scene, const RunOptions& options) { return Run(scene, options).go(); }

bool is_finished_run_of(const std::filesystem::path& directory, const scene::Scene& scene) {
  try {
    const auto json = nlohmann::json::parse(read_file(directory / "run.json"));
    return json.value("end", "") == "finished" && json.value("commit", "") == commit &&
           read_file(directory / "scene.toml") == scene::to_toml(scene);
  } catch (const std::exception&) {
    return false;  // no run, or not one that can be read
  }
}

}  // namespace chute::run
