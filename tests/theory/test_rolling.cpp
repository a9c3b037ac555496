#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "common/error.hpp"
#include "theory/rolling.hpp"

using namespace chute::theory;

namespace {

/// The ball's way over one bead, integrated: γ̈ = (m/m_eff) g/(R+r) sin(γ + θ), (4.33), with RK4 in time until
/// γ_max.
struct Rolling {
  double k, theta, gamma_max;
  struct Exit {
    double rate, time;
    bool over;
  };
  void step(double dt, double& gamma, double& rate) const {
    const auto pull = [&](double x) { return k * std::sin(x + theta); };
    const double k1 = rate, a1 = pull(gamma);
    const double k2 = rate + dt / 2 * a1, a2 = pull(gamma + dt / 2 * k1);
    const double k3 = rate + dt / 2 * a2, a3 = pull(gamma + dt / 2 * k2);
    const double k4 = rate + dt * a3, a4 = pull(gamma + dt * k3);
    gamma += dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    rate += dt / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
  }
  Exit over_bead(double rate) const {
    double gamma = -gamma_max, time = 0;
    for (double dt = 2e-3 * gamma_max / rate; rate > 0;) {
      const double gamma_0 = gamma, rate_0 = rate;
      step(dt, gamma, rate);
      if (gamma < gamma_max) {
        time += dt;
        continue;
      }
      for (int n = 0; n < 4; ++n) {  // Newton: the length of the last step
        dt -= (gamma - gamma_max) / rate;
        gamma = gamma_0, rate = rate_0;
        step(dt, gamma, rate);
      }
      return {rate, time + dt, true};
    }
    return {rate, time, false};
  }
};

struct Steady {
  double v_before, duration;
  bool moves;
};

/// Bead after bead until the speed no longer changes; `impact` maps v before to v after.
template <class Impact>
Steady roll(const Line& line, double theta, Impact impact) {
  const double gamma = std::asin((1 + line.gap) / (1 + line.size_ratio));
  const double reach = line.radius * (1 + line.size_ratio);
  const Rolling rolling{line.gravity / reach / (1 + line.inertia), theta, gamma};
  double rate = 3 * std::sqrt(line.gravity / reach), before = 0;
  for (int bead = 0; bead < 1000; ++bead) {
    const auto exit = rolling.over_bead(rate);
    if (!exit.over) return {0, 0, false};
    if (std::abs(exit.rate - before) < 1e-11 * exit.rate) return {exit.rate * reach, exit.time, true};
    before = exit.rate;
    rate = impact(exit.rate * reach, gamma) / reach;
  }
  return {0, 0, false};
}

/// A ball that rolls at v meets a bead whose tangent is turned by 2γ, and rolls on it: nothing but the force
/// in the contact acts, so the angular momentum about the contact is the same before and after.
double stick(double v, double gamma, double inertia) {
  const double m = 1, R = 1, I = inertia * m * R * R, omega = v / R;
  const double before = m * R * v * std::cos(2 * gamma) + I * omega;
  return before / (m * R + I / R);
}
/// The same if the energy of tangential and rolling motion were kept, as printed.
double keep_energy(double v, double gamma, double inertia) {
  const double v_t = v * std::cos(2 * gamma);
  return std::sqrt((v_t * v_t + inertia * v * v) / (1 + inertia));
}

}  // namespace

TEST_CASE("the steady passage is what an integration of the motion settles to") {
  for (const double phi : {1.75, 2.25, 3.0, 6.0})
    for (const double gap : {0.0, 0.2})
      for (const double inertia : {0.4, 0.5}) {
        Line line{phi, gap};
        line.inertia = inertia;
        for (const Version version : {Version::printed, Version::corrected}) {
          const double theta = boundary_ab(line, version) + 0.03;
          CAPTURE(phi, gap, inertia, theta, version == Version::printed);
          const auto simulated = roll(line, theta, [&](double v, double gamma) {
            return version == Version::printed ? keep_energy(v, gamma, inertia) : stick(v, gamma, inertia);
          });
          const auto passage = steady_passage(line, theta, version);
          REQUIRE(simulated.moves);
          REQUIRE(passage);
          CHECK(passage->v_before == Approx(simulated.v_before).epsilon(1e-7));
          CHECK(passage->duration == Approx(simulated.duration).epsilon(1e-7));
          const double gamma = std::asin((1 + gap) / (1 + phi)), r = line.radius;
          const double way = version == Version::printed ? 2 * r * (1 + phi) * gamma : 2 * r * (1 + gap);
          CHECK(passage->mean_velocity == Approx(way / simulated.duration).epsilon(1e-7));
        }
      }
}

TEST_CASE("the corrected ratio for a solid sphere is (5 cos 2γ + 2)/7, and less than the printed one") {
  for (const double phi : {1.5, 2.25, 4.0, 10.0}) {
    const Line line{phi};
    const double gamma = largest_angle(line), printed = impact_ratio(line, Version::printed),
                 corrected = impact_ratio(line, Version::corrected);
    CHECK(corrected == Approx((5 * std::cos(2 * gamma) + 2) / 7).epsilon(1e-14));
    const double excess = 10.0 / 49 * std::pow(1 - std::cos(2 * gamma), 2);
    CHECK(printed * printed - corrected * corrected == Approx(excess).epsilon(1e-10));
  }
}

