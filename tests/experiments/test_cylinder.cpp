#include <catch2/catch.hpp>

#include "experiments/pushed_cylinder.hpp"

using namespace chute;
using namespace chute::experiments;

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
    set_up.block = laws::RegularisedCoulomb{1000, 0.5, laws::MassScaling::none};
    set_up.plane = laws::RegularisedCoulomb{1000, 0.25, laws::MassScaling::none};
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
  set_up.block = laws::RegularisedCoulomb{1000, 0.5, laws::MassScaling::none};
  set_up.plane = laws::RegularisedCoulomb{1000, 0.25, laws::MassScaling::none};
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
