#pragma once
#include <array>
#include <cmath>

// Odeint copies steppers whose buffers are not set yet.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#include <boost/numeric/odeint.hpp>
#pragma GCC diagnostic pop

/// The truth for head-on impacts, independent of the code under test: m ξ'' = −F(ξ, ξ'), integrated by
/// Boost.Odeint's adaptive Runge-Kutta-Fehlberg 7(8) method to 1e-12; the end by bisection of the last step.
namespace chute::test {

struct Rebound {
  double restitution, time, deepest;
};

template <class Force>
Rebound odeint_impact(const Force& force, double m_eff, double speed, double time_scale) {
  namespace odeint = boost::numeric::odeint;
  using State = std::array<double, 2>;
  const double length = speed * time_scale;  // integrated in units of this, and of the speed
  const auto slope = [&](const State& y, State& dy, double) {
    dy = {y[1], -force(std::max(0.0, y[0]) * length, y[1] * speed) / m_eff * time_scale / speed};
  };
  auto stepper = odeint::make_controlled<odeint::runge_kutta_fehlberg78<State>>(1e-13, 1e-13);
  State y{0, 1};
  double t = 0, h = 1e-5, deepest = 0;
  for (;;) {
    const State before = y;
    const double start = t;
    if (stepper.try_step(slope, y, t, h) == odeint::fail) continue;
    h = std::min(h, 0.01);
    deepest = std::max(deepest, y[0]);
    if (y[0] > 0) continue;
    odeint::runge_kutta_fehlberg78<State> one;  // the end lies in this step
    double low = 0, high = t - start;
    State end = before;
    for (int k = 0; k < 80; ++k) {
      const double middle = (low + high) / 2;
      one.do_step(slope, before, start, end, middle);
      (end[0] > 0 ? low : high) = middle;
    }
    return {-end[1], (start + low) * time_scale, deepest * length};
  }
}

}  // namespace chute::test
