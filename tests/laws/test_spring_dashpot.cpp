#include <catch2/catch.hpp>

#include "laws/list.hpp"

using namespace chute;
using namespace chute::laws;

namespace {

struct Bounce {
  double restitution, time, loss, deepest;
};

/// A head-on impact at speed v, by small steps of Runge and Kutta's method with the law's force alone; the
/// end of the contact, where the overlap is 0 again, by halving the last step.
Bounce bounce(const SpringDashpot& law, double m_eff, double v) {
  const auto force = [&](double xi, double dxi) { return law(xi, dxi, m_eff).total; };
  double step = 1e-3 / std::sqrt(law.stiffness(m_eff) / m_eff);
  double xi = 0, dxi = v, time = 0, loss = 0, deepest = 0;
  for (int halvings = 0; halvings < 40;) {
    const auto a = [&](double x, double u) { return -force(x, u) / m_eff; };
    const double k1 = a(xi, dxi), u2 = dxi + step / 2 * k1, k2 = a(xi + step / 2 * dxi, u2);
    const double u3 = dxi + step / 2 * k2, k3 = a(xi + step / 2 * u2, u3), u4 = dxi + step * k3;
    const double k4 = a(xi + step * u3, u4);
    const double next = xi + step / 6 * (dxi + 2 * u2 + 2 * u3 + u4);
    if (next < 0) {
      step /= 2, ++halvings;
      continue;
    }
    // Simpson's rule for the loss, with the middle of the step from its third stage
    loss += step / 6 * (law(xi, dxi, m_eff).loss_rate + 4 * law(xi, u3, m_eff).loss_rate);
    xi = next;
    dxi += step / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    loss += step / 6 * law(xi, dxi, m_eff).loss_rate;
    time += step;
    deepest = std::max(deepest, xi);
  }
  return {-dxi / v, time, loss, deepest};
}

constexpr double k = 1e5;

}  // namespace

TEST_CASE("the force is k ξ + γ dξ/dt, its conservative part −dE/dξ") {
  const auto law = SpringDashpot::from_damping(k, 30, MassScaling::none);
  const double xi = 1e-3, h = 1e-6, m_eff = 0.3;
  CHECK(law(xi, 0.2, m_eff).total == Approx(k * xi + 30 * 0.2));
  CHECK(law(xi, 0.2, m_eff).loss_rate == Approx(30 * 0.2 * 0.2));
  CHECK(law(xi, 0, m_eff).loss_rate == 0);
  CHECK((law.energy(xi + h, m_eff) - law.energy(xi - h, m_eff)) / (2 * h) == Approx(law(xi, 0, m_eff).total));
}

TEST_CASE("(3.2) and (3.3) are what the motion does") {
  for (const double damping : {0.0, 10.0, 100.0, 200.0}) {
    const auto law = SpringDashpot::from_damping(k, damping, MassScaling::none);
    const double m_eff = 0.5, v = 0.7;
    const auto truth = bounce(law, m_eff, v);
    INFO("damping " << damping);
    CHECK(law.restitution(m_eff) == Approx(truth.restitution).epsilon(1e-7));
    CHECK(law.contact_time(m_eff) == Approx(truth.time).epsilon(1e-7));
    CHECK(truth.loss == Approx(0.5 * m_eff * v * v * (1 - truth.restitution * truth.restitution))
                            .epsilon(1e-5)
                            .margin(1e-12));
  }
}

TEST_CASE("an asked restitution holds for every pair") {
  for (const double e_n : {0.1, 0.6, 0.95, 1.0})
    for (const double m_eff : {1e-4, 0.5, 30.0})
      CHECK(bounce(SpringDashpot::from_restitution(k, e_n), m_eff, 1).restitution ==
            Approx(e_n).epsilon(1e-6));
}

// Thesis 3.1.1, last paragraph: with neither scaled e_n grows with m_eff, with the damping scaled it falls,
// with both e_n and t_n do not depend on it.
TEST_CASE("the three ways for the mass to enter") {
  const auto e = [](MassScaling scaling, double m_eff) {
    return bounce(SpringDashpot::from_damping(k, 40, scaling), m_eff, 1);
  };
  CHECK(e(MassScaling::none, 2).restitution > e(MassScaling::none, 0.5).restitution + 0.01);
  CHECK(e(MassScaling::damping, 2).restitution < e(MassScaling::damping, 0.5).restitution - 0.01);
  CHECK(e(MassScaling::both, 2).restitution == Approx(e(MassScaling::both, 0.5).restitution).epsilon(1e-8));
  CHECK(e(MassScaling::both, 2).time == Approx(e(MassScaling::both, 0.5).time).epsilon(1e-8));
  // all agree where m_eff is 1
  CHECK(e(MassScaling::none, 1).restitution == e(MassScaling::damping, 1).restitution);
  CHECK(e(MassScaling::none, 1).restitution == e(MassScaling::both, 1).restitution);
}

TEST_CASE("over-critical damping never ends a contact, and says so") {
  CHECK_FALSE(std::isfinite(SpringDashpot::from_damping(1, 3, MassScaling::none).contact_time(1)));
}
