#include "run/run.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "common/hash.hpp"
#include "io/checkpoint_file.hpp"
#include "measure/schedule.hpp"
#include "run/growth.hpp"
#include "run/record.hpp"
#include "run/session.hpp"
#include "run/version.hpp"

namespace chute::run {
namespace {

using Clock = std::chrono::steady_clock;

/// One run in its directory: the session, files and checkpoints.
class Run {
 public:
  Run(const scene::Scene& scene, const RunOptions& options)
      : scene_(as_it_goes_on(scene, options)),
        options_(options),
        resolved_(scene::to_toml(scene_)),
        files_(std::make_shared<io::RunFiles>(options.directory)),
        session_(scene_, options.threads, files_),  // may refuse the scene: before anything is written
        directory_(options.directory, options.existing),
        checkpoint_due_(scene_.checkpoint, scene_.checkpoint, session_.time_step()) {}

  RunResult go() {
    try {
      return run_to_its_end();
    } catch (const WorkError& error) {
      if (options_.way_on.empty() || left_physics_ || !std::filesystem::exists(directory_.file("checkpoint")))
        throw;
      throw WorkError(fmt::format("{}; when that is mended, {}", error.what(), options_.way_on));
    }
  }

 private:
  RunResult run_to_its_end() {
    const auto begin = Clock::now();
    begin_or_put_back();
    const auto first = engine().step(), last = session_.last_step();
    first_step_ = first, began_ = Clock::now();
    bool wanted = true;
    while (engine().step() < last && wanted) {
      advance();
      if ((checkpoint_due_.index_at(engine().step()) >= 0 || saved_long_ago()) && worth_saving())
        save();
      else if (worth_showing())
        show();
      wanted = report();
    }
    save();
    const std::chrono::duration<double> took = Clock::now() - begin;
    const bool finished = engine().step() >= last;
    write_run_json(finished ? "finished" : "interrupted", "", took.count());
    if (finished) directory_.finish();
    // A bar on a terminal ends full, however short the run was.
    if (finished && options_.progress) options_.progress(1);
    return {finished,
            engine().step() - first,
            engine().grains().moving,
            took.count(),
            account(),
            session_.series().rows() > 0 ? session_.series().starts() : std::vector<measure::Flow>{}};
  }

  scene::Scene scene_;
  const RunOptions& options_;
  std::string resolved_;
  std::shared_ptr<io::RunFiles> files_;
  Session session_;
  RunDirectory directory_;
  measure::Schedule checkpoint_due_;
  std::int64_t steps_per_report_ = 1000;
  Clock::time_point reported_ = Clock::now(), saved_ = reported_;
  Clock::time_point shown_ = reported_, began_ = reported_;
  Clock::duration saving_takes_{}, showing_takes_{};
  std::int64_t first_step_ = 0;
  bool left_physics_ = false;
  std::string started_ = RunRecord::now();

  /// The scene as the run in the folder can go on with it.
  static scene::Scene as_it_goes_on(const scene::Scene& scene, const RunOptions& options) {
    const auto checkpoint = options.directory / "checkpoint";
    if (options.existing != Existing::resume || !std::filesystem::exists(checkpoint)) return scene;
    return grown(scene, io::read_checkpoint(checkpoint).scene, checkpoint.string());
  }

  Engine& engine() { return session_.engine(); }

  /// To the next step at which somebody looks.
  void advance() {
    const auto from = engine().step();
    const auto before = Clock::now();
    try {
      session_.move(std::min(checkpoint_due_.after(from), from + steps_per_report_));
    } catch (const WorkError& error) {
      left_physics_ = true;
      write_run_json("left physics", error.what());
      throw;
    }
    session_.look();
    tune_report(engine().step() - from, Clock::now() - before);
  }

  /// As far as the first checkpoint. Before it there is nothing to resume: a run that was to be replaced comes back, and
  /// a folder that was new goes.
  void begin_or_put_back() {
    try {
      begin_();
    } catch (...) {
      directory_.put_back();
      throw;
    }
  }

  void begin_() {
    if (directory_.resumes()) {
      const auto checkpoint = io::read_checkpoint(directory_.file("checkpoint"));
      if (checkpoint.program != program() && options_.warn)
        options_.warn(
            fmt::format("{}: written by {}, this is {}: the results may differ from those of one program",
                        directory_.file("checkpoint").string(), checkpoint.program, program()));
      const auto told = session_.load(*checkpoint.state);
      if (engine().step() > session_.last_step())
        throw InputError(fmt::format("run.duration: {:.6g} is over: the run in {} is at {}", scene_.duration,
                                     directory_.path().string(), session_.context().moment(engine().time())));
      for (const auto& difference : io::frames_cut_short(directory_.path(), files_->sums()))
        throw InputError(difference + "; give --force to start again");
      if (checkpoint.scene == resolved_) return;
      for (const auto& line : told)
        if (options_.warn) options_.warn(line);
      files_->remove_frames_beyond();
      files_->write("scene.toml", resolved_);
      save();
      return;
    }
    refuse_another_scene();
    directory_.claim(record("running"));
    files_->write("scene.toml", resolved_);
    files_->commit();
    session_.begin();
    save();  // a run that leaves physics right away leaves a checkpoint too
  }

