#include "beds/rough.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/random.hpp"

namespace chute::beds {

std::optional<Refusal> Rough::misfit(const Site& site) const {
  constexpr std::int64_t fewest = 3, most = 10'000'000;
  constexpr double highest = 0.25;  // of a diameter: three of them leave neighbours in reach of each other
  if (site.dimensions != 2) return Refusal{"bed.kind", "\"rough\" is a line: it needs dimensions = 2"};
  if (count() < fewest || count() > most)
    return Refusal{"bed.length",
                   fmt::format("{:.6g} has room for {} beads of diameter {:.6g}, needed 3 to 1e7", length,
                               count(), diameter)};
  if (height_std > highest * diameter)
    return Refusal{"bed.height_std",
                   fmt::format("{:.6g} is more than a quarter of a bead's diameter", height_std)};
  return {};
}

Ground Rough::lay(const Site& site) const {
  constexpr double farthest = 3;  // standard deviations
  Ground ground;
  const double step = length / static_cast<double>(count()), r = diameter / 2;
  // A bead of the second layer touches the two above it, or where these are too far apart lies half below them.
  const double depth =
      step < 2 * diameter ? std::max(r, std::sqrt(diameter * diameter - step * step / 4)) : r;
  for (std::int64_t i = 0; i < count(); ++i) {
    double z = 0;
    if (height_std > 0)
      for (Random random(site.seed, Purpose::bed, static_cast<std::uint64_t>(i));;)
        if (z = random.normal(); std::abs(z) <= farthest) break;
    ground.beads.push_back({(static_cast<double>(i) + 0.5) * step, 0, height_std * z, r});
  }
  for (std::int64_t i = 0; layers > 1 && i < count(); ++i)
    ground.beads.push_back({static_cast<double>(i) * step, 0, -depth, r});
  ground.length = length;
  ground.spacing = ground.widest_spacing = step;
  return ground;
}

std::vector<Fact> Rough::facts(const Site&) const {
  const double step = length / static_cast<double>(count());
  return {{"beads", static_cast<double>(count() * layers), "", "of the bed"},
          {"epsilon", step / diameter - 1, "", "gap between neighbours' surfaces, in diameters"}};
}

}  // namespace chute::beds
