#pragma once
#include <cstdint>
#include <vector>

#include "core/engine.hpp"

namespace chute::measure {

/// Averages over all moving grains at one time, and the energy account.
struct SeriesRow {
  double time;
  double x;         ///< mean place along the incline, counted on through the periods
  double v_x, v_y;  ///< mean velocity along and away from the incline
  double omega;     ///< mean spin, positive when rolling downhill (clockwise)
  std::int64_t contacts;
  EnergyAccount energy;

  template <class Archive>
  void serialize(Archive& a) {
    a(time, x, v_x, v_y, omega, contacts, energy.translation, energy.rotation, energy.elastic,
      energy.gravity_work, energy.normal_loss, energy.shear_loss, energy.start);
  }
};

SeriesRow observe_series(const Engine& engine);

}  // namespace chute::measure
