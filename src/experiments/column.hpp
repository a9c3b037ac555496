#pragma once
#include "experiments/ball.hpp"

namespace chute::experiments {

/// A column of equal grains, all with the same gap between neighbours and the same velocity along it, hits a
/// wall: thesis 2.1.2. Grains touch each other and the wall, a fixed grain, by the same laws.
struct Column {
  laws::ContactLaws laws;
  Ball<2> grain;        ///< its velocity is not looked at
  int count = 10;       ///< N ≥ 1
  double speed = 1;     ///< towards the wall
  double gap_time = 1;  ///< t_0/t_n: time that a grain needs for the gap, over the contact time of two grains
  double steps_per_contact = 100;
  Watch<2> watch = {};

  double contact_time() const;  ///< t_n of two grains that meet with that speed
};

struct ColumnOutcome {
  double total_restitution;   ///< e_tot (2.15): its momentum when all have left, over that before, negative
  double energy_restitution;  ///< √ of the ratio of the kinetic energies
  double duration;            ///< from the first contact until all disperse
};

/// Until all grains have left the wall and each other. WorkError if that takes longer than it should.
ColumnOutcome hit_wall(const Column& column);

}  // namespace chute::experiments
