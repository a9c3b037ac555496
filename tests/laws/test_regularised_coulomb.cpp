#include <catch2/catch.hpp>

#include "laws/list.hpp"

using namespace chute;
using namespace chute::laws;

namespace {
const RegularisedCoulomb law{100, 0.5, MassScaling::none};
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
    const RegularisedCoulomb scaled{100, 0.5, scaling};
    CHECK(scaled(Vec<1>{{0.01}}, 40, 0.25)[0] == Approx(-0.25));
    CHECK(scaled(Vec<1>{{10}}, 40, 0.25)[0] == Approx(-20));  // the limit does not
  }
}

TEST_CASE("without friction there is no tangential force") {
  CHECK(Frictionless{}(Vec<1>{{3}}, 4, 1)[0] == 0);
  CHECK(Frictionless{}(Vec<3>{{3, 2, 1}}, 4, 1) == Vec<3>{});
}
