#include <catch2/catch.hpp>
#include <numbers>

#include "laws/list.hpp"
#include "odeint_impact.hpp"

using namespace chute::laws;
using chute::test::odeint_impact;

namespace {

constexpr double m_eff = 7.4e-5, r_eff = 1.5e-3, k_linear = 7.32e6, k_hertz = 9.0e7;  // acetate spheres, SI
const Pair pair(m_eff, r_eff);
constexpr double pi = std::numbers::pi;

/// d ln(1 − e_n) / d ln v
template <class Law>
double exponent(const Law& law, double v) {
  const double a = 1 - law.impact(v, pair).restitution, b = 1 - law.impact(1.1 * v, pair).restitution;
  return std::log(b / a) / std::log(1.1);
}

HertzLinearDamping linear(double gamma) { return {Hertz::from_stiffness(k_hertz), gamma, MassScaling::none}; }
HertzKuwabaraKono kono(double gamma) {
  return HertzKuwabaraKono::from_damping(Hertz::from_stiffness(k_hertz), gamma, MassScaling::none);
}

}  // namespace

TEST_CASE("(1.19): Hertz's stiffness of a pair from its material") {
  // 3.2 GPa, ν = 0.28, worked out by hand: E_eff = E / (2 (1 − ν²))
  const auto law = Hertz::from_material(3.2e9, 0.28);
  CHECK(law.stiffness(pair) == Approx(4.0 / 3 * std::sqrt(1.5e-3) * 3.2e9 / (2 * (1 - 0.28 * 0.28))));
  CHECK(law.stiffness(Pair(1, 4 * r_eff)) == Approx(2 * law.stiffness(pair)));
  CHECK(effective_modulus(2e9, 0.3, 2e11, 0.3) == Approx(1 / (0.91 / 2e9 + 0.91 / 2e11)));
}

TEST_CASE("(1.26), (1.28): Hertz's deepest overlap and contact time, the latter with 5/4") {
  const auto law = Hertz::from_stiffness(k_hertz);
  for (const double v : {0.01, 1.0, 30.0}) {
    const auto truth = odeint_impact([](double xi, double) { return k_hertz * std::pow(xi, 1.5); }, m_eff, v,
                                     std::pow(m_eff / k_hertz, 0.4) * std::pow(v, -0.2));
    const auto impact = law.impact(v, pair);
    INFO("t_n " << impact.contact_time << " truth " << truth.time);
    CHECK(impact.contact_time == Approx(truth.time).epsilon(1e-5));
    CHECK(impact.deepest == Approx(truth.deepest).epsilon(1e-4));  // the truth's is a sampled maximum
    CHECK(impact.restitution == 1);
    // the printed number, to the three digits that it has, and the exact one
    CHECK(impact.contact_time * std::pow(k_hertz / m_eff, 0.4) * std::pow(v, 0.2) ==
          Approx(3.218).epsilon(1e-4));
  }
  // (1.27) by quadrature: u = sin² substitution removes the end point's singularity
  double sum = 0;
  const double v = 1, deepest = std::pow(1.25 * m_eff / k_hertz, 0.4) * std::pow(v, 0.8);
  constexpr int n = 20000;
  for (int k = 0; k < n; ++k) {
    const double x = 1 - std::pow(1 - (k + 0.5) / n, 2);  // dξ = 2 (1 − s) ξ_0 ds
    sum += 2 * (1 - (k + 0.5) / n) / std::sqrt(1 - std::pow(x, 2.5)) / n;
  }
  CHECK(law.contact_time(v, pair) == Approx(2 * deepest / v * sum).epsilon(1e-6));
}

