#include <catch2/catch.hpp>

#include "ball_on_line.hpp"
#include "theory/rolling.hpp"

using namespace chute;
using namespace chute::event;

namespace {

/// v̄_x over whole beads: the time between the first and the last hit on a new bead.
double mean_velocity(const BallOnLine& ball, double transient, double duration) {
  auto engine = make_engine(ball);
  const auto ticks = [&](double t) { return std::llround(t / ball.tick); };
  engine.advance_to(ticks(transient));
  engine.collect_impacts(true);
  engine.advance_to(ticks(transient + duration));
  double first = 0, last = 0;
  std::int64_t bead = -1, passed = -1;
  for (const auto& impact : engine.take_impacts()) {
    if (impact.bead == bead) continue;
    bead = impact.bead;
    if (++passed == 0) first = impact.time;
    last = impact.time;
  }
  return static_cast<double>(passed) * 2 * ball.radius * (1 + ball.gap) / (last - first);
}

}  // namespace

TEST_CASE(
    "with e_n = 0 and endless friction the mean velocity is that of the corrected theory, not the printed "
    "one") {
  using theory::Version;
  for (const double phi : {1.75, 3.0})
    for (const double gap : {0.0, 0.1})
      for (const double above : {0.01, 0.04}) {
        const theory::Line line{phi, gap};
        const double theta = theory::boundary_ab(line, Version::corrected) + above;
        BallOnLine ball{.size_ratio = phi, .theta = theta, .gap = gap};
        ball.contact = {laws::ConstantRestitution{0}, {.friction = 1e9, .beta = 0}};
        ball.contact_time = 5e-5;
        const double corrected = theory::steady_passage(line, theta, Version::corrected)->mean_velocity;
        ball.velocity =
            2 * corrected;  // it has no spin yet and falls on the first bead: that takes about half
        const double v = mean_velocity(ball, 3, 1);
        const double printed = theory::steady_passage(line, theta, Version::printed)->mean_velocity;
        CAPTURE(phi, gap, std::sin(theta), printed);
        CHECK(v == Approx(corrected).epsilon(2e-3));
        CHECK(v < 0.99 * printed);
      }
}

TEST_CASE(
    "with e_n = 0 and endless friction the ball stops below the corrected boundary AB, and moves above it") {
  for (const double phi : {1.75, 3.0}) {
    const theory::Line line{phi};
    const double boundary = theory::boundary_ab(line, theory::Version::corrected);
    for (const double ratio : {0.95, 1.05}) {
      BallOnLine ball{.size_ratio = phi, .theta = ratio * boundary, .velocity = 0.2};
      ball.contact = {laws::ConstantRestitution{0}, {.friction = 1e9, .beta = 0}};
      ball.contact_time = 5e-5;
      auto engine = make_engine(ball);
      engine.advance_to(5000);
      const double before = engine.grains().unwrapped(0, 0);
      engine.advance_to(6000);
      const bool moves = engine.grains().unwrapped(0, 0) - before > 0.01;
      CAPTURE(phi, ratio);
      CHECK(moves == (ratio > 1));
    }
  }
}
