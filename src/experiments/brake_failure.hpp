#pragma once
#include "experiments/ball.hpp"

namespace chute::experiments {

/// A ball skims along a wall, a row of fixed touching grains on the x axis, thesis 2.1.2: it flies along x so
/// low that it meets the first of them under the impact angle ϑ. Hard grains deflect it away from the wall.
/// Soft ones it traverses faster than they can push back: it brakes less than it should and goes on through
/// the next ones ("emergency brake").
struct BrakeFailure {
  laws::ContactLaws laws;
  Ball<2> ball;  ///< velocity along x > 0
  double wall_radius = 1;
  int count = 20;       ///< grains of the wall
  double sine = 0.999;  ///< sin ϑ of the first impact, in (0, 1)
  double steps = 200;   ///< in the contact time, or in the time to pass through a grain, if shorter
  Watch<2> watch = {};

  laws::Pair pair() const;
  double reach() const { return ball.radius + wall_radius; }
  double approach() const;       ///< |v_n| of the first impact
  double shortest_time() const;  ///< t_n, or the time to pass through the first grain
};

struct BrakeFailureOutcome {
  Ball<2> ball;         ///< afterwards
  int touched = 0;      ///< grains of the wall that it touched
  double deepest = 0;   ///< largest overlap
  double duration = 0;  ///< from the first contact to the end of the last
};

/// Until the ball has left the wall. WorkError if it gets stuck.
BrakeFailureOutcome skim(const BrakeFailure& experiment);

}  // namespace chute::experiments
