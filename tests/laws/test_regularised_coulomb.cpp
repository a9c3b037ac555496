#include <catch2/catch.hpp>

#include "laws/list.hpp"

using namespace chute;
using namespace chute::laws;

namespace {
const RegularisedCoulomb law{100, 0.5, MassScaling::none, {}};
}

// (2.10): F_s = −min(γ_s |v_s|, μ |F_n|) v_s / |v_s|
TEST_CASE("friction is viscous below Coulomb's limit and constant above it") {
  for (const double sign : {1.0, -1.0}) {
    CHECK(law(Vec<1>{{sign * 0.01}}, 4, 1)[0] == Approx(-sign * 1));
    CHECK(law(Vec<1>{{sign * 0.02}}, 4, 1)[0] == Approx(-sign * 2));  // just at the limit
    CHECK(law(Vec<1>{{sign * 5.0}}, 4, 1)[0] == Approx(-sign * 2));
    CHECK(law(Vec<1>{{sign * 5.0}}, -4, 1)[0] == Approx(-sign * 2));  // the limit takes |F_n|
  }
  CHECK(law(Vec<1>{{0}}, 4, 1)[0] == 0);
  CHECK(law(Vec<1>{{1}}, 0, 1)[0] == 0);
}

TEST_CASE("in 3D friction opposes the slip, with the strength of 2D") {
  for (const double speed : {1e-3, 0.019, 0.021, 3.0}) {
    const Vec<3> direction{{2.0 / 7, -3.0 / 7, 6.0 / 7}};
    const auto force = law(speed * direction, 4, 1);
    const double flat = law(Vec<1>{{speed}}, 4, 1)[0];
    for (int axis = 0; axis < 3; ++axis) CHECK(force[axis] == Approx(flat * direction[axis]));
  }
  const auto none = law(Vec<3>{}, 0, 1);
  CHECK(none == Vec<3>{});  // neither slip nor force: not 0/0
}

TEST_CASE("friction takes energy, never gives it") {
  for (const double slip : {-2.0, -1e-4, 0.0, 0.3})
    for (const double normal : {-1.0, 0.0, 7.0}) CHECK(law(Vec<1>{{slip}}, normal, 1)[0] * slip <= 0);
}

TEST_CASE("γ_s scales with the reduced mass where asked") {
  for (const auto scaling : {MassScaling::damping, MassScaling::both}) {
    const RegularisedCoulomb scaled{100, 0.5, scaling, {}};
    CHECK(scaled(Vec<1>{{0.01}}, 40, 0.25)[0] == Approx(-0.25));
    CHECK(scaled(Vec<1>{{10}}, 40, 0.25)[0] == Approx(-20));  // the limit does not
  }
}

TEST_CASE("without friction there is no tangential force") {
  CHECK(Frictionless{}(Vec<1>{{3}}, 4, 1)[0] == 0);
  CHECK(Frictionless{}(Vec<3>{{3, 2, 1}}, 4, 1) == Vec<3>{});
}

// m_eff/(7/2 γ_s) is the time in which a slip dies away; over n steps implicitly, no less than n steps.
TEST_CASE("a stiff viscosity takes the slip away within the relaxation steps, a soft one as ever") {
  constexpr double dt = 1e-6, m = 5e-4, far_below_coulomb = 1e9;
  ContactLaws contact{SpringDashpot{}, RegularisedCoulomb{1000, 0.13, MassScaling::none, 12.0}};
  know_time_step(contact, dt);
  const auto& stiff = std::get<RegularisedCoulomb>(contact.shear);
  const double rate = -3.5 * stiff(Vec<1>{{1}}, far_below_coulomb, m)[0] / m;
  CHECK(rate * dt < 1.0 / 12);
  CHECK(rate * dt > 0.9 / 12);
  CHECK(stiff(Vec<1>{{1}}, 2, m)[0] == Approx(-0.26));  // the limit is Coulomb's
  auto soft = stiff, plain = stiff;
  soft.viscosity = plain.viscosity = 1e-3, plain.relaxation_steps.reset();
  CHECK(soft(Vec<1>{{1}}, 2, m)[0] == Approx(plain(Vec<1>{{1}}, 2, m)[0]).epsilon(1e-3));
  // Without the option nothing changes, to the last bit, whether the step is known or not.
  auto unknown = plain;
  unknown.time_step = 0;
  for (const double slip : {1e-3, 0.1, 7.0})
    CHECK(plain(Vec<1>{{slip}}, 2, m)[0] == unknown(Vec<1>{{slip}}, 2, m)[0]);
}
