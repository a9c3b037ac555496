#include "engines/hard/first_contact.hpp"

#include <algorithm>
#include <array>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>

namespace chute::hard {
namespace {

/// The root of a function that changes sign once between low and high, to the last bits; the end at which the
/// function still has the sign it has at `low`.
template <class Function>
double root_before(const Function& f, double low, double high, double at_low, double at_high) {
  if (at_low == 0) return low;
  if (at_high == 0) return high;
  const boost::math::tools::eps_tolerance<double> close(std::numeric_limits<double>::digits - 1);
  std::uintmax_t most = 100;
  const auto bracket = boost::math::tools::toms748_solve(f, low, high, at_low, at_high, close, most);
  return bracket.first;
}

/// Half the derivative of the gap, ½ d|r|²/dt = r·r': a cubic with a positive leading coefficient. Its roots
/// are where the gap turns, and its own turning points are a quadratic's roots; between those everything is
/// monotone.
struct Closing {
  double c0, c1, c2, c3;
  template <int D>
  explicit Closing(const Approach<D>& a)
      : c0(dot(a.d, a.v)),
        c1(dot(a.v, a.v) + dot(a.d, a.a)),
        c2(1.5 * dot(a.v, a.a)),
        c3(0.5 * dot(a.a, a.a)) {}

  double operator()(double t) const { return c0 + t * (c1 + t * (c2 + t * c3)); }

  /// Turning points, ascending; NaN if there are none.
  std::array<double, 2> turns() const {
    const double discriminant = c2 * c2 - 3 * c1 * c3;
    const double q = -(c2 + std::copysign(std::sqrt(discriminant), c2));  // no cancellation
    const double first = q / (3 * c3), second = c1 / q;
    return first < second ? std::array{first, second} : std::array{second, first};
  }
  /// A time after which the cubic is positive: Fujiwara's bound on its roots.
  double positive_after() const {
    return 2 * std::max({std::abs(c2 / c3), std::sqrt(std::abs(c1 / c3)), std::cbrt(std::abs(c0 / c3))});
  }
};

/// A grain in flight and a fixed one: (2.21) with ½ g t², a quartic. The gap falls only while Closing is
/// negative: in at most two stretches. Each ends where the gap is least; the spheres touch in it if the gap
/// there is not positive.
template <int D>
double first_contact_quartic(const Approach<D>& a) {
  const Closing closing(a);
  double at = 0, value = closing.c0;  // the cubic at the begin of a monotone stretch
  double falls_from = value < 0 ? 0 : never;
  if (value == 0 && (closing.c1 < 0 || (closing.c1 == 0 && closing.c2 < 0))) falls_from = 0;
  if (falls_from == 0 && a.gap(0) <= 0) return 0;

  const auto turns = closing.turns();
  const std::array ends{turns[0], turns[1], std::max(closing.positive_after(), turns[1])};
  for (const double end : ends) {
    if (!(end > at)) continue;  // behind us, or no turning point
    const double at_end = closing(end);
    const bool falling = falls_from < never;
    if (falling ? at_end > 0 : at_end < 0) {
      const double turn = root_before(closing, at, end, value, at_end);
      if (!falling) {
        falls_from = turn;
      } else {
        const double before = a.gap(falls_from), least = a.gap(turn);
        if (before <= 0) return falls_from;
        if (least <= 0)
          return root_before([&](double t) { return a.gap(t); }, falls_from, turn, before, least);
        falls_from = never;
      }
    }
    at = end;
    value = at_end;
  }
  return never;
}

}  // namespace

template <int D>
double first_contact(const Approach<D>& approach) {
  return dot(approach.a, approach.a) > 0 ? first_contact_quartic(approach) : first_contact_linear(approach);
}

double first_contact_with_plane(double gap, double speed, double pull) {
  if (gap <= 0 && (speed < 0 || (speed == 0 && pull < 0))) return 0;
  const double square = speed * speed - 2 * pull * gap;  // of the velocity when it touches
  if (speed < 0) return square >= 0 ? 2 * gap / (std::sqrt(square) - speed) : never;  // or it turns before
  if (pull >= 0) return never;
  return (speed + std::sqrt(std::max(0.0, square))) /
         -pull;  // less than 0 by rounding: it touches as it turns
}

template double first_contact(const Approach<2>&);
template double first_contact(const Approach<3>&);

}  // namespace chute::hard
