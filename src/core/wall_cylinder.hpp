#pragma once
#include "core/vec.hpp"

namespace chute {

/// A round wall with the grains inside: a circle in the plane, an endless pipe along `axis` in space. It may turn about
/// its axis, as drums do.
template <int D>
struct Cylinder {
  Vec<D> axis{};  ///< 3D: unit vector
  double radius = 0;
  double spin = 0;  ///< anticlockwise, as the axis points at who looks

  /// The way from the axis to a place.
  Vec<D> radial(const Vec<D>& place) const {
    if constexpr (D == 2)
      return place;
    else
      return place - dot(place, axis) * axis;
  }
  /// Velocity of the turning surface at a point that is `arm` away from the axis.
  Vec<D> turning(const Vec<D>& arm) const {
    if constexpr (D == 2)
      return {{-spin * arm[1], spin * arm[0]}};
    else
      return spin * cross(axis, arm);
  }
};

}  // namespace chute
