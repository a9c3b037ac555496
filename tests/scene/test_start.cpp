#include <catch2/catch.hpp>

#include "example.hpp"
#include "scene/world.hpp"

using namespace chute;
using namespace chute::test;

namespace start_tests {

namespace {
World<2> start(const std::vector<std::string>& settings = {}) {
  return scene::make_world<2>(scene::parse_scene(example, "scene.toml", settings));
}
}  // namespace

TEST_CASE("the bed is a row of touching grains at height 0, one period long") {
  const auto made = start();
  const auto& g = made.grains;
  CHECK(g.moving == 300);
  REQUIRE(g.size() == 330);
  CHECK(made.domain.length[0] == 30);
  CHECK_FALSE(made.domain.periodic(1));
  for (std::size_t i = 300; i < 330; ++i) {
    CHECK(g.position[0][i] == Approx(static_cast<double>(i - 300) + 0.5));
    CHECK(g.position[1][i] == 0);
    CHECK(g.radius[i] == 0.5);
    CHECK(g.inverse_mass[i] == 0);
  }
}

TEST_CASE("gaps of the bed") {
  const auto made = start({"bed.gap=0.1"});
  CHECK(made.domain.length[0] == Approx(33));  // surfaces are 2 ε r apart
  CHECK(made.grains.position[0][301] - made.grains.position[0][300] == Approx(1.1));
  const auto loose = start({"bed.kind=disordered-row", "bed.gap_max=0.2"});
  double smallest = 9, largest = 0;
  for (std::size_t i = 301; i < 330; ++i) {
    const double gap = loose.grains.position[0][i] - loose.grains.position[0][i - 1] - 1;
    smallest = std::min(smallest, gap), largest = std::max(largest, gap);
  }
  CHECK(smallest >= 0);
  CHECK(largest <= 0.2);
  CHECK(largest - smallest > 0.1);  // 29 draws from [0, 0.2]
  const double last =
      loose.domain.length[0] - loose.grains.position[0][329] + loose.grains.position[0][300] - 1;
  CHECK(last >= -1e-12);  // the gap across the period, too
  CHECK(last <= 0.2);
}

TEST_CASE("grains start free of each other and of the bed, with m = d³ and I = 2/5 m R²") {
  const auto made = start();
  const auto& g = made.grains;
  for (std::size_t i = 0; i < g.moving; ++i) {
    const double R = g.radius[i];
    CHECK(g.mass[i] == Approx(8 * R * R * R));
    CHECK(g.inertia[i] == Approx(0.4 * g.mass[i] * R * R));
    for (std::size_t j = i + 1; j < g.size(); ++j)
      CHECK(norm(made.domain.way(g.place(i), g.place(j))) > R + g.radius[j]);
  }
}

TEST_CASE("sizes and velocities have the asked mean and spread") {
  const auto made = start({"grains.count=2000", "bed.count=100"});
  const auto& g = made.grains;
  double d = 0, d2 = 0, v = 0, v2 = 0, u = 0;
  for (std::size_t i = 0; i < g.moving; ++i) {
    const double di = 2 * g.radius[i], vi = g.velocity[0][i];
    CHECK(std::abs(di - 1) <= 0.15);  // cut off at three standard deviations
    d += di, d2 += di * di, v += vi, v2 += vi * vi, u += g.velocity[1][i];
  }
  const double n = 2000,
               five_errors = 5 / std::sqrt(n);  // five standard errors of a mean, in standard deviations
  CHECK(d / n == Approx(1).margin(0.05 * five_errors));
  CHECK(std::sqrt(d2 / n - d / n * d / n) == Approx(0.05).epsilon(0.1));
  CHECK(v / n == Approx(2).margin(2 * five_errors));
  CHECK(std::sqrt(v2 / n - v / n * v / n) == Approx(2).epsilon(0.1));
  CHECK(u / n == Approx(0).margin(2 * five_errors));
}

TEST_CASE("the seed fixes everything; bed, sizes and velocities have streams of their own") {
  const std::vector<std::string> loose{"bed.kind=disordered-row", "bed.gap_max=0.2"};
  const auto a = start(loose), b = start(loose);
  CHECK(a.grains.position == b.grains.position);
  CHECK(a.grains.velocity == b.grains.velocity);
  CHECK(a.grains.radius == b.grains.radius);
  auto other = loose;
  other.push_back("seed=2");
  CHECK(start(other).grains.radius != a.grains.radius);
  CHECK(start(other).domain.length != a.domain.length);
  other.back() = "grains.diameter.std=0.06";  // other sizes, the same bed and velocities
  CHECK(start(other).domain.length == a.domain.length);
  CHECK(start(other).grains.velocity == a.grains.velocity);
}

TEST_CASE("a single grain starts above the first gap, without spin") {
  const auto scene = scene::read_scene(CHUTE_SOURCE_DIR "/scenes/ball-2d.toml", {"grains.start.spread=0"});
  const auto made = scene::make_world<2>(scene);
  CHECK(made.grains.moving == 1);
  CHECK(made.grains.position[0][0] == Approx(0.01));
  CHECK(made.grains.radius[0] == Approx(2.25 * 0.005));
  CHECK(made.grains.velocity[0][0] == 0.4);
  CHECK(made.grains.velocity[1][0] == 0.02);
  CHECK(made.grains.spin[0][0] == 0);
}

}  // namespace start_tests
