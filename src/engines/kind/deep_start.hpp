#pragma once
#include <span>

#include "core/world.hpp"

namespace chute::engines {

/// What methods that push overlaps apart can begin with, of the smaller radius: the start from a run of soft grains, say.
inline constexpr double deepest_that_is_pushed_apart = 0.25;

/// InputError if a grain of the start lies deeper than `deepest`, in parts of the smaller radius, in another one or in a
/// wall: whoever is half in a wall, or behind it, is a slip of the scene. `body`: of which each is a part, if grains are
/// made of spheres; these may overlap, and bodies are named.
template <int D>
void refuse_deep_start(const Grains<D>& grains, const Surroundings<D>& around, double deepest,
                       std::span<const int> body = {});

}  // namespace chute::engines
