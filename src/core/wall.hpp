#pragma once
#include <vector>

#include "core/vec.hpp"

namespace chute {

/// A plane that grains do not pass: infinitely heavy, without curvature, so that a contact has the grain's own mass and
/// radius as m_eff and R_eff.
template <int D>
struct Wall {
  Vec<D> point{};
  Vec<D> normal{};  ///< unit vector, into the grains

  /// Height of a place above the wall.
  double height(const Vec<D>& place) const { return dot(place - point, normal); }
};

}  // namespace chute
