#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "common/error.hpp"
#include "grains.hpp"
#include "view/extent.hpp"

using namespace chute;
using Catch::Matchers::Contains;
using Eigen::Vector3d;

namespace extent_tests {

namespace {

view::Survey survey_of(const std::vector<read::GrainFrame>& frames, const view::FrameStyle& style = {}) {
  view::Surveyor surveyor(style);
  for (const auto& frame : frames) surveyor.see(frame);
  return surveyor.finish();
}

/// Grains of another program, evenly spread in a box.
read::GrainFrame spread(const Vector3d& size, int count, unsigned seed = 1) {
  auto frame = grains::one_disc();
  frame.x.clear(), frame.y.clear(), frame.z.clear(), frame.radius.clear();
  for (auto& array : frame.arrays) array.values.clear();
  frame.own = false, frame.units.clear(), frame.dimensions = size.z() > 0 ? 3 : 2;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < count; ++i)
    grains::add(frame, size.x() * unit(random), size.y() * unit(random), size.z() * unit(random), 0.5, 1, 0,
                i % 3);
  return frame;
}

const Eigen::Matrix3d straight = Eigen::Matrix3d::Identity();

}  // namespace

TEST_CASE("The view holds evenly spread grains whole, and leaves out one that was thrown far away") {
  view::Extent extent;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> along(0, 100), high(0, 10);
  double right = 0;
  for (int i = 0; i < 3000; ++i) {
    const double x = along(random);
    right = std::max(right, x + 0.5);
    extent.add({x, high(random), 0}, 0.5, false);
  }
  auto view = extent.view(1, straight, 0, false);
  CHECK(view.box.max().x() == right);
  CHECK(view.outside == 0);
  CHECK_FALSE(view.cropped);
  extent.add({50, 1e6, 0}, 0.5, false);
  extent.add({-1e7, 5, 0}, 0.5, false);
  view = extent.view(1, straight, 0, false);
  CHECK(view.box.max().y() <= 10.5);
  CHECK(view.box.min().x() >= -0.5);
  CHECK(view.outside == 2);
  CHECK(view.cropped);
  const auto all = extent.view(1, straight, 0, true);
  CHECK(all.outside == 0);
  CHECK(all.box.max().y() == 1e6 + 0.5);
}

TEST_CASE("The view has the bed below the grains, and more of it where the picture has room") {
  view::Extent extent;
  for (int i = 0; i < 200; ++i) extent.add({i + 0.5, 0, 0}, 0.5, true);
  for (int i = 0; i < 20; ++i) extent.add({50.0 + i, 1.5, 0}, 0.5, false);
  const auto view = extent.view(1, straight, 0, false);
  CHECK(view.box.min().y() == -0.5);
  CHECK(view.box.max().y() == 2);
  CHECK(view.box.min().x() > 48);
  CHECK(view.box.max().x() < 72);
  CHECK(view.outside == 0);
  const auto wide = extent.view(1, straight, 30, false);
  CHECK(wide.box.sizes().x() == Approx(30 * 2.5));
  CHECK(wide.box.center().x() == Approx(view.box.center().x()));
  // there is nothing above and below to be shown
  CHECK(extent.view(1, straight, 0.5, false).box.sizes().y() == Approx(2.5));
  // turned by a right angle, the bed stands on its side
  Eigen::Matrix3d turn = straight;
  turn.topLeftCorner<2, 2>() << 0, -1, 1, 0;
  const auto turned = extent.view(0, turn, 0, false);
  CHECK(turned.box.min().x() == Approx(-2));
  CHECK(turned.box.max().x() == Approx(0.5));
}