TEST_CASE("Every normal law's impact against an independent integration") {
  const double v = GENERATE(0.02, 1.0, 40.0);
  const double hertz_time = std::pow(m_eff / k_hertz, 0.4) * std::pow(v, -0.2),
               linear_time = std::sqrt(m_eff / k_linear);
  const auto compare = [&](const char* name, const NormalImpact& impact, const chute::test::Rebound& truth) {
    INFO(name << " at " << v << " m/s: e_n " << impact.restitution << ", truth " << truth.restitution);
    CHECK(std::abs(impact.restitution - truth.restitution) < 1e-6);  // the truth's last step ends at a kink
    CHECK(impact.contact_time == Approx(truth.time).epsilon(1e-5));
    CHECK(impact.deepest == Approx(truth.deepest).epsilon(1e-4));
  };
  compare("(3.1)", SpringDashpot::from_damping(k_linear, 2.06, MassScaling::none).impact(v, pair),
          odeint_impact([](double xi, double u) { return k_linear * xi + 2.06 * u; }, m_eff, v, linear_time));
  compare("(3.5)", linear(0.35).impact(v, pair),
          odeint_impact([](double xi, double u) { return k_hertz * std::pow(xi, 1.5) + 0.35 * u; }, m_eff, v,
                        hertz_time));
  compare(
      "(3.6)", kono(190).impact(v, pair),
      odeint_impact([](double xi, double u) { return k_hertz * std::pow(xi, 1.5) + 190 * std::sqrt(xi) * u; },
                    m_eff, v, hertz_time));
  double most = 0;  // (3.7): the truth carries the largest overlap along
  const double s = 2e5;
  compare("(3.7)", WaltonBraun::from_hardening(k_linear, s).impact(v, pair),
          odeint_impact(
              [&](double xi, double u) {
                if (u > 0) return most = std::max(most, xi), k_linear * xi;
                const double k_2 = k_linear * (1 + s * most);
                return std::max(0.0, k_2 * (xi - most * (1 - k_linear / k_2)));
              },
              m_eff, v, linear_time));
}

TEST_CASE("(3.2) to (3.4), (3.8): closed forms as printed") {
  const double gamma = 2.06, decay = gamma / (2 * m_eff);
  const auto law = SpringDashpot::from_damping(k_linear, gamma, MassScaling::none);
  const double t_n = pi / std::sqrt(k_linear / m_eff - decay * decay);
  CHECK(law.impact(3, pair).contact_time == Approx(t_n).epsilon(1e-12));
  CHECK(law.impact(3, pair).restitution == Approx(std::exp(-decay * t_n)).epsilon(1e-12));
  CHECK(law.impact(3, pair).deepest < 3 * t_n / pi);
  CHECK(t_n == Approx(1e-5).epsilon(1e-3));
  CHECK(law.impact(1, pair).restitution == Approx(0.87).epsilon(1e-3));
  const auto elastic = SpringDashpot::from_restitution(k_linear, 1);
  CHECK(elastic.impact(3, pair).deepest == Approx(3 * elastic.contact_time(pair) / pi).epsilon(1e-12));
  for (const double v : {0.01, 1.0, 100.0})
    CHECK(WaltonBraun::from_hardening(k_linear, 2e5).impact(v, pair).restitution ==
          Approx(std::pow(2e5 * v * std::sqrt(m_eff / k_linear) + 1, -0.5)).epsilon(1e-12));
  CHECK(WaltonBraun::from_stiffnesses(1, 4).impact(7, pair).restitution == Approx(0.5));
}

TEST_CASE("1 − e_n goes as v^0, v^(−1/5), v^(1/5) in the elastic limit") {
  const auto spring = SpringDashpot::from_damping(k_linear, 2.06, MassScaling::none);
  CHECK(exponent(spring, 1) == Approx(0).margin(1e-12));
  double last_linear = 1, last_kono = 1;
  for (const double decades : {2, 5, 8, 11}) {
    const double p = exponent(linear(0.35), std::pow(10, decades)),
                 q = exponent(kono(190), std::pow(10, -decades));
    WARN("10^±" << decades << " m/s: exponents " << p << " (3.5), " << q << " (3.6)");
    CHECK(std::abs(p + 0.2) < last_linear);
    CHECK(std::abs(q - 0.2) < last_kono);
    last_linear = std::abs(p + 0.2), last_kono = std::abs(q - 0.2);
  }
  CHECK(last_linear < 5e-4);
  CHECK(last_kono < 5e-4);
}

TEST_CASE("Clipping the attraction: the closed form, and the damping that gives the asked restitution") {
  for (const double e_n : {0.95, 0.6, 0.2}) {
    const auto law = SpringDashpot::from_restitution(k_linear, e_n, false);
    const double gamma = law.damping(pair);
    const auto truth =
        odeint_impact([&](double xi, double u) { return std::max(0.0, k_linear * xi + gamma * u); }, m_eff, 1,
                      std::sqrt(m_eff / k_linear));
    CHECK(std::abs(truth.restitution - e_n) < 1e-6);
    const auto impact = normal_impact({law, {}, false}, 1, pair);
    CHECK(std::abs(impact.restitution - e_n) < 1e-7);
    CHECK(impact.contact_time == Approx(truth.time).epsilon(1e-5));
    // without attraction the same damping takes less
    CHECK(SpringDashpot::clipped_restitution(0.3) > std::exp(-0.3 / std::sqrt(0.91) * pi));
  }
}

