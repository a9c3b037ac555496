#include "laws/normal_impact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/root.hpp"

namespace chute::laws {
namespace {

struct Point {
  double xi, u;  ///< overlap and its rate
};
Point operator+(Point a, Point b) { return {a.xi + b.xi, a.u + b.u}; }
Point operator*(double s, Point a) { return {s * a.xi, s * a.u}; }

/// One step of Dormand and Prince's method, fifth order, with the estimate of its error.
template <class Slope>
Point dormand_prince(const Slope& slope, Point y, double h, Point& error) {
  const Point a = slope(y);
  const Point b = slope(y + h * (1.0 / 5 * a));
  const Point c = slope(y + h * (3.0 / 40 * a + 9.0 / 40 * b));
  const Point d = slope(y + h * (44.0 / 45 * a + -56.0 / 15 * b + 32.0 / 9 * c));
  const Point e =
      slope(y + h * (19372.0 / 6561 * a + -25360.0 / 2187 * b + 64448.0 / 6561 * c + -212.0 / 729 * d));
  const Point f = slope(y + h * (9017.0 / 3168 * a + -355.0 / 33 * b + 46732.0 / 5247 * c + 49.0 / 176 * d +
                                 -5103.0 / 18656 * e));
  const Point next =
      y + h * (35.0 / 384 * a + 500.0 / 1113 * c + 125.0 / 192 * d + -2187.0 / 6784 * e + 11.0 / 84 * f);
  const Point g = slope(next);
  error = h * (71.0 / 57600 * a + -71.0 / 16695 * c + 71.0 / 1920 * d + -17253.0 / 339200 * e +
               22.0 / 525 * f + -1.0 / 40 * g);
  return next;
}

}  // namespace

NormalImpact integrate_impact(const std::function<double(double, double)>& force, double m_eff, double speed,
                              double time_scale) {
  constexpr double tolerance = 1e-11;
  const auto slope = [&](Point y) { return Point{y.u, -force(std::max(0.0, y.xi), y.u) / m_eff}; };
  Point y{0, speed};
  double t = 0, deepest = 0, h = 1e-4 * time_scale;
  const double never = std::numeric_limits<double>::infinity();
  while (t < 1000 * time_scale) {
    Point error;
    const Point next = dormand_prince(slope, y, h, error);
    const double off = std::max(std::abs(error.xi) / (1e-3 * speed * time_scale + std::max(deepest, y.xi)),
                                std::abs(error.u) / speed);
    const double factor = std::clamp(0.9 * std::pow(tolerance / std::max(off, 1e-30), 0.2), 0.2, 4.0);
    if (off > tolerance) {
      h *= factor;
      continue;
    }
    if (next.xi <= 0 && next.u < 0) break;
    if (y.u > 0 && next.u <= 0) {  // the turning point lies inside: a step of just the right length
      const Point turn = dormand_prince(slope, y, h * y.u / (y.u - next.u), error);
      deepest = turn.xi + 0.5 * turn.u * turn.u / (force(turn.xi, turn.u) / m_eff);
    }
    deepest = std::max(deepest, next.xi);
    y = next;
    t += h;
    h *= factor;
  }
  if (!(t < 1000 * time_scale)) return {0, never, deepest};

  // The last part with s = √ξ as the variable that counts down to 0: then powers of √ξ in the force are
  // smooth. ds/dt = u / 2s, so du/ds = −F 2s / (m u) and dt/ds = 2s / u.
  constexpr int parts = 64;
  const double ds = -std::sqrt(y.xi) / parts;
  const auto at = [&](double s, double u) { return Point{2 * s / u, slope({s * s, u}).u * 2 * s / u}; };
  double s = std::sqrt(y.xi), u = y.u;
  for (int k = 0; k < parts && u < 0; ++k) {
    const Point a = at(s, u), b = at(s + ds / 2, u + ds / 2 * a.u), c = at(s + ds / 2, u + ds / 2 * b.u),
                d = at(s + ds, u + ds * c.u);
    t += ds / 6 * (a.xi + 2 * b.xi + 2 * c.xi + d.xi);
    u += ds / 6 * (a.u + 2 * b.u + 2 * c.u + d.u);
    s += ds;
  }
  return u < 0 ? NormalImpact{-u / speed, t, deepest} : NormalImpact{0, never, deepest};
}

double damping_for(const std::function<double(double)>& restitution, double e_n, double guess) {
  if (e_n >= 1) return 0;
  double high = guess;
  while (restitution(high) > e_n) high *= 2;
  return root_between([&](double damping) { return restitution(damping) - e_n; }, 0, high);
}

}  // namespace chute::laws
