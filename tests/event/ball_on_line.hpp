#pragma once
#include <cmath>

#include "core/sphere.hpp"
#include "engines/event/event_engine.hpp"

namespace chute::event {

/// The thesis's single ball (4.2.1, steel-2d) with hard-sphere collisions: SI units, angles in radians.
struct BallOnLine {
  double size_ratio = 3;  ///< Φ
  double theta = 0.1;
  double gap = 0;  ///< ε
  HardContact contact{laws::ConstantRestitution{0.7}, {.friction = 0.13, .beta = 0.34}};
  double contact_time = 1e-5;  ///< t_c
  double velocity = 0.3;       ///< at the start, downhill
  double velocity_up = 0.02;   ///< and away from the line
  int beads = 20;              ///< in a period
  double radius = 5e-3;        ///< r
  double density = 7800;
  double gravity = 9.81;
  double tick = 1e-3;

  double period() const { return 2 * radius * (1 + gap) * beads; }
};

/// The ball starts without spin, above the first gap and so close that it falls 0.05 r at most. WorkError if
/// it does not fit.
inline EventEngine<2> make_engine(const BallOnLine& ball) {
  Grains<2> grains;
  const double r = ball.radius, R = ball.size_ratio * r;
  const auto add = [&](Vec<2> place, double radius, bool moves) {
    const double mass = sphere_mass(ball.density, radius);
    grains.add(place, radius, mass, sphere_inertia(mass, radius), moves);
  };
  add({{r * (2 + ball.gap), R + 1.05 * r}}, R, true);
  grains.velocity[0][0] = ball.velocity;
  grains.velocity[1][0] = ball.velocity_up;
  for (int i = 0; i < ball.beads; ++i) add({{r + i * 2 * r * (1 + ball.gap), 0}}, r, false);
  EventSetup<2> setup;
  setup.domain.length[0] = ball.period();
  setup.gravity = gravity_on_incline<2>(ball.gravity, ball.theta);
  setup.contact = ball.contact;
  setup.contact_time = ball.contact_time;
  setup.tick = ball.tick;
  setup.floor = -2 * (R + r);
  return EventEngine<2>(std::move(grains), setup);
}

}  // namespace chute::event
