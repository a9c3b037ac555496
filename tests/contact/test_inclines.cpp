// A ball, or a block, on a plane that is inclined by θ: it rolls, slides, sticks or stops as Coulomb's relation (2.32)
// has it. Forces are constant, so that the velocities of time steps are exact.
#include <catch2/catch.hpp>

#include "few_grains.hpp"

using namespace chute;
using namespace chute::test;

namespace {

/// One ball on a plane inclined by θ, launched with v and, in 2D, ω.
template <int D>
ContactEngine<D> on_plane(double theta, double mu_s, double mu_d, double kappa, double v = 0,
                          double omega = 0, bool rotation = true) {
  Grains<D> grains;
  Vec<D> place{}, velocity{};
  place[D - 1] = 0.5, velocity[0] = v;
  add_ball<D>(grains, place, velocity, true, 0.5, kappa);
  grains.spin[D == 2 ? 0 : 1][0] = omega;
  if (!rotation) grains.inverse_inertia[0] = 0;
  auto setup = setup_of<D>(mu_d);
  setup.static_friction = mu_s;
  pull<D>(setup, gravity_on_incline<D>(1, theta));
  setup.walls = {floor_at<D>()};
  return ContactEngine<D>(std::move(grains), setup);
}

/// What κ does: rolls if tan θ ≤ (1 + κ)/κ μ_s; a = g sin θ/(1 + κ), F_s = κ/(1 + κ) m g sin θ. Else
/// a = g (sin θ − μ_d cos θ), α = μ_d g cos θ/(κ R).
template <int D>
void rolls_or_slides(double kappa, double mu) {
  const double limit = std::atan((1 + kappa) / kappa * mu), R = 0.5;
  for (const double theta :
       {0.3 * limit, 0.98 * limit, limit + 0.05 * (1.5 - limit), limit + 0.5 * (1.5 - limit)}) {
    auto engine = on_plane<D>(theta, mu, mu, kappa);
    engine.advance_to(200);
    const bool rolls = theta < limit;
    const double t = 2, a = rolls ? std::sin(theta) / (1 + kappa) : std::sin(theta) - mu * std::cos(theta);
    const double alpha = rolls ? a / R : mu * std::cos(theta) / (kappa * R);
    CAPTURE(D, kappa, theta, limit);
    CHECK(engine.state().velocity[0][0] == Approx(a * t).epsilon(1e-8));
    const double spin = engine.state().spin[D == 2 ? 0 : 1][0];
    CHECK((D == 2 ? -spin : spin) == Approx(alpha * t).epsilon(1e-8));
    CHECK(engine.state().position[D - 1][0] == Approx(0.5).margin(1e-9));
    CHECK(engine.grains().unwrapped(0, 0) == Approx(a * t * t / 2).epsilon(1e-8));
    const auto contacts = engine.contacts();
    REQUIRE(contacts.size() == 1);
    CHECK(contacts[0].normal_force == Approx(std::cos(theta)).epsilon(1e-8));
    const double shear = rolls ? kappa / (1 + kappa) * std::sin(theta) : mu * std::cos(theta);
    CHECK(std::abs(contacts[0].shear_force) == Approx(shear).epsilon(1e-8));
    CHECK(contacts[0].force[0] == Approx(shear).epsilon(1e-8));  // on the plane, downhill
    CHECK(contacts[0].state == (rolls ? ContactState::stick : ContactState::slide));
    CHECK(contacts[0].mobilisation == Approx(rolls ? shear / (mu * std::cos(theta)) : 1).epsilon(1e-8));
    const auto e = engine.energy();
    CHECK(std::abs(e.residual()) < 1e-10);
    CHECK(e.normal_loss == Approx(0).margin(1e-10));
    if (rolls) CHECK(e.shear_loss == Approx(0).margin(1e-10));
  }
}

}  // namespace

TEST_CASE("a ball on an incline rolls up to tan θ = (1 + κ)/κ μ and slides beyond") {
  for (const double mu : {0.1, 0.3}) {
    rolls_or_slides<2>(0.4, mu);
    rolls_or_slides<2>(0.5, mu);
    rolls_or_slides<3>(0.4, mu);
  }
}

