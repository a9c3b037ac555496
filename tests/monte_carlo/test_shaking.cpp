// Shaking: what is lifted comes down, and a large grain among small ones rises (Rosato et al. 1987).
#include <catch2/catch.hpp>

#include "gas.hpp"

using namespace chute;
using namespace chute::test;

namespace {

/// Small discs in a box, one large among them at the bottom.
MonteCarloEngine<2> box_with_intruder(double ratio, std::uint64_t seed) {
  auto setup = above_floor<2>();
  setup.domain.length[0] = 12;
  setup.step = 0.2, setup.seed = seed;
  setup.shaking = monte_carlo::Shaking{0.8, 0, 3000, 1e-3};
  Grains<2> grains;
  grains.add({{6, ratio / 2}}, ratio / 2, ratio * ratio * ratio, 1, true);
  for (int i = 0; grains.moving < 150; ++i) {
    const Vec<2> place{{0.55 + i % 11 * 1.09, 0.5 + 1.05 * (i / 11)}};
    if (norm(place - grains.place(0)) > ratio / 2 + 0.5) add_grain<2>(grains, place);
  }
  return {grains, setup};
}

}  // namespace

TEST_CASE("a shaken packing comes to rest as dense as before") {
  auto engine = box_with_intruder(1, 1);
  const auto mean = [&] {
    double sum = 0;
    for (std::size_t i = 0; i < 150; ++i) sum += engine.state().position[1][i] / 150;
    return sum;
  };
  engine.advance_to(3);
  const double early = mean();
  engine.advance_to(10);
  CHECK(mean() == Approx(early).epsilon(0.1));
  CHECK(150 * M_PI / 4 / 12 / (2 * mean()) > 0.65);  // packing fraction of what is twice as high as its mean
}

TEST_CASE("a large disc rises among small ones when they are shaken") {
  auto engine = box_with_intruder(3, 2);
  engine.advance_to(2);
  const double early = engine.state().position[1][0];
  engine.advance_to(60);
  CHECK(engine.state().position[1][0] > early + 1.5);
}
