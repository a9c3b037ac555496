#pragma once
#include <array>
#include <cmath>
#include <cstdint>

#include "core/domain.hpp"
#include "core/grains.hpp"

namespace chute::hard {

/// A grain's free flight since its last collision, (2.19), (2.20). Nothing in it changes between collisions,
/// so whatever is computed from it is the same bytes whenever it is computed.
template <int D>
struct Flight {
  Vec<D> place{}, velocity{}, gravity{};  ///< at `time`; a fixed grain has no gravity
  Vec<turns<D>> spin{};
  Orientation<D> orientation = as_at_start<D>();
  std::array<int, D> wraps{};  ///< times around the periods until `time`
  double time = 0;             ///< of the last collision
  double radius = 0;
  std::int64_t collisions = 0;  ///< tells a prediction that it is out of date

  Vec<D> place_at(double t) const { return place + (t - time) * (velocity + (0.5 * (t - time)) * gravity); }
  Vec<D> velocity_at(double t) const { return velocity + (t - time) * gravity; }
  Orientation<D> orientation_at(double t) const { return turned<D>(orientation, spin, t - time); }

  /// Begins again at time t, inside the domain. Returns the periods that were taken off the place.
  std::array<int, D> move_to(double t, const Domain<D>& domain) {
    place = place_at(t), velocity = velocity_at(t), orientation = orientation_at(t);
    time = t;
    return wrap(place, wraps, domain);
  }

  static std::array<int, D> wrap(Vec<D>& r, std::array<int, D>& count, const Domain<D>& domain) {
    std::array<int, D> off{};
    for (int k = 0; k < D; ++k) {
      if (!domain.periodic(k)) continue;
      const double along = r[k] - domain.lower[k];
      if (along >= 0 && along < domain.length[k]) continue;
      const auto axis = static_cast<std::size_t>(k);
      off[axis] = static_cast<int>(std::floor(along / domain.length[k]));
      r[k] -= off[axis] * domain.length[k];
      count[axis] += off[axis];
    }
    return off;
  }
};

}  // namespace chute::hard
