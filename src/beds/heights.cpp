#include "beds/heights.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/random.hpp"

namespace chute::beds {

std::optional<Refusal> too_uneven(double height_std, double diameter) {
  constexpr double highest = 0.25;  // of a diameter: three of them leave neighbours in reach of each other
  if (!(height_std > highest * diameter)) return {};
  return Refusal{"bed.height_std",
                 fmt::format("{:.6g} is more than a quarter of a bead's diameter", height_std)};
}

double height_of(std::uint64_t seed, std::int64_t bead, double height_std) {
  constexpr double farthest = 3;  // standard deviations
  if (!(height_std > 0)) return 0;
  for (Random random(seed, Purpose::bed, static_cast<std::uint64_t>(bead));;)
    if (const double z = random.normal(); std::abs(z) <= farthest) return height_std * z;
}

double depth_of_second_layer(double diameter, double away) {
  const double r = diameter / 2;
  return away < diameter ? std::max(r, std::sqrt(diameter * diameter - away * away)) : r;
}

}  // namespace chute::beds
