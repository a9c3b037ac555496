#include "run/run.hpp"

#include <fmt/format.h>

#include <cereal/archives/portable_binary.hpp>
#include <cereal/types/array.hpp>
#include <cereal/types/vector.hpp>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "io/checkpoint_file.hpp"
#include "io/csv.hpp"
#include "io/vtk_files.hpp"
#include "measure/profiles.hpp"
#include "measure/series.hpp"
#include "run/engine_factory.hpp"
#include "run/flow.hpp"
#include "run/record.hpp"
#include "run/schedule.hpp"
#include "run/version.hpp"

namespace chute::run {
namespace {

using Clock = std::chrono::steady_clock;

/// One run: engine, observers, and when each writes.
class Run {
 public:
  Run(const scene::Scene& scene, const RunOptions& options)
      : scene_(scene),
        options_(options),
        resolved_(scene::to_toml(scene)),
        made_(make_engine(scene)),  // may refuse the scene: before anything is written
        directory_(options.directory, options.existing),
        dt_(made_.engine->time_step()),
        last_step_(std::max<std::int64_t>(1, std::llround(scene.duration / dt_))) {
    const auto& out = scene.output;
    facts_.units = scene.units == scene::Units::si ? "SI" : "reduced";
    facts_.domain = {made_.domain.lower[0], made_.domain.lower[0] + made_.domain.length[0]};
    facts_.gravity = {scene.incline.gravity * std::sin(scene.incline.theta()),
                      -scene.incline.gravity * std::cos(scene.incline.theta()), 0};
    series_due_ = Schedule(out.series.from, out.series.every, dt_);
    checkpoint_due_ = Schedule(out.checkpoint, out.checkpoint, dt_);
    if (out.frames) frames_due_ = Schedule(out.frames->from, out.frames->every, dt_);
    if (out.profiles) {
      const double from = out.profiles->from.value_or(0);
      profiles_due_ = Schedule(from, *out.profiles->every, dt_);
      const std::size_t blocks = out.profiles->from ? 10 : 64;
      const auto add = [&](const char* file, double bin) {
        profiles_.push_back(
            {file, measure::Profiles(made_.domain.length[0], bin, from, scene.duration, blocks)});
      };
      add("profiles.csv", out.profiles->bin);
      if (out.profiles->fine) add("profiles_fine.csv", *out.profiles->fine);
    }
  }

