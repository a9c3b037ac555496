#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "common/error.hpp"
#include "grains.hpp"

using namespace chute;

namespace survey_tests {

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
  CHECK(s.bounds.max().x() == Approx(999.5));
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

TEST_CASE("Kinds are told apart, numbers are ordered") {
  auto frame = grains::cube(3);
  read::PointArray material{"material", 1, {}};
  for (std::size_t i = 0; i < frame.size(); ++i) material.values.push_back(i % 2 ? 7 : 3);
  frame.arrays.push_back(material);
  view::FrameStyle style;
  style.color = "material";
  CHECK(survey_of({frame}, style).categories == std::vector<long long>{3, 7});
  CHECK(survey_of({frame}).categories.empty());
  for (std::size_t i = 0; i < frame.size(); ++i) frame.arrays.back().values[i] = static_cast<double>(i);
  CHECK(survey_of({frame}, style).categories.empty());  // too many to tell apart: a bar
}

TEST_CASE("A path has no jumps at periodic ends, and is smooth") {
  std::vector<read::GrainFrame> frames;
  view::FrameStyle style;
  style.camera.follow = view::Follow{};
  for (int i = 0; i < 30; ++i) {
    auto frame = grains::one_disc();
    frame.domain = {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(10, 0, 0)};
    frame.time = 4.0 * i;  // at speed 2, 8 of 10: the nearest image would be 2 behind
    frame.x[0] = std::fmod(8.0 * i + (i % 2 ? 0.2 : -0.2) + 1, 10.0);
    frames.push_back(frame);
  }
  const auto path = survey_of(frames, style).path;
  REQUIRE(path.size() == 30);
  for (std::size_t i = 6; i < 24; ++i) CHECK(path[i].x() - path[i - 1].x() == Approx(8).margin(0.1));
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
  CHECK(decimals({0, 0.5 + 4e-5, 1}) == 1);  // frames that are not a whole number of steps apart
  CHECK(decimals({0, 0.003, 0.006}) == 3);
  CHECK(decimals({0, 1, 1.001}) == 3);
}

TEST_CASE("No frames, no survey") {
  view::Surveyor surveyor({});
  CHECK_THROWS_AS(surveyor.finish(), InputError);
}

TEST_CASE(
    "Spins have one sign in pictures and tables: rolling downhill is positive, in chute's own files of a plane") {
  auto frame = grains::one_disc();
  frame.arrays.push_back({"angular_velocity", 3, {0, 0, -3}});  // clockwise: it rolls towards +x
  frame.own = true;
  for (const char* name : {"angular_velocity", "angular_velocity:z"})
    CHECK(view::find_field(name, frame).values(frame)[0] == 3);
  CHECK(view::find_field("angular_velocity", frame).title("SI").find("omega") != std::string::npos);
  frame.own = false;  // another program's numbers stay what they are
  CHECK(view::find_field("angular_velocity", frame).values(frame)[0] == -3);
  frame.own = true, frame.dimensions = 3;
  CHECK(view::find_field("angular_velocity:z", frame).values(frame)[0] == -3);
}

}  // namespace survey_tests
