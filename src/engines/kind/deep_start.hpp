#pragma once
#include <span>

#include "core/world.hpp"

namespace chute::engines {

/// What methods that push overlaps apart can begin with, of the smaller radius: the start from a run of soft grains, say.
inline constexpr double deepest_that_is_pushed_apart = 0.25;

/// What grains of a method that knows no overlaps may have at its start: as much as soft grains usually do, which are then pushed
/// apart.
inline constexpr double deepest_of_soft_grains = 0.05;

/// Moves grains that overlap by more than `touching`, in parts of the smaller radius, apart from each other and out of walls, one
/// contact after the other until none is left: the end of a run of soft grains becomes a start of rigid ones. They move about as far
/// as they overlapped. InputError if they lie so tight that there is no room.
template <int D>
void push_apart(Grains<D>& grains, const Surroundings<D>& around, double touching);

/// InputError if a grain of the start lies deeper than `deepest`, in parts of the smaller radius, in another one or in a
/// wall: whoever is half in a wall, or behind it, is a slip of the scene. `body`: of which each is a part, if grains are
/// made of spheres; these may overlap, and bodies are named.
template <int D>
void refuse_deep_start(const Grains<D>& grains, const Surroundings<D>& around, double deepest,
                       std::span<const int> body = {});

}  // namespace chute::engines
