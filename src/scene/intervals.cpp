#include "scene/intervals.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace chute::scene {

double interval_of_all_outputs(const Scene& scene) {
  constexpr int most_parts = 12;  // a step that is cut much shorter than it needs to be costs as much
  constexpr double whole = 1e-9;  // what doubles make of a ratio of decimal numbers
  double shortest = std::numeric_limits<double>::infinity();
  std::vector<double> intervals;
  for (const auto& output : scene.output)
    if (output->wanted() && std::isfinite(output->rhythm())) {
      intervals.push_back(output->rhythm());
      shortest = std::min(shortest, intervals.back());
    }
  for (int parts = 1; parts <= most_parts; ++parts)
    if (std::ranges::all_of(intervals, [&](double interval) {
          const double count = interval / shortest * parts;
          return std::abs(count - std::round(count)) <= whole * count;
        }))
      return shortest / parts;
  return shortest;
}

}  // namespace chute::scene
