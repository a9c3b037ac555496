#include <catch2/catch.hpp>

#include "../lawlab/odeint_impact.hpp"
#include "experiments/binary_impact.hpp"

using namespace chute;
using namespace chute::experiments;
using chute::test::odeint_impact;

namespace normal_impacts_tests {

namespace {

constexpr double m_eff = Acetate::reduced_mass, k = Acetate::stiffness, K = Acetate::hertz_stiffness;

const laws::Hertz hertz = laws::Hertz::from_stiffness(K);

struct Case {
  const char* name;
  laws::Normal law;
  std::function<double(double, double)> force;  // the truth's, written out here
  bool attraction = true;
};

std::vector<Case> cases() {
  using laws::MassScaling;
  return {{"(1.18)", hertz, [](double xi, double) { return K * std::pow(xi, 1.5); }},
          {"(3.1)", Acetate::spring_dashpot(), [](double xi, double u) { return k * xi + 2.06 * u; }},
          {"(3.1) clipped", Acetate::spring_dashpot(),
           [](double xi, double u) { return std::max(0.0, k * xi + 2.06 * u); }, false},
          {"(3.5)", laws::HertzLinearDamping(hertz, 0.35, MassScaling::none),
           [](double xi, double u) { return K * std::pow(xi, 1.5) + 0.35 * u; }},
          {"(3.5) clipped", laws::HertzLinearDamping(hertz, 0.35, MassScaling::none),
           [](double xi, double u) { return std::max(0.0, K * std::pow(xi, 1.5) + 0.35 * u); }, false},
          {"(3.6)", laws::HertzKuwabaraKono::from_damping(hertz, 190, MassScaling::none),
           [](double xi, double u) { return K * std::pow(xi, 1.5) + 190 * std::sqrt(xi) * u; }}};
}

}  // namespace

TEST_CASE("The engine's e_n(v) of each law against an independent integration") {
  const auto scheme = GENERATE(soft::Scheme::gear5, soft::Scheme::verlet);
  for (const auto& c : cases())
    for (const double v : {0.01, 0.3, 1.0, 10.0, 100.0}) {
      const bool linear = std::holds_alternative<laws::SpringDashpot>(c.law);
      const double scale = linear ? std::sqrt(m_eff / k) : std::pow(m_eff / K, 0.4) * std::pow(v, -0.2);
      const auto truth = odeint_impact(c.force, m_eff, v, scale);
      auto impact = Acetate::meet({c.law, laws::Frictionless{}, c.attraction}, v, 0, 5000);
      impact.scheme = scheme;
      const auto outcome = collide(impact);
      INFO(c.name << " at " << v << " m/s: " << outcome.restitution() << ", truth " << truth.restitution);
      CHECK(std::abs(outcome.restitution() - truth.restitution) < 1e-4);
      CHECK(outcome.contact_time == Approx(truth.time).epsilon(1e-3));
    }
}

TEST_CASE("The engine reproduces (3.2), (3.3), (3.8), (1.26) and (1.28)") {
  const auto restitution = [](const laws::Normal& law, double v) {
    return collide(Acetate::meet({law, laws::Frictionless{}}, v, 0, 5000));
  };
  double worst = 0;
  const double decay = 2.06 / (2 * m_eff), t_n = std::numbers::pi / std::sqrt(k / m_eff - decay * decay);
  const auto spring = restitution(Acetate::spring_dashpot(), 1);
  CHECK(std::abs(spring.restitution() - std::exp(-decay * t_n)) < 1e-4);
  CHECK(spring.contact_time == Approx(t_n).epsilon(5e-4));
  for (const double v : {0.01, 0.1, 1.0, 10.0, 100.0}) {
    const double e_n = restitution(laws::WaltonBraun::from_hardening(k, 2e5), v).restitution();
    worst = std::max(worst, std::abs(e_n - std::pow(2e5 * v * std::sqrt(m_eff / k) + 1, -0.5)));
  }
  WARN("(3.8): largest deviation of e_n from 0.01 to 100 m/s " << worst);
  CHECK(worst < 1e-4);
  CHECK(restitution(laws::WaltonBraun::from_stiffnesses(k, 4 * k), 1).restitution() ==
        Approx(0.5).epsilon(1e-4));
  for (const double v : {0.1, 1.0, 10.0}) {
    auto impact = Acetate::meet({hertz, laws::Frictionless{}}, v, 0, 5000);
    impact.trace = true;
    const auto outcome = collide(impact);
    double deepest = 0;
    for (const auto& p : outcome.trace) deepest = std::max(deepest, p.overlap);
    CHECK(deepest == Approx(std::pow(1.25 * m_eff / K, 0.4) * std::pow(v, 0.8)).epsilon(1e-5));
    CHECK(outcome.contact_time ==
          Approx(3.21797 * std::pow(m_eff / K, 0.4) * std::pow(v, -0.2)).epsilon(5e-4));
    CHECK(outcome.restitution() == Approx(1).epsilon(1e-6));
  }
}

TEST_CASE("A material's stiffness is that of each pair") {
  // 1 against 2 of unequal radius, and 1 against a fixed one: (1.19) and the reduced mass by hand
  for (const bool fixed : {false, true}) {
    BinaryImpact<2> impact;
    impact.laws = {laws::Hertz::from_material(1e8, 0.25), laws::Frictionless{}};
    impact.i = {0.4, 1, {{1, 0}}, {}, false};
    impact.j = {1.2, 3, {{0, 0}}, {}, fixed};
    impact.normal = {{1, 0}};
    impact.trace = true;
    const double m = fixed ? 1 : 0.75, R = 0.4 * 1.2 / 1.6,
                 stiffness = 4.0 / 3 * std::sqrt(R) * 1e8 / (2 * (1 - 0.0625));
    double deepest = 0;
    for (const auto& p : collide(impact).trace) deepest = std::max(deepest, p.overlap);
    CHECK(deepest == Approx(std::pow(1.25 * m / stiffness, 0.4)).epsilon(1e-4));
  }
}

TEST_CASE("What a normal impact loses is what the account says, with memory or without") {
  for (const laws::Normal& law :
       {laws::Normal(Acetate::spring_dashpot()),
        laws::Normal(laws::HertzKuwabaraKono::from_damping(hertz, 190, laws::MassScaling::none)),
        laws::Normal(laws::WaltonBraun::from_hardening(k, 2e5))})
    for (const bool attraction : {true, false}) {
      const auto outcome = collide(Acetate::meet({law, laws::Frictionless{}, attraction}, 2, 0, 5000));
      CHECK(outcome.normal_loss == Approx(outcome.energy_before - outcome.energy_after).epsilon(2e-3));
      CHECK(outcome.shear_loss == 0);
    }
}

}  // namespace normal_impacts_tests
