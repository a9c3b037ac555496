#pragma once
#include "core/world.hpp"
#include "scene/scene.hpp"

namespace chute::scene {

/// Grains, bed, domain and frame as the scene starts them: the same scene and seed give the same world. InputError if
/// something does not fit. D must be scene.dimensions.
template <int D>
World<D> make_world(const Scene& scene);

/// What a method may know of the scene besides its world.
engines::Setting setting_of(const Scene& scene);

/// What of the bed cannot be, without laying it. All else here lays it, and may do so only where this says nothing.
std::optional<Refusal> refusal_of_bed(const Scene& scene);

/// What else of the scene cannot be: a start that does not fit, a method that cannot do it, an observer that asks for more than
/// the method gives.
std::optional<Refusal> refusal_of(const Scene& scene);

}  // namespace chute::scene
