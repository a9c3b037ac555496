#include "beds/rough.hpp"

#include <fmt/format.h>

#include "beds/heights.hpp"

namespace chute::beds {

std::optional<Refusal> Rough::misfit(const Site& site) const {
  constexpr std::int64_t fewest = 3, most = 10'000'000;
  if (site.dimensions != 2) return Refusal{"bed.kind", "\"rough\" is a line: it needs dimensions = 2"};
  if (count() < fewest || count() > most)
    return Refusal{"bed.length",
                   fmt::format("{:.6g} has room for {} beads of diameter {:.6g}, needed 3 to 1e7", length,
                               count(), diameter)};
  return too_uneven(height_std, diameter);
}

Ground Rough::lay(const Site& site) const {
  Ground ground;
  const double step = length / static_cast<double>(count()), r = diameter / 2;
  const double depth = depth_of_second_layer(diameter, step / 2);
  for (std::int64_t i = 0; i < count(); ++i)
    ground.beads.push_back(
        {(static_cast<double>(i) + 0.5) * step, 0, height_of(site.seed, i, height_std), r});
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
