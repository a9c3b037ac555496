#pragma once
#include <cmath>
#include <limits>

#include "core/vec.hpp"

namespace chute::hard {

/// The time of what does not happen.
inline constexpr double never = std::numeric_limits<double>::infinity();

/// How two spheres move about each other: the way from the second's centre to the first's is r(t) = d + v t +
/// ½ a t². Two grains in free flight have a = 0, (2.18); a grain in flight and a fixed one have a = g, (2.21)
/// with ½ g t².
template <int D>
struct Approach {
  Vec<D> d, v, a;
  double reach;  ///< R_i + R_j

  Vec<D> way(double t) const {
    Vec<D> r;
    for (int k = 0; k < D; ++k) r[k] = d[k] + t * (v[k] + 0.5 * t * a[k]);
    return r;
  }
  /// (2.17) as a function that is negative inside: |r|² − (R_i + R_j)².
  double gap(double t) const {
    const Vec<D> r = way(t);
    return dot(r, r) - reach * reach;
  }
  /// A time before which they cannot touch: as if they went straight at each other, ever faster.
  double earliest() const {
    const double far = norm(d) - reach, speed = norm(v), pull = norm(a);
    return far > 0 ? 2 * far / (speed + std::sqrt(speed * speed + 2 * pull * far)) : 0;
  }
};

/// The first time t ≥ 0 at which the spheres touch and do not part, infinity if there is none: the first t at
/// which the gap is not positive and does not grow. That is the first root of (2.17), and more: spheres that
/// rounding left overlapping by a hair meet at once if they approach, and do not meet while they part. So no
/// hit is missed, and none is seen twice. A pass closer to a touch than rounding may count as either.
template <int D>
double first_contact(const Approach<D>& approach);

/// The same where nothing pulls, a = 0: two grains in free flight, (2.18), a quadratic. The discriminant is that of
/// the nearest pass, reach² − |d − (d·v/v²) v|², which does not lose its digits when the grains are far apart.
template <int D>
double first_contact_linear(const Approach<D>& a) {
  const double closing = dot(a.d, a.v);
  if (!(closing < 0)) return never;
  const double c = a.gap(0);
  if (c <= 0) return 0;
  const double v_squared = dot(a.v, a.v);
  const Vec<D> nearest = a.d - (closing / v_squared) * a.v;
  const double depth = a.reach * a.reach - dot(nearest, nearest);
  if (depth <= 0) return never;
  return c / (-closing + std::sqrt(v_squared * depth));
}

/// The same for a grain and a plane: its height above touching is gap + speed t + ½ pull t².
double first_contact_with_plane(double gap, double speed, double pull);

}  // namespace chute::hard
