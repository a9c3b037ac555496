#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "core/vec.hpp"

namespace chute {

/// Gravity in the frame of an incline of angle θ.
template <int D>
Vec<D> gravity_on_incline(double g, double theta) {
  Vec<D> gravity{};
  gravity[0] = g * std::sin(theta);
  gravity[D - 1] = -g * std::cos(theta);
  return gravity;
}

/// An incline that is tilted at a steady rate from one angle to another, and from there maybe on to a third, where it
/// stays.
struct Tilt {
  double from = 0, to = 0, rate = 0;  ///< rate > 0, per time
  double gravity = 0;                 ///< g
  std::optional<double> then{};       ///< the third angle

  double angle(double t) const {
    const double turns = std::abs(to - from) / rate;
    return then && t > turns ? on_the_way(to, *then, t - turns) : on_the_way(from, to, t);
  }

 private:
  double on_the_way(double begin, double end, double t) const {
    return begin < end ? std::min(end, begin + rate * t) : std::max(end, begin - rate * t);
  }
};

/// The frame of reference of an incline, for whoever measures along and across it, whatever the dimension: x goes
/// downhill, the last coordinate away from the bed, and in 3D y across.
struct Frame {
  int dimensions = 2;
  double footprint = 0;  ///< length of the line in 2D, area of the plane in 3D: what layers are averaged over
  double bead_spacing =
      1;  ///< way from bead to bead of the bed; a mean grain's diameter where there is no bed

  static constexpr std::size_t downhill = 0;
  std::size_t normal() const { return static_cast<std::size_t>(dimensions) - 1; }
  bool has_lateral() const { return dimensions == 3; }
  static constexpr std::size_t lateral = 1;

  /// The component of a spin about the axis that a grain rolls about, and the sign that makes rolling downhill
  /// positive: 2D spins count anticlockwise, and in 3D y completes x and the normal to a right-handed frame.
  std::size_t rolling_axis() const { return dimensions == 2 ? 0 : 1; }
  double rolling_sign() const { return dimensions == 2 ? -1 : 1; }
};

}  // namespace chute
