#include <catch2/catch.hpp>

#include "core/not_a_number.hpp"
#include "packing.hpp"
#include "search/neighbour_list.hpp"

using namespace chute;
using namespace chute::test;

namespace {

/// Grains walk at random; after each step every touching pair must be in the list.
template <int D>
void check_walk(search::Method method, double stride) {
  Domain<D> domain;
  Vec<D> lower, length;
  for (int k = 0; k < D; ++k) {
    length[k] = 5 + k;
    if (k != 1) domain.length[k] = length[k];
  }
  auto grains = packing<D>(40, 10, lower, length, 11);
  search::NeighbourList<D> list(domain, {0.1, 0.4}, method);
  Random random(12, Purpose::start);
  std::int64_t builds = 0;
  for (int step = 0; step < 400; ++step) {
    const auto& near = list.near(grains).pairs;
    const auto pairs = listed(near);
    for (const auto& touching : by_images(grains, domain, 0))
      CHECK(std::binary_search(pairs.begin(), pairs.end(), touching));
    builds += list.near_builds();
    for (std::size_t i = 0; i < grains.moving; ++i)
      for (int k = 0; k < D; ++k) {
        double& x = grains.position[k][i];
        x += stride * (2 * random.uniform() - 1);
        if (domain.periodic(k)) x -= domain.length[k] * std::floor(x / domain.length[k]);
      }
  }
  CHECK(list.near_builds() > list.far_builds());
  CHECK(list.far_builds() > 2);
  CHECK(list.near_builds() < 400);
}

}  // namespace

TEST_CASE("no contact is missed while grains walk") {
  const auto method = GENERATE(search::Method::cells, search::Method::all_pairs);
  check_walk<2>(method, 0.01);
  check_walk<3>(method, 0.01);
}

TEST_CASE("two grains that meet from outside every list are found in time") {
  const double near = 0.1, far = 0.4;
  for (double gap = far + 1e-4; gap < far + 0.2; gap += 0.003)  // at the start; each goes half of it
    for (const double stride : {0.001, 0.01, 0.03}) {
      Grains<2> grains;
      grains.add({{0, 0}}, 0.5, 1, 1, true);
      grains.add({{1 + gap, 0}}, 0.5, 1, 1, true);
      search::NeighbourList<2> list({}, {near, far});
      list.near(grains);
      while (grains.position[0][1] - grains.position[0][0] > 0.9) {
        grains.position[0][0] += stride;
        grains.position[0][1] -= stride;
        const bool touch = grains.position[0][1] - grains.position[0][0] < 1;
        const auto pairs = list.near(grains).pairs.size();
        if (touch && pairs != 1) FAIL("missed: gap " << gap << ", stride " << stride);
      }
      CHECK(list.near(grains).pairs.size() == 1);
    }
}

TEST_CASE("lists are made anew only when something has moved far enough") {
  const auto isa = GENERATE(Isa::baseline, best_isa());
  Domain<2> domain;
  domain.length[0] = 6;
  auto grains = packing<2>(20, 5, {{0, 0}}, {{6, 4}}, 3);
  grains.position[0][7] = 5.99;
  search::NeighbourList<2> list(domain, {0.2, 1.0}, search::Method::cells, isa);
  const auto builds = [&] {
    list.near(grains);
    return std::pair{list.near_builds(), list.far_builds()};
  };
  using Builds = std::pair<std::int64_t, std::int64_t>;
  CHECK(builds() == Builds{1, 1});
  CHECK(builds() == Builds{1, 1});  // nothing moved
  const double x0 = grains.position[1][5];
  grains.position[1][5] = x0 + 0.0999;  // less than half the near skin
  CHECK(builds() == Builds{1, 1});
  grains.position[0][20] += 3;  // fixed grains do not move; nobody looks at them
  CHECK(builds() == Builds{1, 1});
  grains.position[0][20] -= 3;
  grains.position[1][5] = x0 + 0.1001;
  CHECK(builds() == Builds{2, 1});
  grains.position[1][5] = x0 + 0.1999;  // counts from the last build
  CHECK(builds() == Builds{2, 1});
  grains.position[1][5] = x0 + 0.3999;  // far list: half of far minus near
  CHECK(builds() == Builds{3, 1});
  grains.position[1][6] += 0.4001;  // another one, farther than that
  CHECK(builds() == Builds{4, 2});
  grains.position[0][7] = 0.01;  // once around the period is a short way
  CHECK(builds() == Builds{4, 2});
  grains.position[0][7] = 0.2;
  CHECK(builds() == Builds{5, 2});
}

TEST_CASE("a place that is not a number is reported with its grain") {
  auto grains = packing<2>(20, 5, {{0, 0}}, {{6, 4}}, 3);
  const auto value =
      GENERATE(std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity());
  const auto isa = GENERATE(Isa::baseline, best_isa());
  search::NeighbourList<2> list({}, {0.2, 1.0}, search::Method::cells, isa);
  list.near(grains);
  grains.position[1][13] = value;
  std::size_t found = 0;
  try {
    list.near(grains);
  } catch (const NotANumber& error) {
    found = error.grain;
  }
  CHECK(found == 13);
}
