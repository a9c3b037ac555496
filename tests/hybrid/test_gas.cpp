// Gases in periodic boxes: what is conserved, and how they cool.
#include <catch2/catch.hpp>
#include <numbers>

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

// T = T_0/(1 + t/τ)², 1/τ = (1 − e²) ω_0/4, ω_0 = 2 n d g_d √(πT_0/m), g_d = (1 − 7φ/16)/(1 − φ)². The lattice is first
// forgotten with elastic collisions, which do not change T_0.
TEST_CASE("a smooth gas cools by Haff's law") {
  constexpr double e_n = 0.95, spacing = 2;
  Gas<2> gas(40, spacing, 0);
  auto setup = setup_of<2>(1, {0, -1}, 0.01);
  setup.domain = gas.domain;
  HybridEngine<2> elastic(gas.grains, setup);
  elastic.advance_to(500);
  CHECK(elastic.energy().stored() == Approx(elastic.energy().start).epsilon(1e-12));
  setup.contact.restitution = laws::ConstantRestitution{e_n};
  HybridEngine<2> engine(elastic.state(), setup);
  const double N = 1600, T_0 = engine.energy().start / N, phi = std::numbers::pi / 4 / (spacing * spacing);
  const double g_d = (1 - 7 * phi / 16) / ((1 - phi) * (1 - phi));
  const double omega = 2 / (spacing * spacing) * g_d * std::sqrt(std::numbers::pi * T_0);
  const double tau = 4 / ((1 - e_n * e_n) * omega);
  engine.advance_to(std::llround(tau / setup.time_step));
  const double T = engine.energy().stored() / N;
  const double measured = engine.time() / (std::sqrt(T_0 / T) - 1);
  CAPTURE(tau, measured, engine.tells()[0].second);
  CHECK(measured == Approx(tau).epsilon(0.01));
}
