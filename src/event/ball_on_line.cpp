#include "event/ball_on_line.hpp"

#include <cmath>
#include <numbers>

namespace chute::event {

EventEngine<2> make_engine(const BallOnLine& ball) {
  Grains<2> grains;
  const double r = ball.radius, R = ball.size_ratio * r;
  const auto add = [&](Vec<2> place, double radius, bool moves) {
    const double mass = ball.density * 4 / 3 * std::numbers::pi * radius * radius * radius;
    grains.add(place, radius, mass, 0.4 * mass * radius * radius, moves);
  };
  add({{r * (2 + ball.gap), R + 1.05 * r}}, R, true);
  grains.velocity[0][0] = ball.velocity;
  grains.velocity[1][0] = ball.velocity_up;
  for (int i = 0; i < ball.beads; ++i) add({{r + i * 2 * r * (1 + ball.gap), 0}}, r, false);
  EventSetup<2> setup;
  setup.domain.length[0] = ball.period();
  setup.gravity = {{ball.gravity * std::sin(ball.theta), -ball.gravity * std::cos(ball.theta)}};
  setup.contact = ball.contact;
  setup.contact_time = ball.contact_time;
  setup.tick = ball.tick;
  setup.floor = -2 * (R + r);
  return EventEngine<2>(std::move(grains), setup);
}

}  // namespace chute::event
