#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <catch2/catch.hpp>

#include "../lawlab/odeint_impact.hpp"
#include "experiments/binary_impact.hpp"

using namespace chute;
using namespace chute::experiments;

namespace oblique_impacts_tests {

namespace {

constexpr double m_eff = Acetate::reduced_mass, k = Acetate::stiffness, damping = 2.06, mu = 0.25;

/// ψ_f of two equal solid spheres in the limit that the line of centres does not turn: ξ, ξ', v_s and ζ as an
/// ordinary differential equation, m_eff ξ'' = −F_n, 2/7 m_eff v_s' = F_s, ζ' = v_s, integrated by Odeint
/// until ξ = 0.
double truth(double psi, double v_n,
             const std::function<double(double v_s, double zeta, double xi, double F_n)>& shear,
             const std::function<double(double, double)>& normal, double time_scale) {
  namespace odeint = boost::numeric::odeint;
  using State = std::array<double, 4>;  // in units of v_n and v_n · time scale
  const double length = v_n * time_scale;
  const auto slope = [&](const State& y, State& dy, double) {
    const double F_n = normal(std::max(0.0, y[0]) * length, y[1] * v_n);
    const double F_s = shear(y[2] * v_n, y[3] * length, std::max(0.0, y[0]) * length, F_n);
    dy = {y[1], -F_n / m_eff * time_scale / v_n, 3.5 * F_s / m_eff * time_scale / v_n, y[2]};
  };
  odeint::runge_kutta_fehlberg78<State> stepper;
  State y{0, 1, psi, 0};
  const double h = 2e-5;
  for (double t = 0; t < 100; t += h) {
    const State before = y;
    stepper.do_step(slope, y, t, h);
    if (y[0] > 0) continue;
    const double part = before[0] / (before[0] - y[0]);
    return before[2] + part * (y[2] - before[2]);
  }
  return NAN;
}

double sign(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

/// The slow impact of the engine, in the same limit.
double simulated(double psi, const laws::ContactLaws& law, double v_n) {
  return collide(Acetate::meet(law, v_n * std::sqrt(1 + psi * psi), std::atan(psi), 10000)).psi_after;
}

}  // namespace

TEST_CASE("psi_f of the tangential laws against an independent integration") {
  const auto spring_dashpot = [](double xi, double u) { return k * xi + damping * u; };
  const double scale = std::sqrt(m_eff / k);
  double worst = 0;
  const auto compare = [&](const char* name, const laws::Shear& law, const auto& shear) {
    for (const double psi : {0.1, 0.5, 0.9, 1.3, 2.0, 5.0}) {
      const double expected = truth(psi, 1, shear, spring_dashpot, scale);
      const double found = simulated(psi, {Acetate::spring_dashpot(), law}, 1e-3);
      INFO(name << " psi_i " << psi << ": " << found << ", truth " << expected);
      CHECK(std::abs(found - expected) < 2e-4);
      worst = std::max(worst, std::abs(found - expected));
    }
  };
  compare("(3.11)", laws::Viscous{3, laws::MassScaling::none},
          [](double v, double, double, double) { return -3 * v; });
  compare("(3.12)", laws::RegularisedCoulomb{3, mu, laws::MassScaling::none, {}},
          [](double v, double, double, double F) {
            return -std::min(std::abs(3 * v), mu * std::abs(F)) * sign(v);
          });
  for (const double ratio : {1.0, 2.0 / 7, 0.2})
    compare("(3.13)", laws::CundallStrack{{ratio * k, 0, 0, 0}, {mu, false}},
            [=](double, double zeta, double, double F) {
              return -std::min(ratio * k * std::abs(zeta), mu * std::abs(F)) * sign(zeta);
            });
  WARN("largest deviation of psi_f from the independent integration: " << worst);
}

TEST_CASE("psi_f of (3.22) with (3.6) against an independent integration") {
  const double K = Acetate::hertz_stiffness, v = 1e-4, scale = std::pow(m_eff / K, 0.4) * std::pow(v, -0.2);
  const auto kono =
      laws::HertzKuwabaraKono::from_damping(laws::Hertz::from_stiffness(K), 190, laws::MassScaling::none);
  for (const double ratio : {2.0 / 3, 0.2})
    for (const double psi : {0.2, 0.8, 1.5, 4.0}) {
      const double expected = truth(
          psi, v,
          [=](double, double zeta, double xi, double F) {
            return -std::min(ratio * K * std::sqrt(xi) * std::abs(zeta), mu * std::abs(F)) * sign(zeta);
          },
          [=](double xi, double u) { return K * std::pow(xi, 1.5) + 190 * std::sqrt(xi) * u; }, scale);
      const double found =
          simulated(psi, {kono, laws::MindlinSpring{{ratio * K, 0, 0, 0}, {mu, false}, false}}, v);
      INFO("psi_i " << psi << ": " << found << ", truth " << expected);
      CHECK(std::abs(found - expected) < 2e-4);
    }
}

TEST_CASE("(2.28) holds for (3.10) while it slides; it never turns the slip round") {
  const double e_n = std::exp(-damping / (2 * m_eff) * std::numbers::pi /
                              std::sqrt(k / m_eff - std::pow(damping / (2 * m_eff), 2)));
  for (const double friction : {0.15, 0.25, 0.35})
    for (const double psi : {0.2, 1.0, 3.0, 8.0}) {
      // ∫|F_n| dt is more than m_eff (1 + e_n) v_n: F_n attracts at the end. Over the two parts with their
      // signs:
      const double x = damping / (2 * std::sqrt(k * m_eff)), w = std::sqrt(1 - x * x),
                   phase = std::atan2(2 * x * w, 2 * x * x - 1);
      const double at_zero =
          std::exp(-x / w * phase) * (x / w * std::sin(phase) - std::cos(phase));  // −v_n where F_n = 0
      const double impulse = (1 + at_zero) + (at_zero - e_n);
      const double expected = std::max(0.0, psi - 3.5 * friction * impulse);
      const double found = simulated(psi, {Acetate::spring_dashpot(), laws::Coulomb{friction}}, 1e-3);
      INFO("mu " << friction << " psi_i " << psi << ": " << found << ", expected " << expected);
      CHECK(std::abs(found - expected) < 2e-4);
    }
}

namespace {

template <int D>
struct Turned {
  BinaryImpact<D> impact;
  std::function<Vec<D>(const Vec<D>&)> back;  // vectors of the outcome to those of the original
  std::function<Vec<turns<D>>(const Vec<turns<D>>&)> spin_back;
  Vec<D> boost{};
  bool swapped = false;
};

template <int D>
BinaryImpact<D> example(const laws::ContactLaws& law) {
  BinaryImpact<D> impact;
  impact.laws = law;
  impact.steps = 300;
  impact.i = {0.5, 1, {}, {}, false};
  impact.j = {0.8, 2.5, {}, {}, false};
  if constexpr (D == 2) {
    impact.i.velocity = {{1, 0.4}}, impact.j.velocity = {{-0.3, 0.9}};
    impact.i.spin = {{0.7}}, impact.j.spin = {{-1.1}};
    impact.normal = {{0.8, 0.6}};
  } else {
    impact.i.velocity = {{1, 0.4, -0.2}}, impact.j.velocity = {{-0.3, 0.9, 0.5}};
    impact.i.spin = {{0.7, -0.4, 0.2}}, impact.j.spin = {{-1.1, 0.3, 0.8}};
    impact.normal = {{0.8, 0.48, 0.36}};
  }
  return impact;
}

/// Rotation (and mirroring) of vectors; spins are axial.
template <int D>
Vec<D> turn(const Vec<D>& a, double angle) {
  Vec<D> b = a;
  b[0] = std::cos(angle) * a[0] - std::sin(angle) * a[1];
  b[1] = std::sin(angle) * a[0] + std::cos(angle) * a[1];
  if constexpr (D == 3) {
    const Vec<3> c = b;
    b[1] = std::cos(0.7) * c[1] - std::sin(0.7) * c[2];
    b[2] = std::sin(0.7) * c[1] + std::cos(0.7) * c[2];
  }
  return b;
}
template <int D>
Vec<D> mirror(Vec<D> a) {
  a[0] = -a[0];
  return a;
}
template <int D>
Vec<turns<D>> mirror_spin(Vec<turns<D>> w) {
  if constexpr (D == 2)
    return -1 * w;
  else
    return {{w[0], -w[1], -w[2]}};
}

template <int D>
void check_frames(const laws::ContactLaws& law) {
  const auto impact = example<D>(law);
  const auto base = collide(impact);
  const auto close = [](const auto& a, const auto& b) { return norm(a - b) < 1e-8; };
  const auto turn_spin = [](const Vec<turns<D>>& w) {
    if constexpr (D == 2)
      return w;
    else
      return turn(w, 1.1);
  };
  SECTION("rotated") {
    auto other = impact;
    for (auto* b : {&other.i, &other.j}) b->velocity = turn(b->velocity, 1.1), b->spin = turn_spin(b->spin);
    other.normal = turn(other.normal, 1.1);
    const auto outcome = collide(other);
    CHECK(close(outcome.i.velocity, turn(base.i.velocity, 1.1)));
    CHECK(close(outcome.j.velocity, turn(base.j.velocity, 1.1)));
    CHECK(close(outcome.i.spin, turn_spin(base.i.spin)));
    CHECK(close(outcome.j.spin, turn_spin(base.j.spin)));
  }
  SECTION("moved elsewhere") {
    auto other = impact;
    other.origin[0] = 13, other.origin[1] = -7;
    const auto outcome = collide(other);
    CHECK(close(outcome.i.velocity, base.i.velocity));
    CHECK(close(outcome.j.spin, base.j.spin));
  }
  SECTION("seen in passing") {
    auto other = impact;
    Vec<D> boost;
    boost[0] = 3, boost[1] = -1.7;
    other.i.velocity = other.i.velocity + boost, other.j.velocity = other.j.velocity + boost;
    const auto outcome = collide(other);
    CHECK(close(outcome.i.velocity, base.i.velocity + boost));
    CHECK(close(outcome.j.velocity, base.j.velocity + boost));
    CHECK(close(outcome.i.spin, base.i.spin));
  }
  SECTION("mirrored") {
    auto other = impact;
    for (auto* b : {&other.i, &other.j}) b->velocity = mirror(b->velocity), b->spin = mirror_spin<D>(b->spin);
    other.normal = mirror(other.normal);
    const auto outcome = collide(other);
    CHECK(close(outcome.i.velocity, mirror(base.i.velocity)));
    CHECK(close(outcome.j.velocity, mirror(base.j.velocity)));
    CHECK(close(outcome.i.spin, mirror_spin<D>(base.i.spin)));
    CHECK(close(outcome.j.spin, mirror_spin<D>(base.j.spin)));
  }
  SECTION("i and j exchanged") {
    auto other = impact;
    std::swap(other.i, other.j);
    other.normal = -1 * other.normal;
    const auto outcome = collide(other);
    CHECK(close(outcome.j.velocity, base.i.velocity));
    CHECK(close(outcome.i.velocity, base.j.velocity));
    CHECK(close(outcome.j.spin, base.i.spin));
    CHECK(close(outcome.i.spin, base.j.spin));
  }
  SECTION("momentum") {
    CHECK(close(base.i.velocity + 2.5 * base.j.velocity, impact.i.velocity + 2.5 * impact.j.velocity));
  }
}

const laws::Normal spring = laws::SpringDashpot::from_restitution(1e5, 0.8);
const laws::Normal hertz_law =
    laws::HertzKuwabaraKono::from_damping(laws::Hertz::from_material(1e6, 0.3), 500, laws::MassScaling::none);
const laws::PairCoefficient k_s{3e4, 0, 0, 0}, k_hertz_s{8e5, 0, 0, 0};
const std::vector<laws::ContactLaws> all_laws = {
    {spring, laws::Frictionless{}},
    {spring, laws::RegularisedCoulomb{20, 0.3, laws::MassScaling::none, {}}},
    {spring, laws::Viscous{20, laws::MassScaling::damping}},
    {spring, laws::CundallStrack{k_s, {0.3, true}}},
    {spring, laws::CundallStrack{k_s, {0.3, false}}},
    {spring, laws::WaltonBraunMindlin{k_s, 0.3}},
    {hertz_law, laws::MindlinSpring{k_hertz_s, {0.3, true}}},
    {laws::WaltonBraun::from_hardening(1e5, 100), laws::CundallStrack{k_s, {0.3, true}}},
    {laws::HertzLinearDamping(laws::Hertz::from_stiffness(1e6), 5, laws::MassScaling::none),
     laws::SawTooth{0.3, 0.01}, false},
    {spring, laws::Coulomb{0.3}},
    {laws::Hertz::from_stiffness(1e6), laws::MindlinSpring{k_hertz_s, {0.3, false}, false}},
};

}  // namespace

TEST_CASE("An impact is the same in every frame, in 2D") {
  const auto which = GENERATE(range(std::size_t{0}, all_laws.size()));
  check_frames<2>(all_laws[which]);
}
TEST_CASE("An impact is the same in every frame, in 3D") {
  const auto which = GENERATE(range(std::size_t{0}, all_laws.size()));
  check_frames<3>(all_laws[which]);
}

TEST_CASE("An impact in a plane is the same in 3D as in 2D") {
  for (const auto& law : all_laws) {
    const auto flat = example<2>(law);
    BinaryImpact<3> deep;
    deep.laws = law;
    deep.steps = flat.steps;
    deep.normal = {{flat.normal[0], flat.normal[1], 0}};
    const auto lift = [](const Ball<2>& b) {
      return Ball<3>{b.radius, b.mass, {{b.velocity[0], b.velocity[1], 0}}, {{0, 0, b.spin[0]}}, b.fixed};
    };
    deep.i = lift(flat.i), deep.j = lift(flat.j);
    const auto a = collide(flat);
    const auto b = collide(deep);
    for (int c = 0; c < 2; ++c) {
      CHECK(b.i.velocity[c] == Approx(a.i.velocity[c]).margin(1e-9));
      CHECK(b.j.velocity[c] == Approx(a.j.velocity[c]).margin(1e-9));
    }
    CHECK(b.i.spin[2] == Approx(a.i.spin[0]).margin(1e-9));
    CHECK(b.psi_after == Approx(a.psi_after).margin(1e-9));
  }
}

}  // namespace oblique_impacts_tests
