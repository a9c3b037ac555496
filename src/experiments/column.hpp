#pragma once

namespace chute::experiments {

/// A column of equal grains, all with the same gap between neighbours and the same velocity along it, hits a
/// wall: thesis 2.1.2. Contacts obey (3.1), with the same e_n for grain on grain and grain on wall.
struct Column {
  int count = 10;             ///< N ≥ 1
  double restitution = 0.87;  ///< e_n
  double gap_time = 1;  ///< t_0/t_n: time that a grain needs for the gap, over the contact time of two grains
  double steps_per_contact = 100;
};

/// e_tot (2.15): the column's momentum after all grains have left the wall and each other, over that before,
/// negative. WorkError if that takes longer than it should.
double total_restitution(const Column& column);

}  // namespace chute::experiments
