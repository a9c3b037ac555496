#include <catch2/catch.hpp>

#include "ball_on_line.hpp"
#include "few_grains.hpp"

using namespace chute;
using namespace chute::test;
using namespace chute::event;

namespace {

constexpr double g = 9.81, restitution = 0.7;

/// The place of the ball's centre against the bead's, and its velocity, from an impact's angle and
/// velocities: n = (sin γ, cos γ) leads from the bead to the ball, s = (cos γ, −sin γ) downhill along it.
struct Motion {
  Vec<2> place, velocity;
};
Motion at_impact(const Impact& i, double reach, double v_n) {
  const Vec<2> n{{std::sin(i.gamma), std::cos(i.gamma)}}, s{{std::cos(i.gamma), -std::sin(i.gamma)}};
  return {reach * n, v_n * n + i.v_t * s};
}

}  // namespace

TEST_CASE(
    "from impact to impact of a smooth ball: the recorded flight is the parabola's, and so are the angles") {
  for (const double gap : {0.0, 0.1})
    for (const double sine : {0.09, 0.12, 0.3}) {
      BallOnLine ball{.size_ratio = 2.25, .theta = std::asin(sine), .gap = gap};
      ball.contact = {laws::ConstantRestitution{restitution}, {.friction = 0}};
      auto engine = make_engine(ball);
      engine.collect_impacts(true);
      engine.advance_to(10000);
      const auto impacts = engine.take_impacts();
      REQUIRE(impacts.size() > 20);
      const double reach = ball.radius * (1 + ball.size_ratio), spacing = 2 * ball.radius * (1 + gap);
      const Vec<2> gravity{{g * sine, -g * std::sqrt(1 - sine * sine)}};
      CHECK(std::isnan(impacts[0].flight));
      CHECK(std::isnan(impacts[0].gamma_before));
      int flown = 0, rolled = 0;
      for (std::size_t k = 1; k < impacts.size(); ++k) {
        const Impact &from = impacts[k - 1], &to = impacts[k];
        CHECK(to.gamma_before == from.gamma);
        CHECK_FALSE(to.rolling);  // hard grains' rolling is a train of collisions, none of them an impact
        if (to.flight == 0 || to.flight < 0.999 * (to.time - from.time)) {
          ++rolled;  // a train of collisions in between: no single parabola
          continue;
        }
        ++flown;
        CHECK(to.flight == Approx(to.time - from.time).epsilon(1e-9));
        const auto start = at_impact(from, reach, -restitution * from.v_n);
        const auto end = at_impact(to, reach, to.v_n);
        const double t = to.flight;
        Vec<2> way = start.place + t * (start.velocity + (t / 2) * gravity) - end.place;
        const double beads = std::round(way[0] / spacing);
        CHECK(way[0] == Approx(beads * spacing).margin(1e-12));
        CHECK(way[1] == Approx(0).margin(1e-12));
        CHECK(norm(start.velocity + t * gravity - end.velocity) < 1e-11);
        if (beads >= 0 && beads < ball.beads - (to.bead == 1))
          CHECK((from.bead - 1 + static_cast<std::int64_t>(beads)) % ball.beads == to.bead - 1);
      }
      CAPTURE(gap, sine, rolled);
      CHECK(flown > 15);
    }
}

TEST_CASE("a ball dropped on the top of a bead: flights 2 v e^k/g") {
  Grains<2> grains;
  const double height = 0.5, e = 0.8;
  add_ball<2>(grains, {{0, 2 + height}}, {}, 1, 3, true);
  add_ball<2>(grains, {}, {}, 1, 1, false);
  EventSetup<2> setup;
  setup.gravity = {{0, -1}};
  setup.contact = {laws::ConstantRestitution{e}, {}};
  setup.tick = 0.01;
  EventEngine<2> engine(grains, setup);
  engine.collect_impacts(true);
  engine.advance_to(800);
  const auto impacts = engine.take_impacts();
  REQUIRE(impacts.size() >= 7);
  double v = std::sqrt(2 * height);
  for (std::size_t k = 1; k < 7; ++k) {
    v *= e;
    CHECK(impacts[k].flight == Approx(2 * v).epsilon(1e-12));
    CHECK(impacts[k].gamma_before == Approx(0).margin(1e-14));
  }
}

TEST_CASE("a restitution that depends on the velocity: each bounce of a dropped ball has its own") {
  const double height = 2, loss = 0.3, at = 1.5, exponent = 0.2;
  Grains<2> grains;
  add_ball<2>(grains, {{0, 2 + height}}, {}, 1, 3, true);
  add_ball<2>(grains, {}, {}, 1, 1, false);
  EventSetup<2> setup;
  setup.gravity = {{0, -1}};
  setup.contact = {laws::PowerLawRestitution{loss, at, exponent}, {}};
  setup.tick = 0.01;
  EventEngine<2> engine(grains, setup);
  engine.collect_impacts(true);
  engine.advance_to(1150);
  const auto impacts = engine.take_impacts();
  REQUIRE(impacts.size() >= 8);
  double v = std::sqrt(2 * height);
  for (std::size_t k = 1; k < 8; ++k) {
    v *= 1 - loss * std::pow(v / at, exponent);
    CHECK(impacts[k].v_n == Approx(-v).epsilon(1e-12));
    CHECK(impacts[k].flight == Approx(2 * v).epsilon(1e-12));
  }
}

TEST_CASE("a ball that rolls from bead to bead hits each once, without flight") {
  BallOnLine ball{.size_ratio = 3, .theta = 0.1};
  ball.contact = {laws::ConstantRestitution{0}, {.friction = 1e9, .beta = 0}};
  auto engine = make_engine(ball);
  engine.advance_to(2000);
  engine.collect_impacts(true);
  engine.advance_to(4000);
  const auto impacts = engine.take_impacts();
  REQUIRE(impacts.size() > 20);
  const double gamma_max = std::asin(1 / (1 + ball.size_ratio));
  std::int64_t bead = -1;
  for (const auto& impact : impacts) {
    CHECK(impact.flight == 0);
    CHECK(impact.gamma == Approx(-gamma_max).epsilon(1e-3));
    CHECK(impact.bead != bead);
    bead = impact.bead;
  }
}
