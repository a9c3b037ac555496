#include <catch2/catch.hpp>

#include "experiments/pushed_cylinder.hpp"
#include "experiments/rigid_cylinder.hpp"

using namespace chute;
using namespace chute::experiments;

namespace cylinder_tests {

TEST_CASE("(3.26) to (3.31) solve the equations of motion and respect Coulomb's law") {
  for (const double push : {0.05, 0.2, 0.4, 0.7, 0.8, 2.0}) {
    const auto s = steady_cylinder(push, 0.5, 0.25);
    CHECK(push - s.plane_force == Approx(s.acceleration));                            // m = 1
    CHECK((s.plane_force - s.block_force) / 0.5 == Approx(s.spin_up).margin(1e-12));  // I = 1/2
    CHECK(s.block_force <= Approx(0.5 * push));
    CHECK(s.plane_force <= Approx(0.25 * (1 + s.block_force)));
  }
  CHECK(std::isnan(steady_cylinder(0.5, 0.5, 0.25).plane_force));  // between 6/13 and 2/3 both slip
}

TEST_CASE("The viscous law finds every steady state") {
  for (const double force : {0.1, 0.3, 0.8, 1.5}) {
    PushedCylinder set_up;
    set_up.block = laws::RegularisedCoulomb{1000, 0.5, laws::MassScaling::none, {}};
    set_up.plane = laws::RegularisedCoulomb{1000, 0.25, laws::MassScaling::none, {}};
    const auto end = push(set_up, {{force, 0.03}}, 1000).back();
    const auto theory = steady_cylinder(force, 0.5, 0.25);
    CHECK(end.plane_force == Approx(theory.plane_force).epsilon(1e-5));
    CHECK(end.block_force == Approx(theory.block_force).epsilon(1e-5));
    CHECK(end.acceleration == Approx(theory.acceleration).epsilon(1e-5));
    CHECK(end.spin_up == Approx(theory.spin_up).margin(1e-5));
  }
}

TEST_CASE("Between the critical forces both contacts slip") {
  // F_p = 0.55: block friction μ_b F_p, plane friction μ_p (1 + μ_b F_p)
  PushedCylinder set_up;
  set_up.block = laws::RegularisedCoulomb{1000, 0.5, laws::MassScaling::none, {}};
  set_up.plane = laws::RegularisedCoulomb{1000, 0.25, laws::MassScaling::none, {}};
  const auto end = push(set_up, {{0.55, 0.1}}, 1000).back();
  CHECK(end.block_force == Approx(0.275));
  CHECK(end.plane_force == Approx(0.25 * 1.275));
}

TEST_CASE("The uncapped spring lets go of the wrong force only after the way back") {
  // It is stretched by v²/2a of the first push and the slip until rolling; the time to unwind follows by
  // hand: slip 0.02·0.4667 = 0.00933 at the change, decelerating by 0.425, so it turns at t = 0.02 + 0.02196
  // and has come back over ζ = 9.33e-5 + 1.025e-4 after another √(2ζ/0.425) = 0.0304.
  PushedCylinder set_up;
  set_up.block = laws::CundallStrack{{2e7, 0, 0, 0}, {0.5, false}};
  set_up.plane = laws::CundallStrack{{2e7, 0, 0, 0}, {0.25, false}};
  double turned = 0;
  for (const auto& s : push(set_up, {{0.8, 0.02}, {0.2, 0.06}}, 10))
    if (turned == 0 && s.time > 0.03 && s.plane_force < 0.2) turned = s.time;
  WARN("the spring lets go at t = " << turned);
  CHECK(turned == Approx(0.0723).epsilon(0.01));
}

TEST_CASE("Contact dynamics finds every steady state to 1e-6, by both of its solvers") {
  for (const bool exact : {false, true})
    for (const double force : {0.1, 0.2, 0.3, 0.4, 0.7, 0.8, 1.5}) {
      RigidCylinder set_up;
      set_up.exact = exact;
      const auto theory = steady_cylinder(force, 0.5, 0.25);
      for (const auto& s : push(set_up, {{force, 0.01}})) {  // from rest it is there at once
        CHECK(s.plane_force == Approx(theory.plane_force).epsilon(1e-6));
        CHECK(s.block_force == Approx(theory.block_force).epsilon(1e-6));
        CHECK(s.acceleration == Approx(theory.acceleration).epsilon(1e-6));
        CHECK(s.spin_up == Approx(theory.spin_up).margin(1e-6));
      }
    }
}

TEST_CASE("By contact dynamics both contacts slip between the critical forces") {
  for (const double force : {0.48, 0.55, 0.65}) {  // from 6/13 to 2/3
    const auto end = push(RigidCylinder{}, {{force, 0.05}}).back();
    CHECK(end.block_force == Approx(0.5 * force).epsilon(1e-9));
    CHECK(end.plane_force == Approx(0.25 * (1 + 0.5 * force)).epsilon(1e-9));
  }
}

TEST_CASE("A rigid cylinder that is pushed less goes over to rolling when its slip has gone, by hand") {
  // F_p = 0.8 for 0.02: no spin, slip 0.02 (0.8 - 1/3). Then with 0.2 both contacts slide: F_s^b = 0.1, F_s^p = 0.275, and
  // the slip falls by (0.275 - 0.2) + 2 (0.275 - 0.1) = 0.425 a unit of time until the cylinder rolls.
  const double slip = 0.02 * (0.8 - 1.0 / 3), rolls = 0.02 + slip / 0.425;
  for (const double h : {1e-4, 0.02 / 541}) {
    RigidCylinder set_up;
    set_up.time_step = h;
    const auto states = push(set_up, {{0.8, 0.02}, {0.2, 0.04}});
    for (const auto& s : states) {
      if (s.time < 0.02 - h || std::abs(s.time - rolls) < 1.5 * h || std::abs(s.time - 0.02) < 1.5 * h)
        continue;
      const double plane = s.time < 0.02 ? 1.0 / 3 : s.time < rolls ? 0.275 : 2.0 / 15;
      CHECK(s.plane_force == Approx(plane).epsilon(1e-6));
      if (s.time > rolls) CHECK(s.velocity == Approx(s.spin).epsilon(1e-9));
    }
  }
}

}  // namespace cylinder_tests
