#pragma once
#include <cmath>
#include <numbers>
#include <optional>
#include <type_traits>
#include <variant>
#include <vector>

#include "core/domain.hpp"
#include "core/vec.hpp"
#include "core/wall_cylinder.hpp"
#include "core/wall_polygon.hpp"
#include "core/wall_segment.hpp"

namespace chute {

/// A wall that goes on for ever.
struct Endless {};

/// What a wall's outline is. Bounded walls stand with their middle at the wall's point.
template <int D>
using Outline = std::variant<Endless, std::conditional_t<D == 2, Segment, Polygon>, Cylinder<D>>;

/// Where a wall is touched from a place.
template <int D>
struct Nearest {
  double height = 0;  ///< of the place above the surface; below 0 behind an endless wall
  Vec<D> normal{};    ///< unit vector from the surface to the place
};

/// What is the wall's own when grains hit it; else it is as if they hit each other.
struct WallSurface {
  std::optional<double> friction, static_friction, restitution, tangential_restitution;
  std::optional<double>
      temperature;   ///< an energy: grains leave it as if they came from a gas of this temperature
  int material = 0;  ///< as the scene numbers them
};

/// How a wall moves: steadily, and to and fro along its normal, A sin 2πft.
template <int D>
struct WallMotion {
  Vec<D> velocity{};
  double amplitude = 0, frequency = 0;
  double rate() const { return 2 * std::numbers::pi * frequency; }
};

/// What grains do not pass: infinitely heavy, so that a contact has the grain's own mass as m_eff. Without an outline it
/// is a plane.
template <int D>
struct Wall {
  Vec<D> point{};
  Vec<D> normal{};  ///< unit vector, into the grains; of a cylinder none
  Outline<D> outline{};
  WallSurface surface{};
  WallMotion<D> motion{};

  using Bounded = std::variant_alternative_t<1, Outline<D>>;
  const Cylinder<D>* cylinder() const { return std::get_if<Cylinder<D>>(&outline); }
  const Bounded* bounded() const { return std::get_if<Bounded>(&outline); }
  bool oscillates() const { return motion.amplitude > 0 && motion.frequency > 0; }
  bool moves() const {
    return oscillates() || norm(motion.velocity) > 0 || (cylinder() && cylinder()->spin != 0);
  }

  /// Where the wall has gone to at time t, and how fast it goes.
  Vec<D> shift(double t) const {
    return t * motion.velocity + (motion.amplitude * std::sin(motion.rate() * t)) * normal;
  }
  Vec<D> drift(double t) const {
    return motion.velocity + (motion.amplitude * motion.rate() * std::cos(motion.rate() * t)) * normal;
  }
  /// Upper bounds of its speed and of its acceleration.
  double top_speed() const { return norm(motion.velocity) + motion.amplitude * motion.rate(); }
  double top_acceleration() const { return motion.amplitude * motion.rate() * motion.rate(); }

  /// The way to a place from the wall's point, for bounded walls from its nearest image.
  Vec<D> way_to(const Vec<D>& place, double t, const Domain<D>& domain) const {
    Vec<D> way = place - point - shift(t);
    if (bounded())
      for (int k = 0; k < D; ++k)
        if (domain.periodic(k)) way[k] -= domain.length[k] * std::round(way[k] / domain.length[k]);
    return way;
  }
  Nearest<D> nearest(const Vec<D>& place, double t, const Domain<D>& domain) const {
    const Vec<D> way = way_to(place, t, domain);
    if (const auto* round = cylinder()) {
      const Vec<D> radial = round->radial(way);
      const double far = norm(radial);
      if (far == 0) return {round->radius, across()};
      return {round->radius - far, (-1 / far) * radial};
    }
    const auto* ending = bounded();
    if (!ending) return {dot(way, normal), normal};
    const Vec<D> out = way - ending->closest(way);
    const double far = norm(out);
    return {far, far > 0 ? (1 / far) * out : normal};
  }
  /// Velocity of the surface where it is touched from `normal`'s side.
  Vec<D> surface_velocity(const Nearest<D>& touch, double t) const {
    const auto* round = cylinder();
    return round ? drift(t) + round->turning(-round->radius * touch.normal) : drift(t);
  }
  /// R_eff of a contact with a grain of that radius: walls are flat, or hollow.
  double effective_radius(double R) const {
    const auto* round = cylinder();
    return round ? R * round->radius / (round->radius - R) : R;
  }
  /// Height of a place above the wall as it stands at the start.
  double height(const Vec<D>& place) const { return nearest(place, 0, {}).height; }

 private:
  /// Some direction across a cylinder's axis: what touches it on the axis touches it everywhere.
  Vec<D> across() const {
    Vec<D> out{};
    if constexpr (D == 3) {
      const auto& a = cylinder()->axis;
      out = std::abs(a[0]) < 0.6 ? cross(a, {{1, 0, 0}}) : cross(a, {{0, 1, 0}});
      return (1 / norm(out)) * out;
    }
    out[0] = 1;
    return out;
  }
};

}  // namespace chute