  /// A run that was cut off before its first checkpoint begins again, but not with another scene.
  void refuse_another_scene() const {
    if (options_.existing != Existing::resume) return;
    const auto file = directory_.file("scene.toml");
    if (!std::filesystem::exists(file)) return;
    if (const auto difference = difference_that_matters(read_file(file), resolved_))
      throw InputError(fmt::format("{}: is another scene: {}; give --force to replace the run", file.string(),
                                   *difference));
  }

  /// What wrote a checkpoint; the same bytes are promised of the same build only.
  static std::string program() {
    return fmt::format("chute {} ({}, build {})", version, commit, build_hash().substr(0, 8));
  }

  /// What a kill may cost against what all checkpoints cost: of many grains and short intervals a run would do nothing else.
  bool worth_saving() const {
    constexpr int work_per_cost = 19;  // checkpoints take a twentieth of the time at most
    return Clock::now() - saved_ >= work_per_cost * saving_takes_;
  }

  bool saved_long_ago() const {
    return options_.checkpoint_seconds > 0 &&
           Clock::now() - saved_ >= std::chrono::duration<double>(options_.checkpoint_seconds);
  }

  /// Those who watch a run see it some seconds late.
  bool worth_showing() const {
    constexpr auto pause = std::chrono::seconds(2);
    constexpr int work_per_cost = 19;  // as with checkpoints
    const auto gone = Clock::now() - std::max(shown_, saved_);
    return gone >= pause && gone >= work_per_cost * showing_takes_;
  }
  /// Tables and run.json as of now, without waiting for the disk.
  void show() {
    const auto before = Clock::now();
    session_.write();
    files_->show();
    write_run_json("running", "", std::chrono::duration<double>(before - began_).count());
    shown_ = Clock::now();
    showing_takes_ = shown_ - before;
  }

  /// Everything on disk as of now; the checkpoint last, so that it never promises files that are not there.
  void save() {
    const auto before = Clock::now();
    session_.write();
    const auto path = directory_.file("checkpoint");
    const auto grains = session_.grains();
    auto checkpoint = io::made_checkpoint(path, {resolved_, program()},
                                          {grains.size(), [&](std::ostream& out) { grains.write(out); }},
                                          [&](std::ostream& out) { session_.save(out); });
    checkpoint.begin_flush();
    files_->commit();
    checkpoint.flush();
    checkpoint.move_into_place();
    flush_folder(directory_.path());
    saved_ = Clock::now();
    saving_takes_ = saved_ - before;
  }

  RunRecord record(const std::string& state) {
    RunRecord record;
    record.command = options_.command_line;
    record.seed = scene_.seed;
    record.threads = options_.threads;
    record.started = started_;
    record.steps = engine().step();
    record.time_step = session_.time_step();
    record.time = engine().time();
    record.duration = scene_.duration;
    record.clock = session_.context().offers.clock;
    record.end = state;
    record.files = files_->sums();
    return record;
  }

  void write_run_json(const std::string& state, const std::string& why = "", double seconds = 0) {
    auto record = this->record(state);
    record.seconds = seconds;
    record.why = why;
    if (const auto gone = engine().step() - first_step_; state == "running" && gone > 0)
      record.left =
          seconds * static_cast<double>(session_.last_step() - engine().step()) / static_cast<double>(gone);
    const auto& series = session_.series();
    record.tilting = series.turning_angles();
    record.account = account();
    const auto file = directory_.file("run.json");
    series.rows() > 0 ? write_record(file, record, series.flow(), series.starts())
                      : write_record(file, record);
  }

  std::optional<measure::AccountVerdict> account() const {
    const auto& rows = session_.series().series();
    return rows.empty() ? std::nullopt : measure::judge_account(rows.back().energy);
  }

  /// Slices of about a tenth of a second, so that progress and interruption feel prompt.
  void tune_report(std::int64_t steps, Clock::duration took) {
    const double seconds = std::chrono::duration<double>(took).count();
    if (steps < steps_per_report_ / 2 || seconds <= 0) return;
    const double wanted = static_cast<double>(steps) * 0.1 / seconds;
    steps_per_report_ = static_cast<std::int64_t>(std::clamp(wanted, 1.0, 1e7));
  }

  bool report() {
    if (!options_.progress) return true;
    if (Clock::now() - reported_ < std::chrono::milliseconds(100)) return true;
    reported_ = Clock::now();
    return options_.progress(session_.part_done());
  }
};

}  // namespace

RunResult run_scene(const scene::Scene& scene, const RunOptions& options) { return Run(scene, options).go(); }

bool is_finished_run_of(const std::filesystem::path& directory, const scene::Scene& scene) {
  try {
    const auto json = nlohmann::json::parse(read_file(directory / "run.json"));
    return json.value("end", "") == "finished" && json.value("build", "") == build_hash() &&
           read_file(directory / "scene.toml") == scene::to_toml(scene);
  } catch (const std::exception&) {
    return false;  // no run, or not one that can be read
  }
}

}  // namespace chute::run
