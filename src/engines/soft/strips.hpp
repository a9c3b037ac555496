#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include "core/domain.hpp"
#include "core/grains.hpp"
#include "core/team.hpp"

namespace chute::soft {

/// The moving grains, in strips across the first direction, one after the other: grains that are near each
/// other in memory are so in space, and a strip at most touches the next ones (and the last one the first,
/// where the direction is periodic). Strips are sets of grains; they stay as they are until the next sorting,
/// while the grains move.
template <int D>
class Strips {
 public:
  /// Where each grain should go: place k of the new order is for grain `result[k]` of the present one.
  /// Depends on nothing but the places and the present order.
  std::vector<std::int32_t> sort(const Grains<D>& grains, const Domain<D>& domain) {
    const auto& x = grains.position[0];
    const std::size_t n = grains.moving;
    double lower = domain.lower[0], length = domain.length[0];
    if (!domain.periodic(0)) {
      const auto [low, high] = std::minmax_element(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(n));
      lower = *low;
      length = *high - *low;
    }
    const double width = usual_width * *std::max_element(grains.radius.begin(), grains.radius.end());
    const double most = static_cast<double>(n) / fewest;
    const auto strips = static_cast<std::size_t>(std::max(1.0, std::floor(std::min(length / width, most))));

    // Narrow slices first, so that the ends of the strips can be moved to the next whole cache line.
    const std::size_t slices = strips * slices_per_strip;
    std::vector<std::size_t> next(slices + 1, 0);
    std::vector<std::uint32_t> slice(n);
    for (std::size_t i = 0; i < n; ++i) {
      const double at = std::floor((x[i] - lower) / length * static_cast<double>(slices));
      // written so that a place that is not a number goes to the first slice
      slice[i] = at > 0 ? static_cast<std::uint32_t>(std::min(at, static_cast<double>(slices - 1))) : 0;
      ++next[slice[i] + 1];
    }
    std::partial_sum(next.begin(), next.end(), next.begin());
    begin_.assign(strips + 1, n);
    for (std::size_t s = 0; s < strips; ++s)
      begin_[s] = std::min(n, (next[s * slices_per_strip] + 4) / 8 * 8);
    std::vector<std::int32_t> from(n);
    for (std::size_t i = 0; i < n; ++i) from[next[slice[i]]++] = static_cast<std::int32_t>(i);
    return from;
  }

  std::size_t count() const { return begin_.empty() ? 0 : begin_.size() - 1; }
  /// Number of grains in the strips before this one.
  std::size_t begin(std::size_t strip) const { return begin_[strip]; }
  Part grains(std::size_t first, std::size_t end) const { return {begin_[first], begin_[end]}; }
  /// The strip in which a grain lies that has `grains` before it.
  std::size_t at(std::size_t grains) const {
    return static_cast<std::size_t>(std::upper_bound(begin_.begin(), begin_.end() - 1, grains) -
                                    begin_.begin()) -
           1;
  }

 private:
  static constexpr double usual_width = 5, fewest = 24;  // width in largest radii, grains on average
  static constexpr std::size_t slices_per_strip = 8;
  std::vector<std::size_t> begin_;  // whole cache lines of numbers, but for the end
};

}  // namespace chute::soft
