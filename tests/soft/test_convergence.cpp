#include <catch2/catch.hpp>

#include "two_grains.hpp"

namespace convergence_tests {
using namespace chute;
using namespace chute::test;

namespace {

struct Error {
  double place, speed;
};

/// One grain on a damped spring, which is what the overlap of a contact obeys, from place 0 with speed 1, by
/// the integrator alone. All derivatives are given at the start, so that only the scheme's own error shows.
Error oscillate(soft::Scheme scheme, int steps, double damping) {
  const Oscillator truth{1, damping, 1};
  const double end = 2.5, dt = end / steps;
  Grains<2> grains;
  add_ball<2>(grains, {{0, 0}}, {{1, 0}}, 1, 1);
  soft::GrainSums<2> sums;
  sums.resize(1);
  auto& force = sums.force;
  const auto pull = [&] {
    force[0][0] = -truth.k * grains.position[0][0] - truth.gamma * grains.velocity[0][0];
  };
  soft::Integrator<2> integrator(scheme, dt, {}, {});
  pull();
  integrator.start(grains, sums);
  if (scheme == soft::Scheme::gear5) {
    const double a = force[0][0], b = -truth.k * 1 - truth.gamma * a;  // each follows from the two before it
    integrator.derivatives()[1][0][0] = b;
    integrator.derivatives()[2][0][0] = -truth.k * a - truth.gamma * b;
  }
  for (int i = 0; i < steps; ++i) {
    integrator.predict(grains, sums);
    pull();
    integrator.correct(grains, sums);
  }
  const auto exact = truth.at(end, 0, 1);
  return {std::abs(grains.position[0][0] - exact[0]), std::abs(grains.velocity[0][0] - exact[1])};
}

/// The same from inside a contact of two grains, by the whole engine, which starts without higher
/// derivatives.
Error compress(soft::Scheme scheme, int steps, double damping) {
  const Oscillator truth{1e4, damping, 0.5};
  const double end = 0.5 * truth.contact_time(), dt = end / steps, x0 = 1e-3, v0 = 0.3;
  Grains<2> grains;
  add_ball<2>(grains, {{0, 0}}, {{v0, 0}}, 0.5, 1);
  add_ball<2>(grains, {{1 - x0, 0}}, {{0, 0}}, 0.5, 1);
  soft::SoftEngine<2> engine(grains, setup<2>(smooth(truth.k, truth.gamma), dt, 1, scheme));
  engine.advance_to(steps);
  const auto exact = truth.at(end, x0, v0);
  const auto& g = engine.state();
  return {std::abs(1 - (g.position[0][1] - g.position[0][0]) - exact[0]),
          std::abs(g.velocity[0][0] - g.velocity[0][1] - exact[1])};
}

/// Order of convergence between two halvings, asked of place and speed.
template <class Problem>
Error order(Problem problem, soft::Scheme scheme, double damping) {
  const auto coarse = problem(scheme, 200, damping), fine = problem(scheme, 400, damping);
  return {std::log2(coarse.place / fine.place), std::log2(coarse.speed / fine.speed)};
}

/// What is left of a speed under v' = −rate v after 400 steps of length 1.
double slip_left(soft::Scheme scheme, double rate) {
  Grains<2> grains;
  add_ball<2>(grains, {{0, 0}}, {{1, 0}}, 1, 1);
  soft::GrainSums<2> sums;
  sums.resize(1);
  auto& force = sums.force;
  soft::Integrator<2> integrator(scheme, 1, {}, {});
  force[0][0] = -rate;
  integrator.start(grains, sums);
  for (int i = 0; i < 400; ++i) {
    integrator.predict(grains, sums);
    force[0][0] = -rate * grains.velocity[0][0];
    integrator.correct(grains, sums);
  }
  return std::abs(grains.velocity[0][0]);
}

}  // namespace

// Five values (r and four derivatives) carried exactly: the scheme is of fourth order. Coefficients applied
// to the plain derivatives, as (2.13) is printed, or 19/120 for 19/90 in a damped problem, would show here.
TEST_CASE("gear5 is of fourth order inside a damped contact") {
  const auto p = order(oscillate, soft::Scheme::gear5, 0.2);
  CHECK(p.place == Approx(4).margin(0.15));
  CHECK(p.speed == Approx(4).margin(0.15));
  CHECK(oscillate(soft::Scheme::gear5, 50, 0.2).place < 1e-6);
}

// The engine starts with b = c = 0; the first steps then miss b δt²/8 in the speed, which is of second order.
TEST_CASE("gear5 started inside a contact is of second order, and accurate") {
  const auto p = order(compress, soft::Scheme::gear5, 20);
  CHECK(p.place == Approx(2).margin(0.1));
  CHECK(p.speed == Approx(2).margin(0.1));
  CHECK(compress(soft::Scheme::gear5, 50, 20).speed < 1e-5 * 0.3);  // at t_n/100: 1e-5 of the start's speed
}

// Damping sees the velocity of the half step: first order with damping, second without.
TEST_CASE("velocity Verlet is of second order, of first where damping acts") {
  for (const auto& p :
       {order(oscillate, soft::Scheme::verlet, 0), order(compress, soft::Scheme::verlet, 0)}) {
    CHECK(p.place == Approx(2).margin(0.1));
    CHECK(p.speed == Approx(2).margin(0.1));
  }
  for (const auto& p :
       {order(oscillate, soft::Scheme::verlet, 0.2), order(compress, soft::Scheme::verlet, 20)}) {
    CHECK(p.place > 0.95);
    CHECK(p.speed > 0.95);
  }
}

// Regularised friction lets slip decay at the rate 7/2 γ_s / m_eff. The largest eigenvalue of a gear5 step
// for v' = −λ v reaches −1 at λ δt = 0.30, of a Verlet step at 2: `chute check` tells how close a scene
// comes.
TEST_CASE("slip decays stably below λ δt = 0.3 with gear5, below 2 with Verlet") {
  CHECK(slip_left(soft::Scheme::gear5, 0.28) < 1e-3);
  CHECK(slip_left(soft::Scheme::gear5, 0.32) > 1e3);
  CHECK(slip_left(soft::Scheme::verlet, 1.9) < 1e-3);
  CHECK(slip_left(soft::Scheme::verlet, 2.1) > 1e3);
}

}  // namespace convergence_tests
