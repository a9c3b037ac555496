#pragma once
#include <algorithm>

#include "core/vec.hpp"

namespace chute {

/// A wall in the plane that ends: both its sides hold grains, and its ends are corners.
struct Segment {
  Vec<2> half;  ///< from its middle to one end

  /// The point that is closest to a place, both from the middle.
  Vec<2> closest(const Vec<2>& place) const {
    return std::clamp(dot(place, half) / dot(half, half), -1.0, 1.0) * half;
  }
  double extent() const { return norm(half); }
};

}  // namespace chute
