#pragma once
#include <array>
#include <span>

#include "core/vec.hpp"

namespace chute::clumps {

struct Sphere {
  Vec<3> centre;
  double radius = 0;
};

using Matrix = std::array<Vec<3>, 3>;

/// What a body of unit density comes to.
struct SolidMoments {
  double volume = 0;
  Vec<3> first{};   ///< ∫ r dV
  Matrix second{};  ///< ∫ r rᵀ dV
  Vec<3> centre() const { return (1 / volume) * first; }
  /// Tensor of inertia about the centre of mass, ∫ (r² 1 − r rᵀ) dV.
  Matrix inertia() const;
};

/// Of the union of the spheres: whatever several of them cover counts once. Plane sections of the union are unions of discs,
/// which are exact (disc_union.hpp); over the sections it is integrated to a part of 1e-13.
SolidMoments union_of(std::span<const Sphere> spheres);

}  // namespace chute::clumps
