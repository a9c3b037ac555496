// Gases in periodic boxes against kinetic theory: how often grains collide, how they cool, and what is kept.
#include <catch2/catch.hpp>
#include <sstream>

#include "gas.hpp"

using namespace chute;
using namespace chute::test;
using dsmc::Dense;
using dsmc::DsmcEngine;

namespace {

// The truth, written out again: ω = 2 n d χ √(πT/m) in 2D with Henderson's χ, 4 n d² χ √(πT/m) in 3D with Carnahan's and
// Starling's.
double rate_2d(double phi, double T, bool dense) {
  const double n = phi * 4 / std::numbers::pi, chi = dense ? (1 - 7 * phi / 16) / std::pow(1 - phi, 2) : 1;
  return 2 * n * chi * std::sqrt(std::numbers::pi * T);
}
double rate_3d(double phi, double T, bool dense) {
  const double n = phi * 6 / std::numbers::pi, chi = dense ? (1 - phi / 2) / std::pow(1 - phi, 3) : 1;
  return 4 * n * chi * std::sqrt(std::numbers::pi * T);
}

/// Measured over expected rate of an elastic gas. A grain takes part in 2/N of the collisions.
template <int D>
double rate_ratio(Dense dense, double phi, std::size_t count, std::int64_t steps, double cell = 3,
                  double weight = 1, double step = 0.2) {
  Gas<D> gas(count, phi / weight, 1.3);
  gas.setup.weight = weight;
  const double expected =
      D == 2 ? rate_2d(phi, 1.3, dense != Dense::none) : rate_3d(phi, 1.3, dense != Dense::none);
  gas.setup.dense = dense;
  gas.setup.cell = cell;
  gas.setup.time_step = step / expected;
  DsmcEngine<D> engine(gas.grains, gas.setup);
  engine.advance_to(20);  // until averages have a past
  const auto before = engine.collisions();
  engine.advance_to(20 + steps);
  CHECK(told(engine, "temperature") == Approx(1.3).epsilon(1e-9));
  return 2 * static_cast<double>(engine.collisions() - before) / static_cast<double>(count) /
         (static_cast<double>(steps) * gas.setup.time_step * expected);
}

}  // namespace

TEST_CASE("grains collide as often as kinetic theory says") {
  // 2e6 … 5e6 collisions: the statistical error is below 0.1 %.
  CHECK(rate_ratio<2>(Dense::none, 0.05, 40000, 250) == Approx(1).epsilon(0.003));
  CHECK(rate_ratio<3>(Dense::none, 0.05, 40000, 250) == Approx(1).epsilon(0.003));
  CHECK(rate_ratio<2>(Dense::rate, 0.2, 40000, 250) == Approx(1).epsilon(0.003));
  CHECK(rate_ratio<3>(Dense::rate, 0.2, 40000, 250) == Approx(1).epsilon(0.003));
  // With few grains in a cell a grain finds the partner again that it has just hit, which it leaves: fewer collisions. So
  // simulated grains stand for less than one real one here, and some 40 are in a cell.
  CHECK(rate_ratio<2>(Dense::esmc, 0.2, 40000, 100, 3, 0.05) == Approx(1).epsilon(0.01));
  CHECK(rate_ratio<3>(Dense::esmc, 0.2, 40000, 100, 3, 0.2) == Approx(1).epsilon(0.01));
}

TEST_CASE("the rate does not depend on cells and step") {
  const double usual = rate_ratio<2>(Dense::rate, 0.1, 20000, 400);
  CHECK(rate_ratio<2>(Dense::rate, 0.1, 20000, 400, 8) == Approx(usual).epsilon(0.006));
  CHECK(rate_ratio<2>(Dense::rate, 0.1, 20000, 400, 1.5) == Approx(usual).epsilon(0.006));
  CHECK(rate_ratio<2>(Dense::rate, 0.1, 20000, 800, 3, 1, 0.1) == Approx(usual).epsilon(0.004));
  CHECK(rate_ratio<2>(Dense::rate, 0.1, 20000, 200, 3, 1, 0.4) == Approx(usual).epsilon(0.004));
  CHECK(rate_ratio<2>(Dense::rate, 0.1, 20000, 400, 3, 0.25) == Approx(usual).epsilon(0.006));
}

