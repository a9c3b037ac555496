#pragma once
#include "scene/scene.hpp"

namespace chute::scene {

/// The shortest interval of the outputs, or the small part of it that all of them are a whole number of: where a step
/// divides that, series every 0.2 and frames every 0.5 both come when they are due. Where no such part is large enough, as
/// with intervals of 1 and √2, the shortest one, and what does not fit comes at the step that is nearest.
double interval_of_all_outputs(const Scene& scene);

}  // namespace chute::scene
