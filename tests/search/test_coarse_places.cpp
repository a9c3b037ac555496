// Coarse places (search/coarse_places.hpp): what they say of a way may be wrong by no more than they claim.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "search/neighbour_list.hpp"

using namespace chute;
using search::CoarsePlaces;

namespace {

/// The square of the way between two places, from their words alone.
template <int D>
double coarse_way_squared(const CoarsePlaces<D>& coarse, const Vec<D>& a, const Vec<D>& b) {
  const auto word = [&](const Vec<D>& r, int w) {
    std::uint64_t bits = 0;
    for (int k = 2 * w; k < std::min(D, 2 * w + 2); ++k)
      bits |= CoarsePlaces<D>::fraction((r[k] - coarse.lower[k]) * coarse.per_length[k]) << (k % 2 ? 32 : 0);
    return bits;
  };
  double d2 = 0;
  for (int w = 0; w < CoarsePlaces<D>::words; ++w) {
    const std::uint64_t way = word(b, w) - word(a, w) + 0x8000000080000000U;
    for (int k = 2 * w; k < std::min(D, 2 * w + 2); ++k) {
      const double d = coarse.quantum[k] * CoarsePlaces<D>::quanta(k % 2 ? way >> 32 : way & 0xffffffffU);
      d2 += d * d;
    }
  }
  return d2;
}

template <int D>
void check(const Domain<D>& domain, double longest) {
  CoarsePlaces<D> coarse;
  coarse.set_up(domain, longest);
  std::mt19937_64 engine(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  double worst = 0;
  for (int k = 0; k < 100'000; ++k) {
    Vec<D> a, way;
    for (int c = 0; c < D; ++c) {
      a[c] = domain.periodic(c) ? domain.lower[c] + uniform(engine) * domain.length[c]
                                : (uniform(engine) - 0.5) * std::pow(10, 6 * uniform(engine));
      way[c] = 2 * uniform(engine) - 1;
    }
    way = (longest * uniform(engine) / norm(way)) * way;
    Vec<D> b = a + way;
    for (int c = 0; c < D; ++c)
      if (domain.periodic(c))
        b[c] -= domain.length[c] * std::floor((b[c] - domain.lower[c]) / domain.length[c]);
    const auto exact = domain.way(a, b);
    worst = std::max(worst, std::abs(coarse_way_squared(coarse, a, b) - dot(exact, exact)));
  }
  CHECK(worst < coarse.margin);
  CHECK(worst > coarse.margin / 100);  // the claim is not empty
}

}  // namespace

TEST_CASE("coarse places are as good as they claim") {
  Domain<2> flat;
  check<2>(flat, 1.2);
  flat.length[0] = 30;
  check<2>(flat, 1.2);
  flat.length[0] = 12'345.678;  // many coarse periods
  flat.lower[0] = -17;
  check<2>(flat, 1.2);
  flat.length = {{3, 3.5}};  // less than two ways
  check<2>(flat, 1.2);
  Domain<3> box;
  box.length[0] = 100, box.length[1] = 10;
  check<3>(box, 1.2);
}

TEST_CASE("a grain too far away for coarse places turns them off") {
  Grains<2> grains;
  grains.add({{0, 0}}, 0.5, 1, 0.1, true);
  grains.add({{1, 0}}, 0.5, 1, 0.1, true);
  search::NeighbourList<2> list({}, {0.1, 0.2});
  CHECK(list.near(grains).coarse != nullptr);
  grains.position[0][1] = 1e12;
  CHECK(list.near(grains).coarse == nullptr);
}
