#pragma once
#include <array>
#include <limits>

#include "core/vec.hpp"

namespace chute {

/// Where grains live: periodic with the given length in some directions, unbounded (infinite length) in
/// others.
template <int D>
struct Domain {
  Vec<D> lower{};
  Vec<D> length = [] {
    Vec<D> l;
    for (int k = 0; k < D; ++k) l[k] = std::numeric_limits<double>::infinity();
    return l;
  }();

  bool periodic(int k) const { return length[k] < std::numeric_limits<double>::infinity(); }

  /// Shortest way from one place to another, in direction k. Written with two selections instead of a
  /// rounding, so that it costs two masked additions in a vector loop and is exact where there is no period.
  /// Holds for places that are at most half a period outside the domain.
  static constexpr double nearest_image(double d, double full, double half) {
    const double folded = d > half ? d - full : d;
    return folded < -half ? folded + full : folded;
  }
  Vec<D> way(const Vec<D>& from, const Vec<D>& to) const {
    Vec<D> d = to - from;
    for (int k = 0; k < D; ++k) d[k] = nearest_image(d[k], length[k], length[k] / 2);
    return d;
  }
};

}  // namespace chute
