#include <catch2/catch.hpp>

#include "packing.hpp"

using namespace chute;
using namespace chute::test;

namespace {

/// The grid, its slow twin and the truth; the same grid is used again and again, as in a run.
template <int D>
std::size_t check(search::CellGrid<D>& grid, const Grains<D>& grains, const Domain<D>& domain, double skin) {
  search::PairNames cells, twin;
  grid.find(grains, domain, skin, cells);
  search::all_pairs(grains, domain, skin, twin);
  const auto truth = by_images(grains, domain, skin);
  CHECK(listed(twin, grains) == truth);
  CHECK(listed(cells, grains) == truth);
  return truth.size();
}

template <int D>
void check_all(double reach) {
  search::CellGrid<D> grid;
  const double skin = reach - 1;  // the largest grains have a radius of 1/2
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    for (int periodic = 0; periodic < 1 << D; ++periodic) {
      for (const double cells : {1.2, 1.999, 2.0, 2.5, 3.0, 3.4, 6.1}) {  // cells along each period
        Domain<D> domain;
        Vec<D> lower, length;
        for (int k = 0; k < D; ++k) {
          lower[k] = k - 1.7;
          length[k] = cells * reach * (1 + 0.1 * k);
          domain.lower[k] = lower[k];
          if (periodic & 1 << k) domain.length[k] = length[k];
        }
        INFO("seed " << seed << ", periodic " << periodic << ", cells " << cells);
        CHECK(check<D>(grid, packing<D>(30, 8, lower, length, seed), domain, skin) > 0);
      }
    }
  }
}

}  // namespace

TEST_CASE("the cell grid finds what all pairs find, 2D") { check_all<2>(GENERATE(1.0, 1.3)); }
TEST_CASE("the cell grid finds what all pairs find, 3D") { check_all<3>(GENERATE(1.0, 1.3)); }

TEST_CASE("a grain far away costs neither pairs nor memory") {
  search::CellGrid<2> flat;
  search::CellGrid<3> solid;
  auto g2 = packing<2>(60, 10, {{0, 0}}, {{6, 6}}, 7);
  auto g3 = packing<3>(80, 10, {{0, 0, 0}}, {{4, 4, 4}}, 7);
  for (const double far : {1e3, -1e6, 1e12, 1e300}) {
    g2.position[1][3] = far;
    g3.position[2][3] = far;
    CHECK(check<2>(flat, g2, {}, 0.3) > 10);
    CHECK(check<3>(solid, g3, {}, 0.3) > 10);
    Domain<2> line;
    line.length[0] = 6;
    CHECK(check<2>(flat, g2, line, 0.3) > 10);
  }
}

TEST_CASE("pairs touch across a corner of two periods") {
  Domain<2> domain{{{-1, 2}}, {{5, 4}}};
  Grains<2> grains;
  grains.add({{-0.9, 2.1}}, 0.5, 1, 1, true);
  grains.add({{3.9, 5.9}}, 0.5, 1, 1, true);
  search::CellGrid<2> grid;
  CHECK(check<2>(grid, grains, domain, 0) == 1);
}

TEST_CASE("bed grains are not paired with each other, and a grain is not paired with itself") {
  search::CellGrid<2> grid;
  search::PairNames pairs;
  Grains<2> grains;
  grains.add({{0, 0.4}}, 0.5, 1, 1, true);
  for (double x : {0.0, 0.3, 0.6}) grains.add({{x, 0}}, 0.5, 1, 1, false);
  grid.find(grains, {}, 0, pairs);
  CHECK(listed(pairs, grains) == std::vector<Pair>{{0, 1, 1.0}, {0, 2, 1.0}, {0, 3, 1.0}});
}

TEST_CASE("one grain alone has no pairs") {
  search::CellGrid<3> grid;
  search::PairNames pairs;
  Grains<3> grains;
  grains.add({{0, 0, 0}}, 0.5, 1, 1, true);
  grid.find(grains, {}, 1, pairs);
  CHECK(pairs.size() == 0);
}
