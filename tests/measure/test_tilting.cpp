// Angles of start and stop, from series that are made so that they are known.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "measure/tilting.hpp"

namespace tilting_tests {
using namespace chute;
using namespace chute::measure;

namespace {

constexpr double degree = std::numbers::pi / 180;

/// A flow that moves, v_x = 1, while `moves(t)`; rows every half unit of time, for 600.
template <class Moves>
TurningAngles found(const Tilt& tilt, const Moves& moves) {
  std::vector<double> time, v_x;
  for (int k = 0; k <= 1200; ++k) time.push_back(0.5 * k), v_x.push_back(moves(0.5 * k) ? 1.0 : 0.0);
  return turning_angles(tilt, 1, time, v_x);
}

}  // namespace

TEST_CASE("a flow starts where it moves for good, and not where it jerks") {
  const Tilt up{10 * degree, 40 * degree, 0.1 * degree, 1};
  const auto angles =
      found(up, [](double t) { return t >= 120 || (t > 40 && t < 48) || (t > 70 && t < 79); });
  REQUIRE(angles.start);
  CHECK(*angles.start == Approx(22).epsilon(1e-12));
  CHECK(!angles.stop);
}

TEST_CASE(
    "a flow stops where it rests for good, and did not start in a run that it moved through from the begin") {
  const Tilt down{30 * degree, 0, 0.1 * degree, 1};
  const auto angles = found(down, [](double t) { return t < 150 && !(t > 90 && t < 99); });
  CHECK(!angles.start);
  REQUIRE(angles.stop);
  CHECK(*angles.stop == Approx(15).epsilon(1e-12));
}

TEST_CASE("a flow that is tilted down and up again stops on the way down and starts on the way up") {
  Tilt tilt{30 * degree, 10 * degree, 0.1 * degree, 1};
  tilt.then = 40 * degree;  // at 10 degrees after 200
  CHECK(tilt.angle(100) == Approx(20 * degree));
  CHECK(tilt.angle(200) == Approx(10 * degree));
  CHECK(tilt.angle(350) == Approx(25 * degree));
  CHECK(tilt.angle(1000) == Approx(40 * degree));
  const auto angles = found(tilt, [](double t) { return t < 150 || (t > 210 && t < 215) || t >= 340; });
  REQUIRE(angles.stop);
  CHECK(*angles.stop == Approx(15).epsilon(1e-12));
  REQUIRE(angles.start);
  CHECK(*angles.start == Approx(24).epsilon(1e-12));
}

TEST_CASE("what does not last until the end of the run tells nothing") {
  const Tilt up{10 * degree, 70 * degree, 0.1 * degree, 1};
  CHECK(!found(up, [](double) { return false; }).start);
  CHECK(!found(up, [](double t) { return t > 592; }).start);
  const auto both = found(up, [](double t) { return t >= 100 && t < 300; });
  CHECK(*both.start == Approx(20).epsilon(1e-12));
  CHECK(*both.stop == Approx(40).epsilon(1e-12));
}

}  // namespace tilting_tests
