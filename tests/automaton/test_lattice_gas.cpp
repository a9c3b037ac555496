// The lattice gas: what is kept, what is stationary, how it cools, and that threads and restarts change nothing.
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <sstream>

#include "engines/automaton/lattice_gas.hpp"

using namespace chute;
using namespace chute::automaton;

namespace {

double told(const LatticeGas& gas, std::string_view name) {
  for (const auto& [key, value] : gas.tells())
    if (key == name) return value;
  return NAN;
}

Wall<2> segment(Vec<2> from, Vec<2> to) {
  Wall<2> wall;
  const Vec<2> half = 0.5 * (to - from);
  wall.point = from + half;
  wall.normal = (1 / norm(half)) * Vec<2>{{-half[1], half[0]}};
  wall.outline = Segment{half};
  return wall;
}

LatticeGasSetup gas_of(int columns, int rows, double density, bool periodic_y) {
  LatticeGasSetup setup;
  setup.lattice = {columns, rows, true, periodic_y};
  setup.density = density;
  return setup;
}

std::string bytes_of(LatticeGas& gas) {
  std::ostringstream out;
  StateOutput archive(out);
  gas.save(archive);
  return out.str();
}

}  // namespace

TEST_CASE("without dissipation and gravity a periodic gas keeps mass, momentum and movers") {
  LatticeGas gas(gas_of(100, 60, 2.3, true));
  const double mass = told(gas, "mass"), px = told(gas, "momentum_x"), py = told(gas, "momentum_y");
  for (int t = 0; t < 300; ++t) gas.update(t);
  CHECK(mass > 10000);
  CHECK(told(gas, "mass") == mass);
  CHECK(told(gas, "moving") == mass);
  CHECK(told(gas, "momentum_x") == Approx(px).margin(1e-9));
  CHECK(told(gas, "momentum_y") == Approx(py).margin(1e-9));
}

TEST_CASE("mass is kept in a box with a funnel, with dissipation, gravity and both kinds of reflection") {
  auto setup = gas_of(81, 60, 1.5, false);
  setup.lattice.periodic_x = false;
  setup.rule = {0.4, 0.5, SiteRule::towards({{0, -1}})};
  setup.walls = {segment({{0, 30}}, {{36.3, 20}}), segment({{81, 30}}, {{44.1, 20}}),
                 segment({{40, 0}}, {{40, 9}})};
  LatticeGas gas(setup);
  const double mass = told(gas, "mass");
  for (int t = 0; t < 500; ++t) {
    gas.update(t);
    REQUIRE(told(gas, "mass") == mass);
  }
  CHECK(told(gas, "moving") < mass);  // some have come to rest
  CHECK(told(gas, "dissipated") > 0);
}

TEST_CASE("gravity brings a closed box's grains down, and nothing passes a wall right across it") {
  auto setup = gas_of(60, 80, 1, false);
  setup.lattice.periodic_x = false;
  setup.rule = {0.3, 0.3, SiteRule::towards({{0, -1}})};
  setup.walls = {segment({{-1, 30.1}}, {{61, 30.1}})};
  setup.fill_low = 31;
  LatticeGas gas(setup);
  for (int t = 0; t < 400; ++t) gas.update(t);
  double below = 0, above = 0, height = 0;
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 60; ++x) {
      const Site s = gas.at(x, y);
      const double n = std::popcount(unsigned{movers(s)}) + resting(s), h = Lattice::place(x, y)[1];
      (h < 30.1 ? below : above) += n;
      height += n * h;
    }
  CHECK(below == 0);
  CHECK(above == told(gas, "mass"));
  CHECK(height / above < 30.1 + 0.5 * (80 * row_height - 30.1) - 5);  // lower than an even filling
}

TEST_CASE("a mirror along a row keeps the momentum along it, turning back does not") {
  for (const double reversal : {0.0, 1.0}) {
    auto setup = gas_of(64, 32, 1, false);
    setup.reversal = reversal;
    setup.density = 0;
    LatticeGas gas(setup);
    for (int x = 0; x < 64; ++x)
      gas.set(x, 31, site_of(1u << 1, 0));  // all up to the right, at the upper edge
    gas.update(0);
    CHECK(told(gas, "momentum_x") == Approx(reversal == 0 ? 32 : -32));
    CHECK(told(gas, "momentum_y") == Approx(-64 * row_height));
  }
}

