#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <sstream>

#include "common/error.hpp"
#include "engines/stochastic/stochastic_engine.hpp"
#include "theory/stochastic.hpp"

using namespace chute;
using namespace chute::theory;
using stochastic::StochasticEngine;

TEST_CASE(
    "an impact: v_n is reversed by e_n, v_t loses what (4.8) or (4.9) says, and never more than the sticking "
    "value") {
  for (const Friction law : {Friction::published, Friction::without_rotation})
    for (const double gamma : {-0.3, 0.0, 0.2})
      for (const double psi : {0.05, 0.5, 1.5, 8.0}) {
        StochasticModel model;
        model.law = law;
        const Vec<2> n{{std::sin(gamma), std::cos(gamma)}}, s{{std::cos(gamma), -std::sin(gamma)}};
        const Vec<2> after = model.after_impact(-0.3 * n + 0.3 * psi * s, gamma);
        const double weight = law == Friction::published ? 7.0 / 2 : 1;
        const double lost = weight * 1.9 * 0.142;  // of ψ, while it slides
        const double psi_f = psi - lost > -0.45 * psi ? psi - lost : -0.45 * psi;
        CHECK(dot(after, n) == Approx(0.9 * 0.3));
        CHECK(dot(after, s) == Approx(0.3 * psi_f));
      }
}

TEST_CASE("the drawn angles fill (4.16) to φ, with an even impact offset") {
  StochasticModel model;
  model.gap = 0.1;
  for (const double phi : {0.02, 0.1, 0.4}) {
    const Vec<2> v{{2 * std::cos(phi), -2 * std::sin(phi)}};
    const double ratio = 1.1 / 9;  // (1 + ε)/(1 + Φ), Φ = 8
    CHECK(model.contact_angle(v, 0) == Approx(phi));
    CHECK(model.contact_angle(v, 1) == Approx(phi - std::acos(1 - 2 * ratio * std::sin(phi))));
    for (const double u : {0.2, 0.7}) {
      const double gamma = model.contact_angle(v, u);
      CHECK(std::cos(phi - gamma) == Approx(1 - u * 2 * ratio * std::sin(phi)));
      // (4.18) with (4.19), in lengths, r/sin φ for r/sin θ
      const double r = 0.5e-3, R = 4e-3, delta = r / std::sin(phi) - u * 2 * r * 1.1;
      const double x = (R + delta * std::sin(phi)) / (r + R);
      CHECK(std::sin(gamma) == Approx(std::sin(phi) * x - std::cos(phi) * std::sqrt(1 - x * x)));
    }
  }
}

TEST_CASE(
    "with the next bead in the way, angles are those at which a straight flight meets a line of beads") {
  StochasticModel model;
  model.shadowed = true;
  const double r = model.bead_radius, R = model.ball_radius, phi = 0.6;
  const Vec<2> v{{std::cos(phi), -std::sin(phi)}};
  double least = 1, most = -1;
  for (int k = 0; k < 1000; ++k) {
    const double gamma = model.contact_angle(v, (k + 0.5) / 1000);
    least = std::min(least, gamma), most = std::max(most, gamma);
    // No other bead is overlapped on the way: distance of the line of flight to bead m, until contact with
    // bead 0
    for (int m = -20; m <= 20; ++m) {
      const Vec<2> centre{{2 * r * m, 0}}, contact{{(R + r) * std::sin(gamma), (R + r) * std::cos(gamma)}};
      const double back = std::max(0.0, dot(contact - centre, v));  // how far before contact it is nearest
      CHECK(norm(contact - back * v - centre) >= (R + r) * (1 - 1e-9));
    }
  }
  const double gamma_max = std::asin(r / (r + R));
  CHECK(least >= -gamma_max * (1 + 1e-9));
  CHECK(most <= gamma_max * (1 + 1e-9));
}

