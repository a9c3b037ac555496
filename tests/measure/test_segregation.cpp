// How far materials have parted.
#include <catch2/catch.hpp>
#include <cmath>

#include "measure/segregation.hpp"

namespace segregation_tests {
using namespace chute;

namespace {

/// Grains one above the other, of these materials and radii.
Grains<2> column(const std::vector<int>& materials, const std::vector<double>& radii) {
  Grains<2> g;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    g.add({{0, 1.0 + static_cast<double>(i)}}, radii[i], 1, 1, true);
    g.material.back() = materials[i];
  }
  g.add({{0, 0}}, 0.5, 1, 1, false);  // the bed counts nothing
  return g;
}
std::vector<double> indices(const Grains<2>& grains, std::size_t materials) {
  const std::array<Array, 2> force;
  return measure::segregation_indices(view_of<2>(grains, force, {}, 0), 1, materials);
}

}  // namespace

TEST_CASE("a material that lies above all others has the index 1, whatever the sizes; below -1") {
  const auto parted = indices(column({0, 0, 0, 1, 1}, {0.5, 0.4, 0.6, 1.0, 0.8}), 3);
  CHECK(parted[0] == Approx(-1));
  CHECK(parted[1] == Approx(1));
  CHECK(std::isnan(parted[2]));  // no grain is of it
  const auto three = indices(column({2, 1, 0}, {0.5, 0.5, 0.5}), 3);
  CHECK(three[0] == Approx(1));
  CHECK(three[1] == Approx(0).margin(1e-12));
  CHECK(three[2] == Approx(-1));
}

TEST_CASE(
    "materials that lie the same way up and down are not parted; one of alternating grains by one grain's share") {
  CHECK(indices(column({0, 1, 1, 0}, {0.5, 0.7, 0.7, 0.5}), 2)[0] == Approx(0).margin(1e-12));
  // u = 1/8, 3/8, 5/8, 7/8 of four equal ones: 2 ((3/8 + 7/8) − (1/8 + 5/8))/2
  const auto turns = indices(column({0, 1, 0, 1}, {0.5, 0.5, 0.5, 0.5}), 2);
  CHECK(turns[1] == Approx(0.5));
  CHECK(turns[0] == Approx(-0.5));
  CHECK(std::isnan(indices(column({0, 0}, {0.5, 0.5}), 1)[0]));  // there are no others
}

}  // namespace segregation_tests
