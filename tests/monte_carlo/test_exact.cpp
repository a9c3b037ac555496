// Monte Carlo against what is known exactly: one grain, and grains on top of each other in a tube.
#include <catch2/catch.hpp>
#include <sstream>

#include "core/estimate.hpp"
#include "gas.hpp"

using namespace chute;
using namespace chute::test;

namespace {

/// How much wider than a grain the tube is: enough that sideways moves are not always rejected.
constexpr double play = 0.1;

/// A tube so narrow that grains cannot pass each other.
MonteCarloSetup<2> tube(double temperature) {
  auto setup = above_floor<2>();
  const double half = (1 + play) / 2;
  add_wall<2>(setup, {{-half, 0}}, {{1, 0}});
  add_wall<2>(setup, {{half, 0}}, {{-1, 0}});
  setup.temperature = temperature, setup.step = 0.15, setup.serial = true;
  return setup;
}

}  // namespace

TEST_CASE("the height of a grain over a floor is exponential, with mean T/mg") {
  const double T = 2;
  for (const bool serial : {true, false}) {
    auto setup = above_floor<2>();
    setup.domain.length[0] = 4;
    setup.temperature = T, setup.step = 2, setup.serial = serial;
    Grains<2> grains;
    add_grain<2>(grains, {{0, 1}});
    MonteCarloEngine<2> engine(grains, setup);
    std::vector<double> heights, squares;
    for (std::int64_t block = 1; block <= 400; ++block) {
      double height = 0, square = 0;
      constexpr int each = 500;
      for (int k = 0; k < each; ++k) {
        engine.advance_to(1000 + (block - 1) * each + k);
        const double z = engine.state().position[1][0] - 0.5;
        height += z / each, square += z * z / each;
      }
      heights.push_back(height), squares.push_back(square);
    }
    const auto mean = estimate_in_time(heights), square = estimate_in_time(squares);
    CAPTURE(serial, mean.mean, *mean.error, square.mean, *square.error);
    CHECK(mean.mean == Approx(T).margin(4 * *mean.error));
    CHECK(square.mean == Approx(2 * T * T).margin(4 * *square.error));
    CHECK(*mean.error < 0.03 * T);
  }
}

// The gaps of hard rods under gravity are independent and exponential: the gap below grain k carries it and all above it.
TEST_CASE("grains in a tube one diameter wide are a Tonks gas under gravity") {
  constexpr int N = 6;
  const double T = 1;
  Grains<2> grains;
  for (int k = 0; k < N; ++k) add_grain<2>(grains, {{0, 0.6 + 1.1 * k}});
  MonteCarloEngine<2> engine(grains, tube(T));
  std::array<std::vector<double>, N> blocks;
  for (int block = 0; block < 200; ++block) {
    std::array<double, N> sum{};
    constexpr int each = 500;
    for (int k = 0; k < each; ++k) {
      engine.advance_to(2000 + block * 5 * each + 5 * k);
      for (std::size_t i = 0; i < N; ++i) sum[i] += engine.state().position[1][i] / each;
    }
    for (std::size_t i = 0; i < N; ++i) blocks[i].push_back(sum[i]);
  }
  // Neighbours stand beside each other by Δ, of which each has an even share of `play`, and are closer by Δ²/2 in the mean.
  constexpr double closer = play * play / 12;
  double exact = 0.5;
  for (int k = 1; k <= N; ++k) {
    exact += T / (N - k + 1);
    const auto mean = estimate_in_time(blocks[static_cast<std::size_t>(k - 1)]);
    CAPTURE(k, exact, mean.mean, *mean.error);
    CHECK(mean.mean == Approx(exact + (k - 1) * (1 - closer)).margin(4 * *mean.error));
    CHECK(*mean.error < 0.05 * exact);
  }
}

TEST_CASE("without a temperature no move goes up, and no energy is gained") {
  auto setup = above_floor<2>();
  setup.domain.length[0] = 10;
  setup.step = 0.2;
  for (const bool serial : {true, false}) {
    setup.serial = serial;
    Grains<2> grains;
    for (int i = 0; i < 100; ++i)
      add_grain<2>(grains, {{0.5 + i % 9 * 1.1, 1 + 1.1 * (i / 9)}}, 0.5 - 0.001 * (i % 7));
    MonteCarloEngine<2> engine(grains, setup);
    const double start = engine.potential();
    bool rose = false;
    auto height = engine.state().position[1];
    for (int sweep = 1; sweep <= 300; ++sweep) {
      engine.advance_to(sweep);
      for (std::size_t i = 0; i < 100; ++i) rose = rose || engine.state().position[1][i] > height[i];
      height = engine.state().position[1];
    }
    CHECK(!rose);
    CHECK(engine.potential() < 0.95 * start);
    CHECK(engine.acceptance() > 0);
  }
}

TEST_CASE("a run that is saved and goes on comes to the same bytes, at any number of threads") {
  auto setup = above_floor<3>();
  setup.domain.length[0] = setup.domain.length[1] = 12;
  setup.temperature = 2;
  setup.equilibrate = 20;
  Grains<3> grains;
  for (int i = 0; i < 1000; ++i)
    add_grain<3>(grains, {{0.6 + i % 10 * 1.2, 0.6 + i / 10 % 10 * 1.2, 0.6 + i / 100 * 1.2}});
  grains.radius[555] = 0.55;
  MonteCarloEngine<3> whole(grains, setup), first(grains, setup, 2), second(grains, setup, 3);
  whole.advance_to(150);
  first.advance_to(70);
  std::stringstream file;
  first.save(file);
  second.restore(file);
  second.advance_to(150);
  CHECK(second.state().position == whole.state().position);
  CHECK(second.state().wraps == whole.state().wraps);
  CHECK(second.trial_length() == whole.trial_length());
}

TEST_CASE("grains that overlap at the start are refused") {
  Grains<2> grains;
  add_grain<2>(grains, {{0, 0.5}});
  add_grain<2>(grains, {{0.9, 0.5}});
  CHECK_THROWS_WITH((MonteCarloEngine<2>(grains, above_floor<2>())),
                    Catch::Contains("grain 0 overlaps grain 1 by 0.2"));
}

// A move longer than a period was brought back by one period only, and the grain then lay where no other found it.
TEST_CASE("trial moves that could go round the box are refused") {
  auto setup = above_floor<2>();
  setup.domain.length[0] = 4;
  setup.step = 2.1;
  Grains<2> grains;
  add_grain<2>(grains, {{0, 1}});
  CHECK_THROWS_WITH((MonteCarloEngine<2>(grains, setup)),
                    Catch::Contains("engine.step") && Catch::Contains("period"));
}
