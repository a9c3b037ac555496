#pragma once
#include "core/fact.hpp"
#include "engines/kind/method.hpp"

namespace chute::engines {

/// What a method's grains take at most, by which `run` refuses what the machine cannot hold: bytes a grain in the plane and in
/// space. Peaks of runs of 3000 and of 48,000 grains, their start among them, grew by less: soft 630 and 720, event 690 and 870,
/// hybrid 1340, contact 1650, monte-carlo 330, restructuring 950 and 1620. What is given here has a part more for denser contacts,
/// and was guessed from the plane for hybrid, contact and monte-carlo in space.
inline Fact memory_of_grains(const Setting& s, double in_plane, double in_space) {
  constexpr double mega = 1e6;
  return {"memory", (s.dimensions == 2 ? in_plane : in_space) * static_cast<double>(s.grains) / mega, "MB",
          "of the grains, about"};
}

}  // namespace chute::engines
