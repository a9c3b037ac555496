#pragma once
#include <cmath>

#include "core/vec.hpp"

namespace chute {

/// Components of a turn: one about the plane's normal in 2D, three in 3D.
template <int D>
inline constexpr int turns = D == 2 ? 1 : 3;

/// Numbers of an orientation: an angle in 2D; in 3D a unit quaternion (w, x, y, z) that takes the grain as it was at
/// the start to what it is now. (The time integral of the spin is no orientation: turns do not add up.)
template <int D>
inline constexpr int orientation_numbers = D == 2 ? 1 : 4;
template <int D>
using Orientation = Vec<orientation_numbers<D>>;

template <int D>
constexpr Orientation<D> as_at_start() {
  if constexpr (D == 2)
    return {};
  else
    return {{1, 0, 0, 0}};
}

/// Hamilton's product a b: first b, then a.
constexpr Vec<4> quaternion_product(const Vec<4>& a, const Vec<4>& b) {
  return {{a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
           a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
           a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
           a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]}};
}

/// The orientation after a time in which the grain spun steadily about fixed axes.
template <int D>
Orientation<D> turned(const Orientation<D>& from, const Vec<turns<D>>& spin, double time) {
  if constexpr (D == 2) {
    return {{from[0] + time * spin[0]}};
  } else {
    const double rate = norm(spin), half = 0.5 * rate * time;
    const double part = rate > 0 ? std::sin(half) / rate : 0;
    return quaternion_product({{std::cos(half), part * spin[0], part * spin[1], part * spin[2]}}, from);
  }
}

}  // namespace chute
