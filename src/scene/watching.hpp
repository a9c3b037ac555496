#pragma once
#include "core/offers.hpp"
#include "scene/scene.hpp"

namespace chute::scene {

/// What observers may ask of the place that they look at.
struct WatchedPlace {
  int repeating = 0;  ///< in how many directions
  std::size_t beads = 0;
};
/// Whatever of [output] asks for more than the method and the scene give.
std::optional<Refusal> refusal_of_outputs(const Scene& scene, const Offers& offers,
                                          const WatchedPlace& place);

}  // namespace chute::scene