TEST_CASE("Up is what the style says, else against gravity, else across the thinnest spread") {
  const auto up = [](const read::GrainFrame& frame, const view::FrameStyle& style = {}) {
    return survey_of({frame}, style).up;
  };
  CHECK(up(spread({40, 30, 5}, 500)) == Vector3d(0, 0, 1));
  CHECK(up(spread({40, 5, 30}, 500)) == Vector3d(0, 1, 0));
  CHECK(up(spread({5, 40, 30}, 500)) == Vector3d(1, 0, 0));
  CHECK(up(spread({30, 30, 30}, 500)) == Vector3d(0, 0, 1));
  CHECK(up(spread({3, 3, 50}, 500)) == Vector3d(0, 0, 1));  // two directions are thin: neither is meant
  auto frame = spread({40, 5, 30}, 500);
  frame.gravity = {0.2, 0, -0.9};
  CHECK(up(frame) == Vector3d(0, 0, 1));
  frame.gravity = {0, 9.81, 0};
  CHECK(up(frame) == Vector3d(0, -1, 0));
  view::FrameStyle style;
  style.up = Vector3d(-3, 0, 4);
  CHECK((up(frame, style) - Vector3d(-0.6, 0, 0.8)).norm() < 1e-15);
  style.tilt = true;
  CHECK_THROWS_AS(style.check(), InputError);
}

TEST_CASE("In the plane, what is up stands upright in the picture") {
  auto frame = grains::one_disc();
  grains::add(frame, 10, 0, 0, 1, 2);
  view::FrameStyle style;
  CHECK(survey_of({frame}, style).turned.sizes().x() == Approx(12));
  for (const double sign : {1.0, -1.0}) {
    style.up = sign * Vector3d::UnitX();
    const auto survey = survey_of({frame}, style);
    CHECK(survey.turned.sizes().y() == Approx(12));
    CHECK((Eigen::Rotation2Dd(survey.turn) * style.up->head<2>() - Eigen::Vector2d(0, 1)).norm() < 1e-12);
  }
}

TEST_CASE("Species of all frames have one colour each, by name") {
  auto one = spread({10, 10, 0}, 6), two = one;
  view::FrameStyle style;
  style.color = "species";
  one.arrays.push_back({"species", 1, {0, 1, 0, 1, 0, 1}, {"sand", "glass"}});
  two.arrays.push_back({"species", 1, {0, 1, 2, 1, 0, 1}, {"glass", "clay", "sand"}});
  const auto survey = survey_of({one, two}, style);
  CHECK(survey.kind_names == std::vector<std::string>{"clay", "glass", "sand"});
  CHECK(survey.categories == std::vector<long long>{0, 1, 2});
  CHECK(survey.field.values(one) == std::vector<double>{2, 1, 2, 1, 2, 1});
  CHECK(survey.field.values(two) == std::vector<double>{1, 0, 2, 0, 1, 0});
  CHECK_FALSE(survey.other_kinds);

  style.color = "type";  // numbers, which the species name
  const auto numbers = survey_of({one, two}, style);
  CHECK(numbers.categories == std::vector<long long>{0, 1, 2});
  style.species = {"a", "b", "c"};
  CHECK(survey_of({one, two}, style).kind_names == style.species);
  style.species = {"a", "b"};
  CHECK_THROWS_WITH(survey_of({one, two}, style), Contains("2 names, but there are 3 kinds"));
  style.color = "velocity:x";
  CHECK_THROWS_WITH(survey_of({one, two}, style), Contains("not coloured by kinds"));
}

TEST_CASE("Of more words than colours, the most frequent are told apart") {
  auto frame = spread({10, 10, 0}, 0);
  read::PointArray species{"species", 1, {}};
  for (int word = 0; word < 12; ++word) {
    species.words.push_back(fmt::format("w{}", 100 - word));
    for (int k = 0; k <= word; ++k) {
      grains::add(frame, word, k, 0, 0.5);
      species.values.push_back(word);
    }
  }
  frame.arrays.push_back(species);
  view::FrameStyle style;
  style.color = "species";
  const auto survey = survey_of({frame}, style);
  CHECK(survey.other_kinds);
  CHECK(survey.kind_names.size() == view::kind_color_count);
  CHECK(survey.kind_names.front() == "w89");
  CHECK(std::isnan(survey.field.values(frame)[0]));
}

TEST_CASE("Without speeds, a foreign frame is coloured by its species, and our own types are none") {
  auto frame = spread({10, 10, 0}, 6);
  std::erase_if(frame.arrays, [](const auto& a) { return a.name == "velocity"; });
  CHECK(survey_of({frame}).categories == std::vector<long long>{0, 1, 2});
  frame.own = true;
  CHECK(survey_of({frame}).field.is_none());
  view::FrameStyle style;
  style.color = "type";
  CHECK(survey_of({frame}, style).categories.empty());
}

}  // namespace extent_tests
