// Cameras that move, grains that are seen through, chains whose colours tell forces, copies as far as is asked.
#include <catch2/catch.hpp>
#include <cmath>

#include "common/error.hpp"
#include "grains.hpp"
#include "image/compare.hpp"
#include "view/camera_path.hpp"

using namespace chute;
using Eigen::Vector3d;

namespace camera_tests {

namespace {

view::FrameStyle in_plane() {
  view::FrameStyle style;
  style.width = 240, style.height = 160;
  return style;
}

view::CameraKey window_at(double time, double x0, double x1, double y0, double y1) {
  view::CameraKey key;
  key.time = time, key.camera.window = {x0, x1, y0, y1};
  return key;
}

view::Survey survey_of(const read::GrainFrame& frame, const view::FrameStyle& style, double force = 0) {
  view::Surveyor surveyor(style);
  surveyor.see(frame);
  for (int k = 0; force > 0 && k < 5; ++k) surveyor.see_force(force);
  return surveyor.finish();
}

}  // namespace

TEST_CASE(
    "A camera's way goes through its keys, smoothly, beyond none of them, and begins and ends at rest") {
  const std::vector<double> t{0, 1, 3, 4, 7}, y{2, 5, 5, 1, 0.5};
  for (std::size_t k = 0; k < t.size(); ++k) CHECK(view::smooth_through(t, y, t[k]) == Approx(y[k]));
  CHECK(view::smooth_through(t, y, -3) == 2);
  CHECK(view::smooth_through(t, y, 30) == 0.5);
  constexpr double h = 1e-4;
  const auto slope = [&](double at) {
    return (view::smooth_through(t, y, at + h) - view::smooth_through(t, y, at)) / h;
  };
  for (std::size_t k = 0; k + 1 < t.size(); ++k) {
    const double low = std::min(y[k], y[k + 1]), high = std::max(y[k], y[k + 1]);
    for (double at = t[k]; at <= t[k + 1]; at += 0.01) {
      const double value = view::smooth_through(t, y, at);
      CHECK((value >= low - 1e-12 && value <= high + 1e-12));
    }
    CHECK(slope(t[k] - h) == Approx(slope(t[k])).margin(0.02));  // no kink
  }
  CHECK(slope(0) == Approx(0).margin(1e-3));
  CHECK(slope(7 - h) == Approx(0).margin(1e-3));
}

TEST_CASE("Zooms are passed in even steps of size") {
  view::FrameStyle style;
  for (const double time : {0.0, 2.0}) {
    view::CameraKey key;
    key.time = time, key.camera.zoom = time == 0 ? 1 : 4, key.camera.azimuth = 90 * time;
    style.camera_keys.push_back(key);
  }
  CHECK(view::camera_at(style, 1).zoom == Approx(2));
  CHECK(view::camera_at(style, 1).azimuth == Approx(90));
}

TEST_CASE("At the time of a key the picture is that of a camera that stands there") {
  const auto frame = grains::small_chute();
  auto style = in_plane(), first = style, last = style;
  style.camera_keys = {window_at(0, 0, 6, 0, 4), window_at(10, 2, 5, 1, 3)};
  first.camera.window = style.camera_keys[0].camera.window;
  last.camera.window = style.camera_keys[1].camera.window;
  view::FrameRenderer renderer(style, survey_of(frame, style));
  const auto draw = [&](double time) { return renderer.draw({.frame = frame, .time = time}); };
  const auto still = [&](const view::FrameStyle& of, double time) {
    view::FrameRenderer stands(of, survey_of(frame, of));
    return stands.draw({.frame = frame, .time = time});
  };
  CHECK(image::compare(draw(10), still(last, 10)).differing == 0);
  CHECK(image::compare(draw(0), still(first, 0)).differing == 0);  // and back
  CHECK(image::compare(draw(-5), still(first, -5)).differing == 0);
  CHECK(image::compare(draw(5), draw(0)).differing > 1000);
}

TEST_CASE("A camera that goes around sees grains at one distance all the way") {
  // a ball in the middle of a long box: its size must not change while the box is seen from its side and from its end
  read::GrainFrame frame = grains::cube(1);
  frame.x.clear(), frame.y.clear(), frame.z.clear(), frame.radius.clear();
  for (auto& array : frame.arrays) array.values.clear();
  for (const double x : {-10.0, 0.0, 10.0}) grains::add(frame, x, 0, 0, 1);
  auto style = in_plane();
  style.width = 1200, style.height = 800;
  style.furniture = false, style.color = "none", style.spin = false, style.camera.all = true;
  style.background = view::Background::transparent, style.cuts = {{0, true, 5}, {0, false, -5}};
  for (const double time : {0.0, 1.0}) {
    view::CameraKey key;
    key.time = time, key.camera.azimuth = 180 * time, key.camera.elevation = 20;
    style.camera_keys.push_back(key);
  }
  view::FrameRenderer renderer(style, survey_of(frame, style));
  const auto area = [&](double time) {
    const auto picture = renderer.draw({.frame = frame, .time = time});
    double sum = 0;
    for (std::size_t i = 3; i < picture.rgba.size(); i += 4) sum += picture.rgba[i] / 255.0;
    return sum;
  };
  const double side = area(0);
  CHECK(side > 50);
  for (const double time : {0.2, 0.5, 0.7, 1.0}) CHECK(area(time) == Approx(side).epsilon(0.02));
}

TEST_CASE("Camera keys that make no way are refused") {
  auto style = in_plane();
  style.camera_keys = {window_at(1, 0, 1, 0, 1), window_at(1, 0, 2, 0, 2)};
  CHECK_THROWS_WITH(style.check(), Catch::Contains("a time of its own"));
  style.camera_keys[1] = {};
  style.camera_keys[1].time = 2;
  CHECK_THROWS_WITH(style.check(), Catch::Contains("all are parts of a plane"));
  style.camera_keys = {};
  style.opacity = 0;
  CHECK_THROWS_WITH(style.check(), Catch::Contains("opacity 0"));
}

TEST_CASE("Through a grain of glass one sees what is behind it, in the share that it lets through") {
  read::GrainFrame frame = grains::cube(1);
  frame.x.clear(), frame.y.clear(), frame.z.clear(), frame.radius.clear();
  for (auto& array : frame.arrays) array.values.clear();
  grains::add(frame, 0, 0, 0, 1);
  grains::add(frame, 3, 0, 0, 1);
  view::FrameStyle style;
  style.width = 200, style.height = 150, style.furniture = false, style.color = "none", style.spin = false;
  style.chains = true;
  const read::ForceLink link{{0, 0, 0}, {3, 0, 0}, 1};
  const auto draw = [&](const view::FrameStyle& of, bool grains_too) {
    auto own = of;
    if (!grains_too) own.cuts = {{2, true, 0.5}};  // none of the grains' centres, but …
    auto shown = frame;
    if (!grains_too)
      for (double& r : shown.radius) r = 1e-6;
    view::FrameRenderer renderer(own, survey_of(frame, of, 1));
    return renderer.draw({.frame = shown, .links = std::span(&link, 1)});
  };
  auto glass = style;
  glass.opacity = 0.3;
  auto solid = glass;
  solid.opacity = 0.999999;
  const auto whole = draw(solid, true), rods = draw(solid, false), seen = draw(glass, true);
  std::size_t inside = 0;
  double worst = 0;
  for (std::size_t i = 0; i < seen.rgba.size(); ++i) {
    worst = std::max(worst, std::abs(seen.rgba[i] - (0.3 * whole.rgba[i] + 0.7 * rods.rgba[i])));
    inside += std::abs(whole.rgba[i] - rods.rgba[i]) > 60;
  }
  CHECK(worst <= 1.5);  // rounded twice
  CHECK(inside > 1000);
}

TEST_CASE("Chains coloured by their forces have the bar's colours") {
  auto frame = grains::one_disc();
  auto style = grains::bare(200);
  style.chains = true, style.color = "chains", style.spin = false, style.range = {0, 4};
  const auto survey = survey_of(frame, style, 4);
  CHECK(survey.field.has_bar());
  CHECK(survey.field.title("SI") == "$F_n$ (N)");
  view::FrameRenderer renderer(style, survey);
  const view::ColorMap map("viridis");
  for (const double force : {1.0, 3.0, 4.0}) {
    const read::ForceLink link{{-1.5, 0.5, 0}, {1.5, 0.5, 0}, force};
    const auto& picture = renderer.draw({.frame = frame, .links = std::span(&link, 1)});
    const auto* pixel = picture.pixel(100, 75);  // y = 0.5
    const auto wanted = map.at(force / 4);
    CHECK(pixel[0] == Approx(255 * wanted.r).margin(2));
    CHECK(pixel[1] == Approx(255 * wanted.g).margin(2));
    CHECK(pixel[2] == Approx(255 * wanted.b).margin(2));
  }
  auto by_itself = style;
  by_itself.range.reset();
  CHECK(survey_of(frame, by_itself, 3.7).low == 0);
  CHECK(survey_of(frame, by_itself, 3.7).high == Approx(4));
}

TEST_CASE("Copies reach as far as is asked") {
  auto frame = grains::one_disc();
  frame.domain = {Vector3d(-2, 0, 0), Vector3d(2, 0, 0)};
  frame.radius[0] = 0.5;
  view::FrameStyle style;
  style.width = 800, style.height = 100, style.furniture = false, style.copies = true, style.color = "none";
  style.background = view::Background::transparent, style.spin = false;
  const auto discs = [&](double reach) {
    style.copy_reach = reach;
    const auto picture = grains::picture(frame, style);
    int count = 0;
    bool inside = false;
    for (int x = 0; x < picture.width; ++x) {
      const bool covered = picture.pixel(x, picture.height / 2)[3] > 5;
      count += covered && !inside;
      inside = covered;
    }
    return count;
  };
  CHECK(discs(0.16) == 1);
  CHECK(discs(1.2) == 3);
  CHECK(discs(2.9) == 7);  // the middles of the outer ones lie 2.5 periods beyond the end
}

}  // namespace camera_tests
