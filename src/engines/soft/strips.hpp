#pragma once
#include <algorithm>
#include <array>
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
    if constexpr (D == 3) sort_inside(grains, width / 2, from);
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

  /// In space a strip is a slab of many grains: those beside each other follow each other, by blocks of this width across and,
  /// in each, by height. A grain's neighbours then lie in few pieces of memory, which stay in the nearest cache meanwhile.
  void sort_inside(const Grains<D>& grains, double width, std::vector<std::int32_t>& from) const {
    using Block = std::array<double, 2>;
    const auto block_of = [&](std::int32_t i) {
      const auto k = static_cast<std::size_t>(i);
      Block block{std::floor(grains.position[1][k] / width), std::floor(grains.position[2][k] / width)};
      for (double& b : block)
        if (std::isnan(b)) b = 0;  // an order all the same
      return block;
    };
    std::vector<std::pair<Block, std::int32_t>> sorted;
    for (std::size_t s = 0; s < count(); ++s) {
      sorted.clear();
      for (std::size_t k = begin_[s]; k < begin_[s + 1]; ++k) sorted.emplace_back(block_of(from[k]), from[k]);
      std::ranges::stable_sort(sorted, {}, &std::pair<Block, std::int32_t>::first);
      for (std::size_t k = begin_[s]; k < begin_[s + 1]; ++k) from[k] = sorted[k - begin_[s]].second;
    }
  }
  std::vector<std::size_t> begin_;  // whole cache lines of numbers, but for the end
};

}  // namespace chute::soft
