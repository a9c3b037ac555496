#pragma once
#include <algorithm>
#include <limits>
#include <vector>

#include "core/vec.hpp"

namespace chute {

/// A flat convex wall in space: both its sides hold grains, and its rim has edges and corners.
struct Polygon {
  std::vector<Vec<3>> corners;  ///< from its middle, in order

  /// The point that is closest to a place, both from the middle.
  Vec<3> closest(const Vec<3>& place) const {
    const Vec<3> normal = upright();
    const Vec<3> foot = place - dot(place, normal) * normal;
    bool inside = true;
    Vec<3> nearest{};
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Vec<3>&a = corners[k], edge = corners[(k + 1) % corners.size()] - a;
      inside = inside && dot(cross(edge, foot - a), normal) >= 0;
      const Vec<3> on_edge = a + std::clamp(dot(foot - a, edge) / dot(edge, edge), 0.0, 1.0) * edge;
      if (const double far = norm(foot - on_edge); far < least) least = far, nearest = on_edge;
    }
    return inside ? foot : nearest;
  }
  /// The direction from which the corners go round anticlockwise.
  Vec<3> upright() const {
    const Vec<3> n = cross(corners[1] - corners[0], corners[2] - corners[1]);
    return (1 / norm(n)) * n;
  }
  double extent() const {
    double farthest = 0;
    for (const auto& c : corners) farthest = std::max(farthest, norm(c));
    return farthest;
  }
};

}  // namespace chute
