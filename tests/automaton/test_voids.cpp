// Voids that rise: how far they spread, what leaves, and what stays.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <sstream>

#include "engines/automaton/voids.hpp"

using namespace chute;
using namespace chute::automaton;

namespace {

VoidsSetup box(int columns, int rows) {
  VoidsSetup setup;
  setup.lattice = {columns, rows, true, false};
  setup.orifice_x = columns / 2.0;
  return setup;
}
double told(const Voids& voids, std::string_view name) {
  for (const auto& [key, value] : voids.tells())
    if (key == name) return value;
  return NAN;
}

}  // namespace

// Each row a void goes half a site to the left or right: binomial; and in the limit the Gaussian of Litwiniszyn's law.
TEST_CASE("grains fall over the opening with the binomial profile") {
  auto setup = box(121, 60);
  setup.refill = true;
  Voids voids(setup);
  constexpr int updates = 40000, h = 40;
  for (int t = 0; t < updates; ++t) voids.update(t);
  CHECK(told(voids, "mass") == 121 * 60);
  CHECK(told(voids, "left") == updates);
  const int start = 60;  // the opening's column, in row 0 at 60.25
  double chance = std::pow(0.5, h), variance = 0, worst = 0;
  const double B = 1 / (4 * std::sqrt(3.0)), height = h * row_height;
  for (int right = 0; right <= h; ++right) {
    // After h rows, `right` steps to the right: x = start + right − h/2.
    const double expected = updates * chance;
    const double got = static_cast<double>(voids.fallen(start + right - h / 2, h));
    if (expected > 20) CHECK(std::abs(got - expected) < 5 * std::sqrt(expected));
    const double x = right - h / 2.0;
    variance += x * x * got / updates;
    worst = std::max(
        worst, std::abs(chance - std::exp(-x * x / (4 * B * height)) / std::sqrt(4 * M_PI * B * height)));
    chance *= static_cast<double>(h - right) / (right + 1);
  }
  CHECK(variance == Approx(2 * B * height).epsilon(0.05));
  CHECK(worst < 0.002);  // the Gaussian, in profiles whose maximum is 0.125
}

TEST_CASE("a hopper runs out grain by grain, and what is out of the voids' reach stays") {
  auto setup = box(41, 30);
  setup.lattice.periodic_x = false;
  setup.orifice = 3;
  Voids voids(setup);
  const double mass = told(voids, "mass");
  for (int t = 0; t < 5000; ++t) voids.update(t);
  CHECK(told(voids, "mass") == mass - told(voids, "left"));
  CHECK(told(voids, "left") > 300);
  CHECK(told(voids, "mass") > 100);
  CHECK(voids.occupied(0, 0));  // dead corners, below the angle of repose of 60°
  CHECK(voids.occupied(40, 0));
  // Nothing hangs: a grain has one below it or a wall.
  for (int y = 1; y < 30; ++y)
    for (int x = 1; x < 40; ++x)
      if (voids.occupied(x, y)) {
        const int odd = y & 1;
        CHECK((voids.occupied(x - 1 + odd, y - 1) || voids.occupied(x + odd, y - 1)));
      }
}

// Of the two above a void one is small in half of the cases where bias decides, and is then chosen 4 times in 5: right over
// the opening small grains gather, and more of them leave at first. (In the long run what leaves is what comes.)
TEST_CASE("small grains fall more readily and leave first") {
  const auto share = [](double bias) {
    double small = 0, all = 0;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
      auto setup = box(81, 60);
      setup.small = 0.5, setup.bias = bias, setup.seed = seed;
      Voids voids(setup);
      const auto count = [&] {
        Grains<2> grains;
        voids.show(grains);
        return static_cast<double>(std::count(grains.radius.begin(), grains.radius.end(), 0.35));
      };
      const double before = count();
      for (int t = 0; t < 40; ++t) voids.update(t);
      small += before - count(), all += 40;
    }
    return small / all;
  };
  CHECK(share(1) == Approx(0.5).margin(0.04));
  CHECK(share(4) > 0.55);
}

TEST_CASE("voids go on from a checkpoint to the same grains") {
  auto setup = box(60, 40);
  setup.small = 0.3, setup.bias = 2, setup.refill = true;
  Voids a(setup), b(setup);
  for (int t = 0; t < 500; ++t) a.update(t);
  std::stringstream state;
  {
    StateOutput out(state);
    a.save(out);
  }
  StateInput in(state);
  b.load(in);
  for (int t = 500; t < 900; ++t) a.update(t), b.update(t);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 60; ++x) REQUIRE(a.fallen(x, y) == b.fallen(x, y));
}