namespace {

template <int D>
void keeps(Dense dense) {
  Gas<D> gas(3000, 0.1, 1, 4, 0.7);
  gas.setup.contact = {laws::ConstantRestitution{0.8}, laws::Walton{0.4, 0.3}};
  gas.setup.dense = dense;
  gas.setup.time_step = 0.1;
  DsmcEngine<D> engine(gas.grains, gas.setup);
  engine.advance_to(200);
  const Vec<D> p = momentum(engine.state());
  for (int k = 0; k < D; ++k) CHECK(p[k] == Approx(0).margin(1e-12 * 3000));
  const auto e = engine.energy();
  CHECK(engine.collisions() > 3000);
  CHECK(e.normal_loss > 0);
  CHECK(e.shear_loss > 0);
  CHECK(e.normal_loss + e.shear_loss == Approx(e.start - e.stored()).epsilon(1e-12));
}

}  // namespace

TEST_CASE("collisions keep momentum, and what a gas loses is what they took") {
  for (const auto dense : {Dense::none, Dense::rate, Dense::esmc}) {
    keeps<2>(dense);
    keeps<3>(dense);
  }
}

// Haff's law with the first correction for the shape of the distribution, van Noije & Ernst 1998: T = T_0/(1 + t/τ)², 1/τ = (1 − e²)
// ω_0/4 (2D) or /6 (3D), times 1 + 3/16 a_2; and a_2 itself.
namespace {

double sonine(int D, double e) {
  return 16 * (1 - e) * (1 - 2 * e * e) / (9 + 24 * D + 8 * e * D - 41 * e + 30 * (1 - e) * e * e);
}

template <int D>
void cools(double e_n) {
  constexpr double phi = 0.05;
  Gas<D> gas(60000, phi);
  gas.setup.contact.restitution = laws::ConstantRestitution{e_n};
  gas.setup.dense = Dense::none;
  const double omega = D == 2 ? rate_2d(phi, 1, false) : rate_3d(phi, 1, false);
  gas.setup.time_step = 0.1 / omega;
  // All grains are in one cell: so the gas stays homogeneous, as theory has it.
  gas.setup.cell = gas.setup.domain.length[0];
  DsmcEngine<D> engine(gas.grains, gas.setup);
  engine.advance_to(60);  // the distribution takes its shape within a few collisions
  const double T_0 = told(engine, "temperature"), start = engine.time();
  const double a_2 = sonine(D, e_n);
  const double rate = (1 - e_n * e_n) * omega * std::sqrt(T_0) / (2 * D) * (1 + 3 * a_2 / 16);
  double mean_a_2 = 0;
  int looks = 0;
  for (std::int64_t step = 60; engine.time() - start < 3 / rate; ++looks) {
    engine.advance_to(step += 10);
    mean_a_2 += told(engine, "a_2");
  }
  const double slope = (std::sqrt(T_0 / told(engine, "temperature")) - 1) / (engine.time() - start);
  CAPTURE(D, e_n, a_2, mean_a_2 / looks);
  CHECK(slope / rate == Approx(1).epsilon(0.01));
  CHECK(mean_a_2 / looks == Approx(a_2).margin(0.006));
}

}  // namespace

TEST_CASE("a smooth gas cools by Haff's law, with its fourth cumulant") {
  cools<2>(0.9);
  cools<3>(0.9);
  cools<2>(0.7);
  cools<3>(0.7);
}

// Huthmann & Zippelius 1997, in the limit of large friction: T_rot/T_tr tends to K. A mean-field value; DSMC, which has no
// assumption about the shape of the distribution, lies within some per cent.
TEST_CASE("a rough gas shares its energy between both motions") {
  for (const double beta : {0.0, 0.5}) {
    const double e = 0.9, q = 0.4, eta = q * (1 + beta) / (2 * (1 + q));
    const double A = 1 - e * e + 2 * eta * (1 - eta), B = 2 * eta * eta / q, C = 4 * eta / q * (1 - eta / q),
                 E = 4 * eta * eta / q;
    const double K = ((A - C) + std::sqrt((C - A) * (C - A) + 4 * B * E)) / (2 * B);
    Gas<2> gas(40000, 0.05, 1, 3, 1);
    gas.setup.contact = {laws::ConstantRestitution{e}, laws::Walton{1e6, beta}};
    gas.setup.dense = Dense::none;
    gas.setup.time_step = 0.1 / rate_2d(0.05, 1, false);
    gas.setup.cell = gas.setup.domain.length[0];
    DsmcEngine<2> engine(gas.grains, gas.setup);
    engine.advance_to(800);
    double ratio = 0;
    for (int k = 1; k <= 20; ++k) {
      engine.advance_to(800 + 20 * k);
      ratio += told(engine, "temperature_rotation") / told(engine, "temperature") / 20;
    }
    CAPTURE(beta, K, ratio);
    CHECK(ratio == Approx(K).epsilon(0.08));
  }
}

