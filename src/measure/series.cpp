#include "measure/series.hpp"

namespace chute::measure {

SeriesRow observe_series(const Engine& engine) {
  const GrainsView grains = engine.grains();
  SeriesRow row{};
  row.time = engine.time();
  const auto& spin = grains.dimensions == 2 ? grains.spin[0] : grains.spin[1];
  for (std::size_t i = 0; i < grains.moving; ++i) {
    row.x += grains.unwrapped(i, 0);
    row.v_x += grains.velocity[0][i];
    row.v_y += grains.velocity[grains.dimensions == 2 ? 1 : 2][i];
    // 2D spins count anticlockwise about z; in 3D z is up and y completes x, so rolling downhill is positive
    // there.
    row.omega += grains.dimensions == 2 ? -spin[i] : spin[i];
  }
  const auto n = static_cast<double>(grains.moving);
  row.x /= n;
  row.v_x /= n;
  row.v_y /= n;
  row.omega /= n;
  row.contacts = static_cast<std::int64_t>(engine.contacts().size());
  row.energy = engine.energy();
  return row;
}

}  // namespace chute::measure