TEST_CASE("flights: back to the same height for γ < 0, over to the next bead for γ ≥ 0") {
  StochasticModel model;
  model.theta = 0.2;
  CHECK(model.flight_time({{0.3, 0.1}}, -0.1) == Approx(0.2 / (9.81 * std::cos(0.2))));
  CHECK(model.flight_time({{0.3, -0.1}}, 0.1) == Approx(1e-3 / 0.3));
  CHECK(model.flight_time({{0.3, 0.5}}, 0.1) == Approx(1.0 / (9.81 * std::cos(0.2))));  // still rising there
  Random random(1, Purpose::stochastic);
  StochasticWalk walk(model, {{0.3, -0.1}});
  for (int k = 0; k < 1000; ++k) {
    const Vec<2> before = walk.velocity();
    const auto hop = walk.hop(random);
    REQUIRE(hop);
    CHECK(hop->before == before);
    CHECK(walk.velocity()[0] == Approx(hop->after[0] + 9.81 * std::sin(0.2) * hop->time));
    CHECK(walk.velocity()[1] == Approx(hop->after[1] - 9.81 * std::cos(0.2) * hop->time));
    CHECK(walk.velocity()[1] < 0);
    if (hop->gamma < 0) CHECK(walk.velocity()[1] == Approx(-hop->after[1]));
    // kinetic energy gained in flight is gravity's work on the way flown
    const Vec<2> v = walk.velocity();
    CHECK(0.5 * (dot(v, v) - dot(hop->after, hop->after)) ==
          Approx(9.81 * (std::sin(0.2) * hop->way[0] - std::cos(0.2) * hop->way[1])).margin(1e-12));
  }
}

TEST_CASE(
    "as published: a steady state over a wide range of angles, linear in sin θ, faster for larger balls") {
  const auto mean = [](double radius, double sine) {
    StochasticModel model;
    model.ball_radius = radius;
    model.theta = std::asin(sine);
    return mean_velocity(model, 1, 20000);
  };
  for (const double sine : {0.05, 0.2, 0.35}) {
    CHECK_FALSE(mean(3e-3, sine).accelerates);
    CHECK_FALSE(mean(3e-3, sine).trapped);
    CHECK(mean(5e-3, sine).velocity > mean(4e-3, sine).velocity);
    CHECK(mean(4e-3, sine).velocity > mean(3e-3, sine).velocity);
  }
  const double a = mean(4e-3, 0.15).velocity, b = mean(4e-3, 0.2).velocity, c = mean(4e-3, 0.25).velocity;
  CHECK((c - b) / (b - a) == Approx(1).margin(0.15));
  CHECK(mean(4e-3, 0.5).accelerates);
}

TEST_CASE("with only the angles that a ball can reach, the model has no steady state") {
  int steady = 0;
  for (const Friction law : {Friction::published, Friction::without_rotation})
    for (double sine = 0.02; sine < 0.6; sine += 0.04) {
      StochasticModel model;
      model.law = law;
      model.shadowed = true;
      model.theta = std::asin(sine);
      const auto mean = mean_velocity(model, 1, 20000);
      steady += !mean.trapped && !mean.accelerates;
    }
  CHECK(steady == 0);
}

namespace {
StochasticEngine engine(double velocity = 0.3, double sine = 0.2) {
  StochasticModel model;
  model.theta = std::asin(sine);
  World<2> world;
  auto& grains = world.grains;
  const double r = model.bead_radius, R = model.ball_radius;
  grains.add({{0, R + r + 1e-4}}, R, 2, 0.8 * R * R, true);
  grains.velocity[0][0] = velocity;
  for (int i = 0; i < 40; ++i) grains.add({{i * 2 * r, 0}}, r, 1, 1, false);
  world.domain.length[0] = 80 * r;
  return StochasticEngine(world, model, 7, 1e-3);
}
}  // namespace

TEST_CASE(
    "as a run: the account closes, the place is the way flown, a restored run goes on to the same bytes") {
  auto straight = engine(), first = engine(), second = engine();
  straight.collect_impacts(true);
  straight.advance_to(2000);
  const auto e = straight.energy();
  CHECK(e.residual() == Approx(0).margin(1e-12 * e.gravity_work));
  CHECK(straight.take_impacts().size() > 100);
  CHECK(straight.grains().unwrapped(0, 0) == Approx(straight.grains().velocity[0][0] * 2).epsilon(0.5));
  first.advance_to(777);
  std::stringstream saved;
  first.save(saved);
  second.restore(saved);
  second.advance_to(2000);
  std::ostringstream a, b;
  straight.save(a), second.save(b);
  CHECK(a.str() == b.str());
  CHECK_THROWS_AS(engine(0), WorkError);
}