// Heating and loss: T = (2 ξ²/(ζ*))^(2/3) from d T/dt = m ξ² − ζ T, with ζ = (1 − e²) ω/D (1 + 3/16 a_2), where a_2 = −0.02.
TEST_CASE("white noise and dissipation come to rest where theory has it") {
  constexpr double e = 0.9, phi = 0.05, heat = 0.02;
  Gas<2> gas(20000, phi);
  gas.setup.contact.restitution = laws::ConstantRestitution{e};
  gas.setup.dense = Dense::none;
  gas.setup.heating = heat;
  gas.setup.time_step = 0.2;
  gas.setup.cell = gas.setup.domain.length[0];  // homogeneous
  DsmcEngine<2> engine(gas.grains, gas.setup);
  engine.advance_to(3000);
  double T = 0;
  for (int k = 1; k <= 20; ++k) engine.advance_to(3000 + 20 * k), T += told(engine, "temperature") / 20;
  const double zeta = (1 - e * e) * rate_2d(phi, 1, false) / 2 * (1 - 3 * 0.02 / 16);
  CHECK(T == Approx(std::pow(heat / zeta, 2.0 / 3)).epsilon(0.01));
  const Vec<2> p = momentum(engine.state());
  CHECK(std::abs(p[0]) + std::abs(p[1]) < 1e-8);
  const auto account = engine.energy();
  CHECK(account.residual() == Approx(0).margin(1e-9 * account.wall_work));
}

// Collisions carry momentum over the distance of the centres: of the pressure P = nT (1 + 2φχ) of discs the second part is
// Σ J·d/(2 A t).
TEST_CASE("with distant partners a gas has the pressure of hard discs") {
  constexpr double phi = 0.2, T = 1, w = 0.05;
  Gas<2> gas(20000, phi / w, T);
  gas.setup.dense = Dense::esmc;
  gas.setup.weight = w;
  gas.setup.time_step = 0.2 / rate_2d(phi, T, true);
  DsmcEngine<2> engine(gas.grains, gas.setup);
  engine.advance_to(20);
  engine.collect_collisions(true);
  const double from = engine.time();
  engine.advance_to(120);
  double sum = 0;
  for (const auto& c : engine.take_collisions()) sum += c.force[0] * c.branch[0] + c.force[1] * c.branch[1];
  // Per grain: P A/N = T (1 + 2φχ).
  const double per_grain = sum / (2 * (engine.time() - from) * 20000);
  const double chi = (1 - 7 * phi / 16) / std::pow(1 - phi, 2);
  CHECK(per_grain / T == Approx(2 * phi * chi).epsilon(0.01));
}

TEST_CASE("threads and a restart change no byte") {
  for (const auto dense : {Dense::rate, Dense::esmc}) {
    Gas<2> gas(12000, 0.15, 1, 2, 0.5);
    gas.setup.contact = {laws::ConstantRestitution{0.9}, laws::Walton{0.3, 0.2}};
    gas.setup.dense = dense;
    gas.setup.heating = 0.001;
    gas.setup.gravity[1] = 0;
    gas.setup.time_step = 0.05;
    const auto bytes = [](const DsmcEngine<2>& e) {
      std::ostringstream out;
      e.save(out);
      return out.str();
    };
    DsmcEngine<2> one(gas.grains, gas.setup);
    gas.setup.threads = 3;
    DsmcEngine<2> three(gas.grains, gas.setup), late(gas.grains, gas.setup);
    one.advance_to(30);
    three.advance_to(30);
    const auto half = bytes(one);
    CHECK(half == bytes(three));
    std::istringstream in(half);
    late.restore(in);
    one.advance_to(50);
    late.advance_to(50);
    CHECK(bytes(one) == bytes(late));
  }
}
