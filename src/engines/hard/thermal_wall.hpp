#pragma once
#include <cmath>

#include "core/random.hpp"
#include "core/vec.hpp"

namespace chute::hard {

/// Velocity of what leaves a wall with the normal n as if it came from a gas at temperature T behind it: along n the flux of a
/// Maxwellian, v_n = √(−2 T/m ln u), and a Maxwellian along the wall.
template <int D>
Vec<D> thermal_velocity(const Vec<D>& n, double T, double mass, Random& random) {
  const double v = std::sqrt(T / mass);
  Vec<D> out = v * std::sqrt(-2 * std::log1p(-random.uniform())) * n;
  if constexpr (D == 2) {
    out = out + v * random.normal() * Vec<2>{{n[1], -n[0]}};
  } else {
    const Vec<3> other = std::abs(n[0]) < 0.6 ? Vec<3>{{1, 0, 0}} : Vec<3>{{0, 1, 0}};
    Vec<3> s = cross(n, other);
    s = (1 / norm(s)) * s;
    out = out + v * random.normal() * s + v * random.normal() * cross(n, s);
  }
  return out;
}

}  // namespace chute::hard
