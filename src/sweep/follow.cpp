#include "sweep/follow.hpp"

#include <algorithm>
#include <cmath>

#include "common/error.hpp"
#include "measure/series.hpp"
#include "run/engine_factory.hpp"
#include "run/schedule.hpp"

namespace chute::sweep {
namespace {

/// The way of one start through time.
struct Track {
  std::vector<double> x, omega, kinetic;
};

/// Everything that the verdicts are made from.
class Record {
 public:
  explicit Record(const scene::Scene& scene)
      : independent_(scene.grains.independent),
        tracks_(independent_ ? static_cast<std::size_t>(scene.grains.count) : 1),
        scales_{bead_to_bead(scene), scene.incline.gravity} {}

  void sample(const Engine& engine) {
    time_.push_back(engine.time());
    if (!independent_) {
      const auto row = measure::observe_series(engine);
      const auto view = engine.grains();
      double mass = 0;
      for (std::size_t i = 0; i < view.moving; ++i) mass += view.mass[i];
      add(tracks_[0], row.x, row.omega, (row.energy.translation + row.energy.rotation) / mass);
      return;
    }
    const auto view = engine.grains();
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      const double v_x = view.velocity[0][i], v_y = view.velocity[1][i], spin = view.spin[0][i];
      add(tracks_[i], view.unwrapped(i, 0), -spin,  // tables count rolling downhill as positive
          0.5 * (v_x * v_x + v_y * v_y + view.inertia[i] / view.mass[i] * spin * spin));
    }
  }

  std::vector<measure::Flow> judge() const {
    std::vector<measure::Flow> flows;
    for (const auto& track : tracks_)
      flows.push_back(measure::judge_flow({time_, track.x, track.omega, track.kinetic}, scales_));
    return flows;
  }

  std::size_t rows() const { return time_.size(); }

 private:
  bool independent_;
  std::vector<double> time_;
  std::vector<Track> tracks_;
  measure::FlowScales scales_;

  static void add(Track& track, double x, double omega, double kinetic) {
    track.x.push_back(x);
    track.omega.push_back(omega);
    track.kinetic.push_back(kinetic);
  }
  static double bead_to_bead(const scene::Scene& scene) {
    const auto& bed = scene.bed;
    const double gap = bed.kind == scene::Bed::Kind::row ? bed.gap : bed.gap_max / 2;
    return bed.diameter * (1 + gap);
  }
};

bool all_stopped(const std::vector<measure::Flow>& flows) {
  return std::ranges::all_of(flows, [](const auto& f) { return f.verdict == measure::Verdict::stopped; });
}

}  // namespace

Outcome follow(const scene::Scene& scene, const Report& progress) {
  const auto made = run::make_engine(scene);
  Engine& engine = *made.engine;
  const double dt = engine.time_step();
  const auto last = std::max<std::int64_t>(1, std::llround(scene.duration / dt));
  const run::Schedule due(scene.output.series.from, scene.output.series.every, dt);
  constexpr std::size_t rows_between_looks = 100;

  Record record(scene);
  Outcome outcome;
  if (due.index_at(0) >= 0) record.sample(engine);
  while (engine.step() < last) {
    try {
      engine.advance_to(std::min(due.after(engine.step()), last));
    } catch (const WorkError& error) {
      outcome.left_physics = error.what();
      break;
    }
    if (due.index_at(engine.step()) >= 0) record.sample(engine);
    if (record.rows() % rows_between_looks != 0) continue;
    if (!progress(static_cast<double>(engine.step()) / static_cast<double>(last))) throw WorkError("stopped");
    if (all_stopped(record.judge())) break;
  }
  outcome.starts = record.judge();
  return outcome;
}

}  // namespace chute::sweep