TEST_CASE("random movers are the equilibrium: directions stay even and sites independent") {
  constexpr double density = 1.8, f = density / 6;
  LatticeGas gas(gas_of(400, 400, density, true));
  const double mass = told(gas, "mass");
  for (int t = 0; t < 100; ++t) gas.update(t);
  std::array<double, 6> along{};
  std::array<double, 7> occupied{};
  for (int y = 0; y < 400; ++y)
    for (int x = 0; x < 400; ++x) {
      for (int k = 0; k < 6; ++k) along[k] += gas.at(x, y) >> k & 1;
      ++occupied[std::popcount(unsigned{gas.at(x, y)})];
    }
  constexpr double sites = 160000;
  for (const double n : along) CHECK(n / sites == Approx(f).margin(5 * std::sqrt(f / sites)));
  // Movers of a site: binomial, 6 of probability f.
  const double now = mass / sites / 6;
  double choose = 1;
  for (int n = 0; n <= 6; ++n) {
    const double expected = choose * std::pow(now, n) * std::pow(1 - now, 6 - n);
    CAPTURE(n);
    CHECK(occupied[n] / sites == Approx(expected).margin(5 * std::sqrt(expected / sites)));
    choose = choose * (6 - n) / (n + 1);
  }
}

// Cooling from random movers: bits that arrive at a site come from six different sites, so they are independent of each
// other and of the site's own resting grains. So the movers left after one and after two updates are sums over 64 × 3 states.
TEST_CASE("the first two updates of cooling are the exact sums") {
  constexpr double density = 2.4, p = 0.5;
  const SiteRule rule{p, 0, {}};
  double f = density / 6;
  std::array<double, 3> rest{1, 0, 0};
  auto setup = gas_of(1000, 1000, density, true);
  setup.rule = rule;
  LatticeGas gas(setup);
  const double mass = told(gas, "mass");
  f = mass / 6e6;
  for (int t = 0; t < 2; ++t) {
    double moving = 0;
    std::array<double, 3> next{};
    for (int s = 0; s < site_states; ++s) {
      const int n = std::popcount(static_cast<unsigned>(s & 63));
      const double here = std::pow(f, n) * std::pow(1 - f, 6 - n) * rest[static_cast<std::size_t>(s >> 6)];
      for (const auto& o : outcomes(static_cast<Site>(s), rule)) {
        moving += here * o.probability * std::popcount(unsigned{movers(o.site)});
        next[static_cast<std::size_t>(resting(o.site))] += here * o.probability;
      }
    }
    rest = next, f = moving / 6;
    gas.update(t);
    CAPTURE(t);
    CHECK(told(gas, "moving") / 1e6 == Approx(moving).margin(5 * std::sqrt(moving / 1e6)));
    CHECK(told(gas, "mass") == mass);
    // Energy: movers have ½.
    CHECK(told(gas, "dissipated") == Approx(0.5 * (mass - told(gas, "moving"))));
  }
  CHECK(f < density / 6 - 0.05);
}

TEST_CASE("threads and a restart change no byte") {
  auto setup = gas_of(150, 90, 1.2, false);
  setup.rule = {0.2, 0.3, SiteRule::towards({{1, 0.2}})};
  setup.walls = {segment({{20, 10}}, {{90, 40}})};
  LatticeGas one(setup);
  setup.threads = 3;
  LatticeGas three(setup), late(setup);
  for (int t = 0; t < 50; ++t) one.update(t), three.update(t);
  const auto half = bytes_of(one);
  CHECK(half == bytes_of(three));
  std::istringstream in(half);
  StateInput archive(in);
  late.load(archive);
  for (int t = 50; t < 90; ++t) one.update(t), late.update(t);
  CHECK(bytes_of(one) == bytes_of(late));
}
