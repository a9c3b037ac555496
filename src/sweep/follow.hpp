#pragma once
#include <string>
#include <vector>

#include "common/side_by_side.hpp"
#include "measure/steadiness.hpp"
#include "scene/scene.hpp"

namespace chute::sweep {

/// What became of one point of a sweep: a flow, or each of the independent grains of the scene.
struct Followed {
  std::vector<measure::Flow> starts;
  std::string left_physics;  ///< why the run ended before its time; empty if it did not
};

/// Runs a scene without writing anything; its verdicts are those of `chute run`. Ends early once every start has stopped.
/// WorkError if `progress` asks to stop.
Followed follow(const scene::Scene& scene, const Report& progress);

}  // namespace chute::sweep
