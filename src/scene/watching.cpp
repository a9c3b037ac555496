#include "scene/watching.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace chute::scene {

std::optional<Refusal> refusal_of_outputs(const Scene& scene, const Offers& offers,
                                          const WatchedPlace& place) {
  const bool closed = place.repeating == scene.dimensions;
  const bool moving_walls = std::ranges::any_of(scene.walls, &WallSpec::moves);
  for (const auto& output : scene.output) {
    if (!output->wanted()) continue;
    const auto needs = output->needs();
    const auto key = "output." + output.word();
    const auto lacks = [&](bool has, bool asked, const char* what,
                           const char* of = "") -> std::optional<Refusal> {
      if (has || !asked) return {};
      return Refusal{key + of, fmt::format("engine.method = \"{}\" {}", scene.engine.word(), what)};
    };
    for (const auto& wrong :
         {lacks(offers.contacts, needs.contacts, "tells of no contacts"),
          lacks(offers.forces, needs.powers, "tells of no forces that act all the time, of which powers are",
                ".powers"),
          lacks(offers.avalanches, needs.avalanches, "tells of no avalanches"),
          lacks(offers.impacts, needs.impacts, "tells of no impacts")})
      if (wrong) return wrong;
    if (needs.powers && moving_walls) return Refusal{key + ".powers", "are told where all walls stand still"};
    if (needs.impacts && !scene.grains.shapes.empty())
      return Refusal{key, "tells of impacts of round grains only"};
    if (needs.plane_of_beads && !(scene.dimensions == 3 && place.beads >= 3 && place.repeating >= 2))
      return Refusal{key, "tells of planes of beads that repeat along and across (dimensions = 3)"};
    if (needs.space && scene.dimensions != 3) return Refusal{key, "is of flows in space (dimensions = 3)"};
    if (needs.closed_box && !closed) return Refusal{key, "needs a domain that repeats in all directions"};
  }
  return {};
}

}  // namespace chute::scene
