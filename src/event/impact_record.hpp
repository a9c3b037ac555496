#pragma once
#include <algorithm>
#include <cmath>

#include "core/engine.hpp"
#include "event/flight.hpp"

namespace chute::event {

/// The record of a collision about to happen at `time`; both flights begin there, and n leads from the bead
/// to the grain.
template <int D>
Impact impact_record(double time, std::size_t grain, const Flight<D>& hitting, std::size_t bead,
                     const Flight<D>& hit, const Vec<D>& n) {
  const Vec<D> v = hitting.velocity - hit.velocity, place = hit.place + hit.radius * n;
  Impact impact{};
  impact.time = time;
  impact.grain = static_cast<std::int64_t>(grain);
  impact.bead = static_cast<std::int64_t>(bead);
  for (int k = 0; k < D; ++k) impact.place[static_cast<std::size_t>(k)] = place[k];
  impact.v_n = dot(v, n);
  if constexpr (D == 2) {
    impact.gamma = std::atan2(n[0], n[1]);
    impact.v_t = v[0] * n[1] - v[1] * n[0];  // along s = (n_y, −n_x): downhill at the top of a bead
  } else {
    impact.gamma = std::acos(std::clamp(n[2], -1.0, 1.0));
    impact.phi = std::atan2(n[1], n[0]);
    impact.v_t = norm(v - impact.v_n * n);
  }
  return impact;
}

}  // namespace chute::event