TEST_CASE("Damping that gives an asked restitution at 1 m/s: Fig. 3.2 b") {
  for (const double e_n : {0.95, 0.6, 0.2}) {
    const double gamma =
        damping_for([](double g) { return linear(g).impact(1, pair).restitution; }, e_n, 0.1);
    const auto truth =
        odeint_impact([&](double xi, double u) { return k_hertz * std::pow(xi, 1.5) + gamma * u; }, m_eff, 1,
                      std::pow(m_eff / k_hertz, 0.4));
    WARN("(3.5) with e_n = " << e_n << " at 1 m/s: gamma_n = " << gamma << " kg/s");
    CHECK(std::abs(truth.restitution - e_n) < 1e-6);
  }
  // the printed ones are not even close: 42.8 kg/s would stick
  CHECK(linear(42.8).impact(1, pair).restitution == 0);
}

TEST_CASE("Elastic parts: force = dE/dξ, and loaded spheres give back what they store") {
  const auto check = [&](const auto& law) {
    for (const double xi : {1e-7, 3e-6, 5e-5}) {
      const double h = 1e-4 * xi;
      CHECK((law.energy(xi + h, pair) - law.energy(xi - h, pair)) / (2 * h) ==
            Approx(law(xi, 0, pair).total).epsilon(1e-6));
    }
  };
  check(SpringDashpot::from_damping(k_linear, 2.06, MassScaling::none));
  check(Hertz::from_stiffness(k_hertz));
  check(linear(0.35));
  check(kono(190));
  // (3.7): on the unloading line at fixed memory, and loss = work − stored on the way in
  const auto law = WaltonBraun::from_stiffnesses(1, 2.5);
  std::array<double, 1> memory{};
  double work = 0, loss = 0, before = 0;
  const auto move = [&](double from, double to) {
    for (int k = 1; k <= 1000; ++k) {
      const auto f = law(from + (to - from) * k / 1000, 0, pair, memory);
      work += 0.5 * (before + f.total) * (to - from) / 1000;
      loss += f.loss;
      before = f.total;
    }
  };
  move(0, 1);
  CHECK(work == Approx(0.5).epsilon(1e-6));
  CHECK(loss + law.energy(1, pair, memory) == Approx(work).epsilon(1e-6));
  move(1, 0.7);
  const double force = before;
  CHECK(force == Approx(2.5 * (0.7 - 0.6)).epsilon(1e-9));
  move(0.7, 0.9);  // loading again follows the second line: no energy from nothing
  CHECK(before == Approx(2.5 * 0.3).epsilon(1e-9));
  move(0.9, 1.2);
  CHECK(before == Approx(1.2).epsilon(1e-9));
  CHECK(loss + law.energy(1.2, pair, memory) == Approx(work).epsilon(1e-5));
  move(1.2, 0);
  CHECK(before == 0);
  CHECK(loss == Approx(work).epsilon(1e-5));
  CHECK(loss == Approx(0.5 * 1.44 * (1 - 1 / 2.5)).epsilon(1e-9));
}

TEST_CASE("Mass conventions of 3.1.1: e_n grows with m_eff, falls, or does not depend on it") {
  const auto restitution = [](MassScaling scaling, double m) {
    return SpringDashpot::from_damping(1e5, scaling == MassScaling::none ? 20 : 40, scaling)
        .impact(1, m)
        .restitution;
  };
  CHECK(restitution(MassScaling::none, 2) > restitution(MassScaling::none, 0.5));
  CHECK(restitution(MassScaling::damping, 2) < restitution(MassScaling::damping, 0.5));
  CHECK(restitution(MassScaling::both, 2) == Approx(restitution(MassScaling::both, 0.5)).epsilon(1e-12));
  for (const auto scaling : {MassScaling::none, MassScaling::damping, MassScaling::both}) {
    const HertzLinearDamping law(Hertz::from_stiffness(1e5, scaling), 3, scaling);
    const double factor = scaling == MassScaling::none ? 1 : 0.25;
    CHECK(law.damping(0.25) == Approx(3 * factor));
    CHECK(law.stiffness(0.25) == Approx(scaling == MassScaling::both ? 0.25e5 : 1e5));
  }
}
