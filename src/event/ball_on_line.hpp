#pragma once
#include "event/event_engine.hpp"

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
EventEngine<2> make_engine(const BallOnLine& ball);

}  // namespace chute::event