TEST_CASE(
    "between 7/2 of both frictions a sphere that is released rolls, and one with slip slides for ever") {
  constexpr double mu_s = 0.5, mu_d = 0.3, kappa = 0.4;
  for (const double tangent : {1.1, 1.4, 1.7}) {  // between 1.05 and 1.75
    const double theta = std::atan(tangent), t = 4;
    auto released = on_plane<2>(theta, mu_s, mu_d, kappa);
    released.advance_to(400);
    CAPTURE(tangent);
    CHECK(released.state().velocity[0][0] == Approx(std::sin(theta) / (1 + kappa) * t).epsilon(1e-8));
    CHECK(released.contacts().at(0).state == ContactState::stick);
    auto launched = on_plane<2>(theta, mu_s, mu_d, kappa, 0.1);
    launched.advance_to(400);
    const double a = std::sin(theta) - mu_d * std::cos(theta);
    CHECK(launched.state().velocity[0][0] == Approx(0.1 + a * t).epsilon(1e-8));
    CHECK(launched.contacts().at(0).state == ContactState::slide);
  }
  // Below 7/2 μ_d the slip dies out: it rolls in the end, whatever it began with.
  const double theta = std::atan(0.9);
  auto launched = on_plane<2>(theta, mu_s, mu_d, kappa, 0.1);
  launched.advance_to(2000);
  CHECK(launched.contacts().at(0).state == ContactState::stick);
  // Beyond 7/2 μ_s it slides from rest, and then with μ_d.
  const double steep = std::atan(1.8);
  auto released = on_plane<2>(steep, mu_s, mu_d, kappa);
  released.advance_to(400);
  CHECK(released.state().velocity[0][0] ==
        Approx(4 * (std::sin(steep) - mu_d * std::cos(steep))).epsilon(1e-8));
}

TEST_CASE("a block stays up to tan θ = μ_s; pushed, it slides for ever from μ_d on, and below it stops") {
  constexpr double mu_s = 0.5, mu_d = 0.3, v_0 = 0.2;
  const auto block = [&](double tangent, double v) {
    return on_plane<2>(std::atan(tangent), mu_s, mu_d, 0.4, v, 0, false);
  };
  for (const double tangent : {0.1, 0.35, 0.49}) {
    auto rests = block(tangent, 0);
    rests.advance_to(500);
    CAPTURE(tangent);
    CHECK(rests.state().velocity[0][0] == Approx(0).margin(1e-9));
    CHECK(rests.contacts().at(0).mobilisation == Approx(tangent / mu_s).epsilon(1e-8));
  }
  for (const double tangent : {0.35, 0.49, 0.51, 0.9}) {
    const double theta = std::atan(tangent), a = std::sin(theta) - mu_d * std::cos(theta);
    CAPTURE(tangent);
    auto pushed = block(tangent, v_0);
    pushed.advance_to(500);
    CHECK(pushed.state().velocity[0][0] == Approx(v_0 + 5 * a).epsilon(1e-8));
    if (tangent < mu_s) continue;
    auto released = block(tangent, 0);
    released.advance_to(500);
    CHECK(released.state().velocity[0][0] == Approx(5 * a).epsilon(1e-8));
  }
  for (const double tangent : {0.1, 0.25}) {
    const double theta = std::atan(tangent), a = mu_d * std::cos(theta) - std::sin(theta);
    const double stops = v_0 / a, way = v_0 * v_0 / (2 * a);
    CAPTURE(tangent, stops);
    auto pushed = block(tangent, v_0);
    pushed.advance_to(static_cast<std::int64_t>(stops / 0.01) - 1);
    CHECK(pushed.state().velocity[0][0] > 0);
    pushed.advance_to(static_cast<std::int64_t>(stops / 0.01) + 1);
    CHECK(pushed.state().velocity[0][0] == Approx(0).margin(1e-9));
    pushed.advance_to(2000);
    CHECK(pushed.state().velocity[0][0] == Approx(0).margin(1e-9));
    CHECK(pushed.grains().unwrapped(0, 0) == Approx(way).margin(0.01 * v_0));  // to a step
  }
}

TEST_CASE("a block on a plane that is tilted starts when tan θ reaches μ_s, and stops when it is below μ_d") {
  constexpr double mu_s = 0.5, mu_d = 0.3;
  for (const bool up : {true, false}) {
    Grains<2> grains;
    add_ball<2>(grains, {{0, 0.5}}, {{up ? 0 : 1.0, 0}});
    grains.inverse_inertia[0] = 0;
    auto setup = setup_of<2>(mu_d);
    setup.static_friction = mu_s;
    const double from = up ? 0.2 : 0.3;
    pull<2>(setup, gravity_on_incline<2>(1, from));
    setup.tilt = Tilt{from, up ? 0.8 : 0.1, 0.01, 1};
    setup.walls = {floor_at<2>()};
    ContactEngine<2> engine(grains, setup);
    double angle = 0;
    for (std::int64_t step = 1; step < 6000 && angle == 0; ++step) {
      engine.advance_to(step);
      const double v = engine.state().velocity[0][0];
      if (up ? v > 1e-8 : v < 1e-8) angle = setup.tilt->angle(engine.time());
    }
    if (up) CHECK(angle == Approx(std::atan(mu_s)).margin(1e-3));
    if (!up) CHECK(angle < std::atan(mu_d));
    CHECK(angle > 0);
    CHECK(std::abs(engine.energy().residual()) < 1e-9);
  }
}