  RunResult go() {
    const auto begin = Clock::now();
    begin_();
    const auto first = engine().step();
    bool wanted = true;
    while (engine().step() < last_step_ && wanted) {
      advance();
      observe();
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
  double dt_;
  std::int64_t last_step_;
  io::RunFacts facts_;
  Schedule series_due_, frames_due_, profiles_due_, checkpoint_due_;
  std::vector<measure::SeriesRow> series_;
  struct ProfileFile {
    const char* name;
    measure::Profiles profiles;
  };
  std::vector<ProfileFile> profiles_;
  std::vector<Impact> impacts_;
  std::vector<double> frame_times_;
  std::int64_t steps_per_report_ = 1000;
  Clock::time_point reported_ = Clock::now();
  std::string started_ = RunRecord::now();

  Engine& engine() { return *made_.engine; }

  /// To the next step at which somebody looks.
  void advance() {
    const auto from = engine().step();
    const auto next = std::min({series_due_.after(from), frames_due_.after(from), profiles_due_.after(from),
                                impacts_from_after(from), checkpoint_due_.after(from),
                                from + steps_per_report_, last_step_});
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
      cereal::PortableBinaryInputArchive archive(state);
      transfer(archive);
      engine().collect_impacts(collecting());
      return;
    }
    write_atomically(directory_.file("scene.toml"), resolved_);
    write_run_json("running");
    engine().collect_impacts(collecting());
    observe();
    save();  // a run that leaves physics right away leaves a checkpoint too
  }

  template <class Archive>
  void transfer(Archive& archive) {
    archive(series_, impacts_, frame_times_);
    for (auto& file : profiles_) archive(file.profiles);
  }

  /// Stepping is cut where impacts begin to count, so that none is collected before.
  std::int64_t impacts_from_after(std::int64_t step) const {
    const auto& spec = scene_.output.impacts;
    const auto from = spec ? std::llround(spec->from / dt_) : 0;
    return spec && from > step ? from : std::numeric_limits<std::int64_t>::max();
  }
  bool collecting() {
    return scene_.output.impacts && engine().step() >= std::llround(scene_.output.impacts->from / dt_);
  }

  void observe() {
    const auto step = engine().step();
    if (series_due_.index_at(step) >= 0) series_.push_back(measure::observe_series(engine()));
    if (profiles_due_.index_at(step) >= 0)
      for (auto& file : profiles_) file.profiles.sample(engine().grains());
    if (const auto k = frames_due_.index_at(step); k >= 0) write_frame(k);
    if (collecting()) {
      engine().collect_impacts(true);
      const auto fresh = engine().take_impacts();
      impacts_.insert(impacts_.end(), fresh.begin(), fresh.end());
    }
  }

  void write_frame(std::int64_t k) {
    const auto name = frame_name("frames", k);
    std::filesystem::create_directories(directory_.file("frames"));
    write_atomically(directory_.file(name), io::grains_vtp(engine().grains(), facts_));
    if (scene_.output.contacts) {
      std::filesystem::create_directories(directory_.file("contacts"));
      const auto contacts = engine().contacts();
      write_atomically(directory_.file(frame_name("contacts", k)),
                       io::contacts_vtp(engine().grains(), contacts, facts_));
    }
    frame_times_.push_back(engine().time());
  }

  static std::string frame_name(const char* folder, std::int64_t k) {
    return fmt::format("{}/{:06}.vtp", folder, k);
  }

  /// Everything on disk as of now; the checkpoint last, so that it never promises files that are not there.
  void save() {
    write_series();
    for (const auto& file : profiles_) write_profiles(file);
    if (scene_.output.impacts)
      write_atomically(directory_.file("impacts.vtp"), io::impacts_vtp(impacts_, facts_));
    if (scene_.output.frames) {
      std::vector<std::string> names;
      for (std::size_t k = 0; k < frame_times_.size(); ++k)
        names.push_back(frame_name("frames", static_cast<std::int64_t>(k)));
      write_atomically(directory_.file("frames.pvd"), io::pvd(frame_times_, names));
    }
    io::write_checkpoint(directory_.file("checkpoint"), resolved_, [&](std::ostream& out) {
      engine().save(out);
      cereal::PortableBinaryOutputArchive archive(out);
      transfer(archive);
    });
  }

  std::vector<std::string> comments(std::string what) const {
    return {std::move(what), fmt::format("{}; units: {}; seed {}; chute {} ({})", scene_.title, facts_.units,
                                         scene_.seed, version, commit)};
  }

  void write_series() {
    io::Csv csv(comments("means over the moving grains, and where the energy is and went (see README)"),
                {"time", "x", "v_x", "v_y", "omega", "contacts", "translation", "rotation", "elastic",
                 "gravity_work", "normal_loss", "shear_loss", "residual"});
    for (const auto& r : series_)
      csv.row({r.time, r.x, r.v_x, r.v_y, r.omega, static_cast<double>(r.contacts), r.energy.translation,
               r.energy.rotation, r.energy.elastic, r.energy.gravity_work, r.energy.normal_loss,
               r.energy.shear_loss, r.energy.residual()});
    write_atomically(directory_.file("series.csv"), csv.text());
  }

  void write_profiles(const ProfileFile& file) {
    io::Csv csv(
        comments("time averages over layers at height h above the centres of the bed; errors from blocks "
                 "of the time window"),
        {"h", "grains", "eta", "eta_err", "eta_exact", "eta_exact_err", "v_x", "v_x_err", "v_y", "v_y_err",
         "sigma_x", "sigma_x_err", "sigma_y", "sigma_y_err", "omega", "omega_err", "half_shear",
         "half_shear_err"});
    const auto& spec = *scene_.output.profiles;
    for (const auto& b : spec.from ? file.profiles.result() : file.profiles.result(flow().from))
      csv.row({b.h, b.grains, b.eta.mean, b.eta.error, b.eta_exact.mean, b.eta_exact.error, b.v_x.mean,
               b.v_x.error, b.v_y.mean, b.v_y.error, b.sigma_x.mean, b.sigma_x.error, b.sigma_y.mean,
               b.sigma_y.error, b.omega.mean, b.omega.error, b.half_shear.mean, b.half_shear.error});
    write_atomically(directory_.file(file.name), csv.text());
  }

  measure::Flow judge() { return judge_run(series_, scene_, engine().grains()); }

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
    const auto flow = series_.empty() ? std::optional<measure::Flow>() : judge();
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
