#pragma once
#include <span>

#include "core/vec.hpp"

namespace chute::clumps {

struct Disc {
  Vec<2> centre;
  double radius = 0;
};

/// What a flat figure comes to: its area, and the integrals of x, y, x², y² and xy over it.
struct FlatMoments {
  double area = 0;
  Vec<2> first{};
  double xx = 0, yy = 0, xy = 0;
};

/// Of the union of the discs, in closed form: whatever several of them cover counts once. By Green's theorem the integrals are
/// sums over the arcs of circles that bound the union.
FlatMoments union_of(std::span<const Disc> discs);

}  // namespace chute::clumps
