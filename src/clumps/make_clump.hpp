#pragma once
#include <span>

#include "clumps/sphere_union.hpp"
#include "core/clump.hpp"

namespace chute::clumps {

/// The rigid grain that these spheres are. A single one gives the bytes of a round grain. In 2D, too, it is a body of spheres
/// (with centres at z = 0), as round grains are spheres there: mass and inertia are those of the union in space.
template <int D>
Clump<D> make_clump(std::span<const Sphere> spheres);

}  // namespace chute::clumps
