#pragma once
#include <cmath>
#include <tuple>
#include <vector>

#include "core/random.hpp"
#include "search/pairs.hpp"

namespace chute::test {

/// Grains of two sizes thrown at random into a box, which overlaps are welcome to; the last ones are fixed.
template <int D>
Grains<D> packing(std::size_t moving, std::size_t fixed, const Vec<D>& lower, const Vec<D>& length,
                  std::uint64_t seed) {
  Random random(seed, Purpose::bed);
  Grains<D> grains;
  for (std::size_t i = 0; i < moving + fixed; ++i) {
    Vec<D> r;
    for (int k = 0; k < D; ++k) r[k] = lower[k] + length[k] * random.uniform();
    const double radius = i % 3 == 0 ? 0.2 : 0.5;
    grains.add(r, radius, 1, 1, i < moving);
  }
  return grains;
}

using Pair = std::tuple<std::int32_t, std::int32_t, double>;  ///< i, j, reach squared

inline std::vector<Pair> listed(const search::PairList& pairs) {
  std::vector<Pair> all;
  for (std::size_t p = 0; p < pairs.size(); ++p)
    all.emplace_back(pairs.i[p], pairs.j[p], pairs.reach_squared[p]);
  return all;
}

/// The same of pairs that only have names.
template <int D>
std::vector<Pair> listed(const search::PairNames& pairs, const Grains<D>& grains) {
  search::PairList full;
  for (std::size_t p = 0; p < pairs.size(); ++p)
    full.add(grains, static_cast<std::size_t>(pairs.i[p]), static_cast<std::size_t>(pairs.j[p]));
  return listed(full);
}

/// The truth: pairs whose nearest images, of the eight or 26 around, have a gap of less than `skin`.
template <int D>
std::vector<Pair> by_images(const Grains<D>& grains, const Domain<D>& domain, double skin) {
  std::vector<Pair> all;
  for (std::size_t i = 0; i < grains.moving; ++i)
    for (std::size_t j = i + 1; j < grains.size(); ++j) {
      double nearest = 0;
      for (int k = 0; k < D; ++k) {
        const double d = grains.position[k][j] - grains.position[k][i];
        double best = d * d;
        if (std::isfinite(domain.length[k]))
          for (int image : {-1, 1})
            best = std::min(best, (d + image * domain.length[k]) * (d + image * domain.length[k]));
        nearest += best;
      }
      const double reach = grains.radius[i] + grains.radius[j];
      if (std::sqrt(nearest) < reach + skin)
        all.emplace_back(static_cast<std::int32_t>(i), static_cast<std::int32_t>(j), reach * reach);
    }
  return all;
}

}  // namespace chute::test
