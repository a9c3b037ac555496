#include "engines/hard/wall_flight.hpp"

#include <algorithm>
#include <cmath>

#include "engines/hard/first_contact.hpp"

namespace chute::hard {
namespace {

/// A contact is found when the height above touching is less than this part of the radius: some hundred times what
/// rounding leaves of places within a thousand radii.
constexpr double close_enough = 1e-13;
/// Steps towards a contact; some ten lead there, and an oscillating wall far below costs one or two per period. A
/// grain that has not arrived after so many skims along the wall.
constexpr int most_steps = 100000;

/// When height + speed s − ½ pull s² is 0, for height ≥ 0 and pull ≥ 0: until then a height that falls at most with that
/// acceleration is positive.
double certainly_above(double height, double speed, double pull) {
  const double root = std::sqrt(speed * speed + 2 * pull * height);
  if (speed <= 0) return root - speed > 0 ? 2 * height / (root - speed) : never;
  return pull > 0 ? (speed + root) / pull : never;
}

/// How the grain stands to the wall at a time: its height above touching, and how fast that changes.
struct Standing {
  double height, speed;
};

template <int D>
struct Descent {
  const Flight<D>& flight;
  const Wall<D>& wall;
  const Domain<D>& domain;
  double pull = norm(flight.gravity) + wall.top_acceleration();

  Nearest<D> nearest(double t) const { return wall.nearest(flight.place_at(t), t, domain); }
  Standing at(double t) const {
    const auto touch = nearest(t);
    return {touch.height - flight.radius, dot(flight.velocity_at(t) - wall.drift(t), touch.normal)};
  }
  /// A time for which the grain surely does not touch, from one at which it stands so.
  double safe(double t, const Standing& now) const {
    const double height = std::max(now.height, 0.0);
    if (const auto* round = wall.cylinder()) {
      // f = ρ_max² − ρ², ρ = ρ_max − height, f' = 2 ρ height'; f'' ≥ −2 (v² + ρ_max a) with v the fastest within the step
      const double most = round->radius - flight.radius, rho = most - height;
      const double fast = norm(flight.velocity_at(t)) + wall.top_speed();
      const double within = 0.5 * most / (fast + std::sqrt(pull * most) + std::numeric_limits<double>::min());
      const double fastest = fast + pull * within;
      return std::min(within, certainly_above(height * (most + rho), 2 * rho * now.speed,
                                              2 * (fastest * fastest + most * pull)));
    }
    double step = certainly_above(height, now.speed, pull);
    if (const auto* ending = wall.bounded()) {  // its other images are at least so far away
      const double fast = norm(flight.velocity_at(t)) + wall.top_speed();
      for (int k = 0; k < D; ++k)
        if (domain.periodic(k))
          step = std::min(
              step, certainly_above(std::max(domain.length[k] / 2 - ending->extent() - flight.radius, 0.0),
                                    -fast, pull));
    }
    return step;
  }
};

}  // namespace

template <int D>
double first_contact_with_wall(const Flight<D>& flight, const Wall<D>& wall, const Domain<D>& domain,
                               double limit) {
  const Descent<D> descent{flight, wall, domain};
  Standing now = descent.at(flight.time);
  if (!wall.oscillates() && !wall.cylinder() && !wall.bounded()) {
    const double t =
        flight.time + first_contact_with_plane(now.height, now.speed, dot(flight.gravity, wall.normal));
    return t <= limit ? t : never;
  }
  const double close = close_enough * flight.radius;
  double t = flight.time;
  for (int k = 0; k < most_steps && t <= limit; ++k) {
    if (now.height <= close && (now.speed < 0 || (now.speed == 0 && descent.pull > 0))) return t;
    const double step = descent.safe(t, now);
    if (step == never) return never;
    if (t + step == t) return now.speed < 0 ? t : never;
    t += step;
    now = descent.at(t);
  }
  return never;
}

template double first_contact_with_wall(const Flight<2>&, const Wall<2>&, const Domain<2>&, double);
template double first_contact_with_wall(const Flight<3>&, const Wall<3>&, const Domain<3>&, double);

}  // namespace chute::hard
