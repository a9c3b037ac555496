#include <algorithm>
#include <cmath>

#include "beds/crowd.hpp"
#include "beds/planes.hpp"
#include "core/random.hpp"

namespace chute::beds {

Sheet RelaxedPlane::arrange(const Site& site) const {
  constexpr double farthest = 3;  // standard deviations
  Crowd crowd(length(), width());
  for (std::size_t i = 0; i < beads(); ++i) {
    Random random(site.seed, Purpose::bed, i);
    const double x = random.uniform(0, length()), y = random.uniform(0, width());
    crowd.add({x, y}, radius() * (1 + disorder * std::clamp(random.normal(), -farthest, farthest)));
  }
  crowd.push_apart();
  crowd.resize(radius());
  crowd.draw_in(hole * radius());
  return crowd.sheet();
}

}  // namespace chute::beds
