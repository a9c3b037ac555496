#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/frame.hpp"
#include "core/grains.hpp"

namespace chute::engines {

/// What methods that know only geometry tell of a packing.
struct Packing {
  double fraction = 0;     ///< φ in its bulk; NaN where nothing bounds it sideways
  double mean_height = 0;  ///< of the moving grains' centres
  double tracer = 0;       ///< height of the largest grain's centre; of equal ones, of the first
};

/// Part of a sphere (in 2D of a disc) of radius R, as volume (area), that lies below a plane `z` above its centre.
template <int D>
double part_below(double R, double z) {
  const double h = std::clamp(z, -R, R);
  if constexpr (D == 2)
    return R * R * (std::numbers::pi / 2 + std::asin(h / R)) + h * std::sqrt(R * R - h * h);
  else
    return std::numbers::pi * (2 * R * R * R / 3 + R * R * h - h * h * h / 3);
}

/// The packing as it lies. φ is exact between two heights: five mean diameters above height 0, where the bed orders it,
/// and as much below its surface, or a quarter of its height where it is shallow. Its surface is twice the mean height.
template <int D>
Packing packing_of(const Grains<D>& grains, const Domain<D>& domain, const Frame& frame) {
  constexpr double margin = 5, shallow = 0.25;
  const auto& z = grains.position[D - 1];
  const auto n = static_cast<double>(grains.moving);
  const auto end = static_cast<std::ptrdiff_t>(grains.moving);
  Packing packing;
  packing.mean_height = std::accumulate(z.begin(), z.begin() + end, 0.0) / n;
  const auto largest =
      std::max_element(grains.radius.begin(), grains.radius.begin() + end) - grains.radius.begin();
  packing.tracer = z[static_cast<std::size_t>(largest)];
  packing.fraction = std::numeric_limits<double>::quiet_NaN();
  for (int k = 0; k + 1 < D; ++k)
    if (!domain.periodic(k)) return packing;
  const double diameter = 2 * std::accumulate(grains.radius.begin(), grains.radius.begin() + end, 0.0) / n;
  const double top = 2 * packing.mean_height, cut = std::min(margin * diameter, shallow * top);
  if (!(top > 2 * cut)) return packing;
  double filled = 0;
  for (std::size_t i = 0; i < grains.size(); ++i)
    filled += part_below<D>(grains.radius[i], top - cut - z[i]) - part_below<D>(grains.radius[i], cut - z[i]);
  packing.fraction = filled / (frame.footprint * (top - 2 * cut));
  return packing;
}

}  // namespace chute::engines
