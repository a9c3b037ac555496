#include <algorithm>
#include <cmath>

#include "beds/crowd.hpp"
#include "beds/planes.hpp"
#include "core/random.hpp"

namespace chute::beds {

Sheet LatticePlane::arrange(const Site& site) const {
  // Rows along x as far apart as in a triangular lattice of this density, an even number of them, with as many beads in
  // each as the count allows.
  const double area = length() * width() / static_cast<double>(count);
  const double spacing = std::sqrt(area * 2 / std::sqrt(3.0));
  const auto rows = 2 * std::max<std::int64_t>(1, std::llround(width() / (std::sqrt(3.0) * spacing)));
  Crowd crowd(length(), width());
  for (std::int64_t row = 0, first = 0; row < rows; ++row) {
    const auto end = (row + 1) * count / rows, in_row = end - first;
    for (std::int64_t k = 0; k < in_row; ++k) {
      Random random(site.seed, Purpose::bed, static_cast<std::uint64_t>(first + k));
      const double shift = row % 2 == 0 ? 0.25 : 0.75;
      const double x = (static_cast<double>(k) + shift) * length() / static_cast<double>(in_row);
      const double y = (static_cast<double>(row) + 0.5) * width() / static_cast<double>(rows);
      const double dx = noise * radius() * random.normal();
      crowd.add({x + dx, y + noise * radius() * random.normal()}, radius());
    }
    first = end;
  }
  crowd.push_apart();
  return crowd.sheet();
}

}  // namespace chute::beds
