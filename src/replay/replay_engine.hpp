#pragma once
#include <memory>

#include "core/engine.hpp"
#include "replay/snapshot.hpp"

namespace chute::replay {

/// An engine that moves nothing: it stands at the frame that it was shown last, so that observers of a run look at files as
/// they look at a run. What a file lacks (velocities, masses, forces …) is not a number, which tables leave empty; grains
/// are solid spheres, in the plane too. The moving grains are numbered in the order of their ids, the fixed ones behind them.
class ReplayEngine : public Engine {
 public:
  /// Of so many dimensions; contacts of files without a network are between surfaces less than `gap` apart.
  static std::unique_ptr<ReplayEngine> make(int dimensions, double gap);

  /// The frame becomes step `step`, whose time is `time`. InputError if the file contradicts itself.
  virtual void show(const Snapshot& frame, std::int64_t step, double time) = 0;
  /// Had the frame a network with forces?
  virtual bool knows_forces() const = 0;
};

}  // namespace chute::replay
