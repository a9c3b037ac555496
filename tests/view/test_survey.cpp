#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "common/error.hpp"
#include "grains.hpp"

using namespace chute;

namespace {

view::Survey survey_of(const std::vector<read::GrainFrame>& frames, const view::FrameStyle& style = {}) {
  view::Surveyor surveyor(style);
  for (const auto& frame : frames) surveyor.see(frame);
  return surveyor.finish();
}

}  // namespace

TEST_CASE("A run's colour range is that of all its moving grains, without the few fastest") {
  std::vector<read::GrainFrame> frames(2, grains::one_disc());
  for (int i = 0; i < 1000; ++i) grains::add(frames[1], i, 0, 0, 0.5, 0.003 * i);
  grains::add(frames[1], 0, 5, 0, 0.5, 500);
  grains::add(frames[1], 0, 5, 0, 0.5, 1e6, 0, 0);  // the bed does not count
  const auto s = survey_of(frames);
  CHECK(s.low == 0);
  CHECK(s.high == Approx(3));
  CHECK(s.exceeds_high);
  CHECK_FALSE(s.exceeds_low);
  CHECK(s.has_fixed);
  CHECK_FALSE(s.diverging);
  CHECK(s.bounds[1] == Approx(999.5));
  CHECK(s.diameter == Approx(1).epsilon(0.01));
}

TEST_CASE("Values of both signs get a range that is the same on both sides") {
  auto frame = grains::one_disc();
  grains::add(frame, 3, 0, 0, 1, -3.9);
  view::FrameStyle style;
  style.color = "velocity:x";
  auto s = survey_of({frame}, style);
  CHECK(s.low == Approx(-4));
  CHECK(s.high == Approx(4));
  CHECK(s.diverging);
  style.range = {-1, 2};
  s = survey_of({frame}, style);
  CHECK(s.low == -1);
  CHECK(s.high == 2);
  CHECK(s.exceeds_low);
}

TEST_CASE("A range is never empty") {
  auto frame = grains::one_disc();
  for (const double v : {0.0, 7.0, -7.0, 1e-9}) {
    frame.arrays[3].values[0] = v;
    for (const char* color : {"velocity", "velocity:x", "id", "radius"}) {
      view::FrameStyle style;
      style.color = color;
      const auto s = survey_of({frame}, style);
      CHECK(s.high > s.low);
    }
  }
}

TEST_CASE("The slope comes from gravity") {
  CHECK(survey_of({grains::small_chute()}).slope == Approx(20 * std::numbers::pi / 180));
  const auto solid = survey_of({grains::cube(2)});
  CHECK(solid.dimensions == 3);
  CHECK(solid.up_axis == 2);
  CHECK(solid.slope == Approx(std::atan2(0.3, 0.95)));
}

TEST_CASE("All times are written with the same number of decimals") {
  auto frame = grains::one_disc();
  const auto decimals = [&](std::vector<double> times) {
    std::vector<read::GrainFrame> frames;
    for (double t : times) frame.time = t, frames.push_back(frame);
    return survey_of(frames).time_decimals;
  };
  CHECK(decimals({0, 1, 2}) == 0);
  CHECK(decimals({0, 0.5, 1}) == 1);
  CHECK(decimals({0, 0.1, 0.30000000000000004}) == 1);
  CHECK(decimals({0.125, 1}) == 3);
  CHECK(decimals({std::numbers::pi, 1}) == 4);
}

TEST_CASE("No frames, no survey") {
  view::Surveyor surveyor({});
  CHECK_THROWS_AS(surveyor.finish(), InputError);
}
