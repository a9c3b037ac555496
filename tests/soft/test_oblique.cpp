#include <catch2/catch.hpp>

#include "two_grains.hpp"

namespace oblique_tests {
using namespace chute;
using namespace chute::test;

namespace {

constexpr double k = 1e8, R = 0.5, m = 1, m_eff = 0.5, v_n = 1;

struct After {
  double psi_n, psi_s;  ///< normal and tangential relative velocity over |v_n| before: e_n and ψ_f
  double angular_momentum, angular_momentum_before;
};

double spin_and_orbit(const Grains<2>& g) {
  double sum = 0;
  for (std::size_t i = 0; i < g.moving; ++i)
    sum += g.mass[i] * (g.position[0][i] * g.velocity[1][i] - g.position[1][i] * g.velocity[0][i]) +
           g.inertia[i] * g.spin[0][i];
  return sum;
}

/// Ball i hits ball j, which lies in direction x, with v_s = ψ_i |v_n|; a part of the slip comes from the
/// spins.
After oblique(double psi, double restitution, const laws::ContactLaws& contact, double stiffness = k,
              double steps = 200) {
  const double damp = -std::log(restitution) / pi;
  const double t_n = pi / std::sqrt(stiffness / m_eff / (1 + damp * damp)), dt = t_n / steps;
  Grains<2> grains;
  const double gap = 3.4 * dt * v_n;
  // with n = x: s = (n_y, −n_x) = −y, so v_s = v_i,y − v_j,y + R (ω_i + ω_j) (1.14)
  add_ball<2>(grains, {{-R, 0}}, {{v_n, 0.5 * psi}}, R, m);
  add_ball<2>(grains, {{R + gap, 0}}, {{0, -0.1 * psi}}, R, m);
  grains.spin[0][0] = 0.5 * psi / R;
  grains.spin[0][1] = -0.1 * psi / R;
  // the balls pass each other a little before they touch: undo it, so that they meet with n along x
  grains.position[1][0] -= 0.5 * psi * 3.4 * dt;
  grains.position[1][1] += 0.1 * psi * 3.4 * dt;
  soft::SoftEngine<2> engine(grains, setup<2>(contact, dt, 2 * R));
  const double before = spin_and_orbit(engine.state());
  REQUIRE(through_one_contact(engine) > 0);
  engine.advance_to(engine.step() + 10);
  const auto& g = engine.state();
  const auto dv = g.speed(1) - g.speed(0);
  return {dv[0], -dv[1] + R * (g.spin[0][0] + g.spin[0][1]), spin_and_orbit(g), before};
}

laws::ContactLaws coulomb(double e_n, double viscosity, double friction, double stiffness = k) {
  return {laws::SpringDashpot::from_restitution(stiffness, e_n),
          laws::RegularisedCoulomb{viscosity, friction, laws::MassScaling::none, {}}};
}

// γ_s at which slip decays by 3.5 γ_s δt / m_eff = 0.16 per step of t_n/200: fast against t_n, and stable.
double sticky(double stiffness = k) { return 0.16 * 200 / 3.5 * m_eff / (pi / std::sqrt(stiffness / m_eff)); }
// While they touch, the line between the centres turns by up to |ψ| v_n t_n / 2R = 2.3e-4 |ψ|. That makes a
// part of the tangential velocity (ψ) a normal one, and of the normal velocity (1) a tangential one.
double turning(double psi) { return (1 + std::abs(psi)) * std::abs(psi) * 2.3e-4; }

}  // namespace

TEST_CASE("a sliding impact takes 7/2 μ (1 + e_n) of ψ (2.28, corrected)") {
  const double mu = 0.2;
  for (double psi : {2.0, 3.0, 8.0, -3.0}) {
    const auto after = oblique(psi, 1, coulomb(1, sticky(), mu));
    INFO("psi " << psi);
    CHECK(after.psi_n == Approx(1).margin(1e-3 + turning(psi)));
    CHECK(after.psi_s ==
          Approx(std::copysign(std::abs(psi) - 3.5 * mu * 2, psi)).margin(2e-3 + 2 * turning(psi)));
  }
}

// The law pulls at the end of a damped contact, and Coulomb's limit takes |F_n|: the slip sees ∫|F_n| dt
// instead of (1 + e_n) m_eff v_n. The parting speed is greatest, v*, where F_n changes sign: the integral is
// 1 + 2 v* − e_n.
TEST_CASE("a damped sliding impact takes 7/2 μ of the whole normal impulse") {
  const double e_n = 0.6, mu = 0.2, psi = 4;
  const double damp = -std::log(e_n) / pi;  // decay over frequency
  const double phase = pi + std::atan2(-2 * damp, 1 - damp * damp);
  const double v_star = -std::exp(-damp * phase) * (std::cos(phase) - damp * std::sin(phase));
  CHECK(v_star > e_n);
  const auto after = oblique(psi, e_n, coulomb(e_n, sticky(), mu), k, 1000);
  CHECK(after.psi_n == Approx(e_n).margin(2e-3));
  CHECK(after.psi_s == Approx(psi - 3.5 * mu * (1 + 2 * v_star - e_n)).margin(2e-3 + 2 * turning(psi)));
}

TEST_CASE("a sticking impact leaves no slip: e_s goes to 0") {
  for (double psi : {0.1, 0.5, -0.5}) {
    const auto after = oblique(psi, 1, coulomb(1, sticky(), 0.4));
    CHECK(std::abs(after.psi_s) < 1e-3 * std::abs(psi) + 2 * turning(psi));
  }
}

TEST_CASE("slip decays as exp(−7/2 γ_s t / m_eff) where Coulomb's limit is far") {
  const double viscosity = 600, t_n = pi / std::sqrt(k / m_eff);
  const double left = std::exp(-3.5 * viscosity / m_eff * t_n);
  REQUIRE(left > 0.3);
  const auto after = oblique(0.5, 1, coulomb(1, viscosity, 1e4), k, 500);
  CHECK(after.psi_s == Approx(0.5 * left).margin(2e-3 * 0.5 + 2 * turning(0.5)));
}

// The thesis lets the tangential force act at R from each centre, not at R − ξ/2. The pair then gains ∫ ξ F_s
// dt: sliding and elastic, with F_s = ∓μ k ξ, that is μ m_eff v_n² t_n / 2, which goes to 0 for stiff grains.
TEST_CASE("angular momentum is kept but for the lever arm R instead of R − ξ/2") {
  const double mu = 0.2, psi = 4;
  for (double stiffness : {1e6, 1e8}) {
    const double t_n = pi / std::sqrt(stiffness / m_eff);
    const auto after = oblique(psi, 1, coulomb(1, sticky(stiffness), mu, stiffness), stiffness);
    const double gain = -mu * m_eff * v_n * v_n * t_n / 2;  // F_s brakes the positive slip
    CHECK(after.angular_momentum - after.angular_momentum_before == Approx(gain).epsilon(0.02));
  }
}

TEST_CASE("without friction angular momentum is kept to rounding") {
  const auto after = oblique(4, 1, smooth(k, 0));
  CHECK(after.angular_momentum == Approx(after.angular_momentum_before).epsilon(1e-12));
}

}  // namespace oblique_tests
