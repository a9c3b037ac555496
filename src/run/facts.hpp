#pragma once
#include <vector>

#include "core/fact.hpp"
#include "scene/scene.hpp"

namespace chute::run {

/// What follows from a scene, for `chute check`: what is so for every method, and what the method tells of itself.
std::vector<Fact> facts(const scene::Scene& scene);
/// Rough seconds of one core that a run takes; 0: not known.
double cost_of(const scene::Scene& scene);
/// Rough bytes that its directory takes.
double disk_of(const scene::Scene& scene);
/// What its method warns of, and outputs that begin after the run ends.
std::vector<std::string> warnings(const scene::Scene& scene);

}  // namespace chute::run
