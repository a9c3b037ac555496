#pragma once
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "io/plain_grains.hpp"
#include "measure/series.hpp"
#include "scene/scene.hpp"

namespace chute::run {

/// The one way in which a scene runs: its engine, those who watch it, and the loop that takes it from look to look. `run`
/// adds a directory with files and checkpoints, `sweep` and figures only want to know what became of it.
class Session {
 public:
  /// Makes the world and the engine; InputError or WorkError if the scene cannot be run. Without `files` nothing is
  /// written.
  Session(const scene::Scene& scene, int threads, std::shared_ptr<io::RunFiles> files = {});
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  Engine& engine() { return *engine_; }
  const Engine& engine() const { return *engine_; }
  std::int64_t last_step() const { return last_step_; }
  double time_step() const { return run_.time_step; }
  const measure::RunContext& context() const { return run_; }
  double part_done() const { return static_cast<double>(engine_->step()) / static_cast<double>(last_step_); }

  /// The look at the start; not of a session that is loaded.
  void begin();
  /// Goes on to the next step at which somebody looks, but no farther than `until`, and lets them look.
  void advance(std::int64_t until);
  /// The two halves of it: what fails in the first one is physics, in the second one files.
  void move(std::int64_t until);
  void look();

  const measure::SeriesObserver& series() const { return *series_; }

  /// All files as of now, which RunFiles::commit then shows.
  void write() const;
  /// The grains as a VTK file, for checkpoints; to be written before the engine moves on.
  io::PlainGrains grains() const { return {engine_->grains(), run_.facts}; }
  void save(std::ostream& out) const;
  /// Goes on from what was saved, by a session of the same scene or of one that differs in its outputs and duration.
  /// Tells of outputs that begin here.
  std::vector<std::string> load(std::istream& in);

 private:
  /// An output of the scene, and who watches for it.
  struct Watch {
    std::string word, keys;  ///< its keys as TOML
    std::vector<std::string> may_change;
    std::vector<measure::Observer*> observers;
  };

  measure::RunContext run_;
  std::unique_ptr<Engine> engine_;
  std::int64_t last_step_ = 1;
  std::vector<std::unique_ptr<measure::Observer>> observers_;
  std::vector<Watch> watches_;
  measure::SeriesObserver* series_ = nullptr;

  /// Starts or goes on collecting what somebody wants now.
  void prepare();
};

}  // namespace chute::run
