// Gases in periodic boxes: what is conserved, and how they cool.
#include <catch2/catch.hpp>
#include <numbers>
#include <vector>

#include "engines/event/event_engine.hpp"
#include "few_grains.hpp"

using namespace chute;
using namespace chute::test;
using hybrid::HybridEngine;

namespace {

template <int D>
void keeps_momentum() {
  Gas<D> gas(D == 2 ? 12 : 5, 1.3);
  auto setup = setup_of<D>(0.8, {0.4, 0.3}, 0.005);
  setup.domain = gas.domain;
  HybridEngine<D> engine(gas.grains, setup);
  const Vec<D> before = momentum(gas.grains);
  engine.advance_to(1000);
  const Vec<D> after = momentum(engine.state());
  for (int k = 0; k < D; ++k)
    CHECK(after[k] == Approx(before[k]).margin(1e-12 * static_cast<double>(gas.grains.moving)));
  const auto e = engine.energy();
  CHECK(engine.tells()[0].second > 300);
  CHECK(e.normal_loss > 0);
  CHECK(e.shear_loss > 0);
  CHECK(e.normal_loss + e.shear_loss == Approx(e.start - e.stored()).epsilon(1e-12));
}

}  // namespace

TEST_CASE("a gas keeps its momentum, and what it loses is what collisions took") {
  keeps_momentum<2>();
  keeps_momentum<3>();
}

namespace {

struct Mean {
  double value, error;
};

Mean mean_of(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  double mean = 0, square = 0;
  for (const double v : values) mean += v / n;
  for (const double v : values) square += (v - mean) * (v - mean) / (n - 1);
  return {mean, std::sqrt(square / n)};
}

/// τ of a cooling gas of 1600 smooth discs, over Haff's: T = T_0/(1 + t/τ)², 1/τ = (1 − e²) ω_0/4,
/// ω_0 = 2 n d g_d √(πT_0/m), g_d = (1 − 7φ/16)/(1 − φ)². From its start to `part` of Haff's τ. The lattice is first
/// forgotten with elastic collisions, which do not change T_0.
template <class Engine, class Setup>
double cooling_time(Setup setup, std::uint64_t seed, double part) {
  constexpr double e_n = 0.95, spacing = 2, N = 1600;
  const double phi = std::numbers::pi / 4 / (spacing * spacing);
  const double g_d = (1 - 7 * phi / 16) / ((1 - phi) * (1 - phi));
  const Gas<2> gas(40, spacing, 0, seed);
  constexpr double tick = 0.01;
  setup.contact = {laws::ConstantRestitution{1}, laws::Walton{0, -1}};
  setup.domain = gas.domain;
  Engine elastic(gas.grains, setup);
  elastic.advance_to(500);
  CHECK(elastic.energy().stored() == Approx(elastic.energy().start).epsilon(1e-12));
  setup.contact.restitution = laws::ConstantRestitution{e_n};
  Engine engine(elastic.state(), setup);
  const double T_0 = engine.energy().start / N;
  const double omega = 2 / (spacing * spacing) * g_d * std::sqrt(std::numbers::pi * T_0);
  const double tau = 4 / ((1 - e_n * e_n) * omega);
  engine.advance_to(std::llround(part * tau / tick));
  return engine.time() / (std::sqrt(T_0 / (engine.energy().stored() / N)) - 1) / tau;
}

double hybrid_cooling(std::uint64_t seed, double part) {
  return cooling_time<HybridEngine<2>>(setup_of<2>(1, {0, -1}, 0.01), seed, part);
}

}  // namespace

// Haff's law is of a homogeneous gas. At this density velocities are correlated after one τ already, and both methods
// that know the grains' places cool 2.5 per cent more slowly by then (next test): the law is tested at the start.
TEST_CASE("a smooth gas cools by Haff's law while it is homogeneous") {
  std::vector<double> ratio;
  for (std::uint64_t seed = 1; seed <= 48; ++seed) ratio.push_back(hybrid_cooling(seed, 0.25));
  const Mean mean = mean_of(ratio);
  CAPTURE(mean.value, mean.error);
  CHECK(mean.error < 0.004);
  CHECK(std::abs(mean.value - 1) < 0.01);
}

TEST_CASE("a smooth gas cools as in the event engine") {
  std::vector<double> difference;
  event::EventSetup<2> setup;
  setup.tick = 0.01;
  for (std::uint64_t seed = 1; seed <= 16; ++seed)
    difference.push_back(hybrid_cooling(seed, 1) - cooling_time<event::EventEngine<2>>(setup, seed, 1));
  const Mean mean = mean_of(difference);
  CAPTURE(mean.value, mean.error);
  CHECK(mean.error < 0.005);
  CHECK(std::abs(mean.value) < 0.01);
}