TEST_CASE(
    "the boundary AB is where a ball just gets over: a slower incline stops it, a steeper one does not") {
  for (const double phi : {1.75, 2.25, 3.0, 6.0})
    for (const Version version : {Version::printed, Version::corrected}) {
      const Line line{phi, 0.1};
      const double boundary = boundary_ab(line, version);
      CAPTURE(phi, boundary, version == Version::printed);
      CHECK_FALSE(steady_passage(line, boundary * (1 - 1e-9), version));
      CHECK(steady_passage(line, boundary * (1 + 1e-9), version));
      const auto moves = [&](double theta) {
        return roll(line, theta,
                    [&](double v, double gamma) {
                      return version == Version::printed ? keep_energy(v, gamma, 0.4) : stick(v, gamma, 0.4);
                    })
            .moves;
      };
      CHECK_FALSE(moves(boundary - 1e-4));
      CHECK(moves(boundary + 1e-4));
    }
}

TEST_CASE("on a disordered line the mean gap drives and the largest must be overcome") {
  // The energy balance written out: the steady speed of the mean gap, on the way to the larger γ_max, through
  // the impact there, is just enough to climb to γ = −θ.
  const double mean = 0.1, largest = 0.2;
  for (const double phi : {1.75, 3.0})
    for (const Version version : {Version::printed, Version::corrected}) {
      const Line line{phi, mean}, widest{phi, largest};
      const double theta = boundary_ab(line, largest, version);
      const double reach = line.centres(), g = line.gravity, m_eff = 1.4;
      const double gamma = largest_angle(line), wide = largest_angle(widest), e = impact_ratio(line, version);
      const double drop = g * reach * (std::cos(theta - gamma) - std::cos(theta + gamma));
      const double at_gamma = drop / (m_eff / 2 * (1 - e * e));  // v² in the steady state of the mean gap
      const double at_wide =
          at_gamma + 2 / m_eff * g * reach * (std::cos(theta + gamma) - std::cos(theta + wide));
      const double after = std::pow(impact_ratio(widest, version), 2) * at_wide;
      CHECK(m_eff / 2 * after == Approx(g * reach * (1 - std::cos(theta - wide))).epsilon(1e-10));
      CHECK(theta > boundary_ab(line, version));
      CHECK(boundary_ab(widest, version) == Approx(boundary_ab(widest, largest, version)).epsilon(1e-14));
    }
}

TEST_CASE("the linear formula is right to O(sin²γ): its error shrinks with 1/Φ² in v̄, times sqrt(c)") {
  for (const Version version : {Version::printed, Version::corrected}) {
    double before = 0;
    for (const double phi : {20.0, 40.0, 80.0, 160.0}) {
      const Line line{phi};
      const double theta = 0.05;
      const double exact =
          steady_passage(line, theta, version)->mean_velocity / std::sqrt(line.radius * line.gravity);
      const double error =
          std::abs(linear_velocity(line, theta, version) / std::sqrt(line.radius * line.gravity) - exact);
      if (before > 0)
        CHECK(before / error == Approx(4).margin(0.35));  // v̄ ∝ 1/√c, relative error c^{3/2}: O(c)
      before = error;
    }
  }
}

TEST_CASE("the two versions meet for large Φ, where the impact is weak") {
  const Line line{300};
  const auto printed = steady_passage(line, 0.02, Version::printed);
  const auto corrected = steady_passage(line, 0.02, Version::corrected);
  CHECK(corrected->mean_velocity / printed->mean_velocity == Approx(1).epsilon(1e-4));
}

TEST_CASE("the passage beyond the static angle, where no barrier is left, follows the integration too") {
  const Line line{3};
  const double theta = largest_angle(line) + 0.1;
  const auto simulated = roll(line, theta, [](double v, double gamma) { return stick(v, gamma, 0.4); });
  const auto passage = steady_passage(line, theta, Version::corrected);
  REQUIRE(passage);
  CHECK(passage->duration == Approx(simulated.duration).epsilon(1e-7));
}

TEST_CASE("the ball lifts off where the centrifugal force outweighs gravity's normal part") {
  for (const Version version : {Version::printed, Version::corrected})
    for (const double phi : {1.75, 3.0}) {
      const Line line{phi};
      const double theta = lift_off_angle(line, version);
      const auto passage = steady_passage(line, theta, version);
      REQUIRE(passage);
      CHECK(passage->least_contact == Approx(0).margin(1e-12));
      CHECK(steady_passage(line, theta - 0.01, version)->least_contact > 0);
    }
}

TEST_CASE("a line that the ball falls through, or no ball, is refused") {
  CHECK_THROWS_AS(largest_angle(Line{0.5, 0.6}), chute::WorkError);
  CHECK_THROWS_AS(largest_angle(Line{-1}), chute::WorkError);
  CHECK_THROWS_AS(boundary_ab(Line{3, 0.2}, 0.1, Version::printed), chute::WorkError);
}
