#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "grains.hpp"
#include "view/hidden.hpp"
#include "view/offscreen.hpp"
#include "view/solid_scene.hpp"

using namespace chute;

namespace {

view::FrameStyle small() {
  view::FrameStyle style;
  style.width = 160, style.height = 120, style.furniture = false;
  style.background = view::Background::transparent;
  return style;
}

}  // namespace

TEST_CASE("A sphere is seen as large as it is, where the eye says") {
  view::OffscreenContext context(400, 300);
  view::SolidScene scene(context, 200, 150, {0, 0, 0}, 0);
  view::Eye eye;
  eye.centre = {1, 2, 3}, eye.towards = {0, -1, 0}, eye.up = {0, 0, 1};
  eye.distance = 50, eye.focal = 1500, eye.at = {80, 90};
  scene.look(eye, {40, 60});
  image::Image image;
  const view::Ball ball{{1.5, 2, 3.25}, 1, {1, 1, 1}};
  scene.draw({ball}, {}, image);
  double area = 0, x = 0, y = 0;
  for (int j = 0; j < 150; ++j)
    for (int i = 0; i < 200; ++i) {
      const double cover = image.pixel(i, j)[3] / 255.0;
      area += cover, x += cover * (i + 0.5), y += cover * (j + 0.5);
    }
  CHECK(std::sqrt(area / std::numbers::pi) == Approx(30).epsilon(0.01));  // 1500 / 50
  const auto seen = eye.seen(ball.centre);
  CHECK(seen.x == Approx(80 + 15));
  CHECK(seen.y == Approx(90 - 7.5));
  CHECK(x / area == Approx(seen.x).margin(0.3));
  CHECK(y / area == Approx(seen.y).margin(0.3));
}

TEST_CASE("The box of a run fills the place that it is given") {
  const std::array<double, 6> box{0, 10, 0, 5, -1, 4};
  const plot::Rect rect{20, 30, 220, 130};
  const auto eye = view::Eye::on_box(box, {0.5, -0.7, 0.5}, {0, 0, 1}, rect, 1);
  plot::Rect seen = plot::Rect::nothing();
  for (double x : {0., 10.})
    for (double y : {0., 5.})
      for (double z : {-1., 4.}) seen.include(eye.seen({x, y, z}));
  CHECK(seen.centre().x == Approx(120).margin(0.01));
  CHECK(seen.centre().y == Approx(80).margin(0.01));
  CHECK(std::max(seen.width() / 200, seen.height() / 100) == Approx(1).margin(1e-6));
}

TEST_CASE("Leaving out hidden balls changes no pixel") {
  const auto frame = grains::cube(14);
  const auto shake = [](std::size_t i, double by) {
    return 0.6 * std::fmod(static_cast<double>(i) * by, 1.0);
  };
  std::vector<view::Ball> balls;
  for (std::size_t i = 0; i < frame.size(); ++i)
    balls.push_back(
        {{frame.x[i] + shake(i, 0.618), frame.y[i] + shake(i, 0.414), frame.z[i] + shake(i, 0.732)},
         frame.radius[i] * (1 + shake(i, 0.236)),
         {0.1 + static_cast<double>(i % 7) * 0.1, static_cast<double>(i % 5) * 0.2, 0.5}});
  view::OffscreenContext context(800, 600);
  view::SolidScene scene(context, 400, 300, {1, 1, 1}, 1);
  for (const view::Vector towards :
       {view::Vector{0.5, -0.7, 0.5}, {0, 0, 1}, {1, 0, 0.1}, {-0.3, 0.9, 0.2}}) {
    const auto eye = view::Eye::on_box({-1, 15, -1, 15, -1, 15}, towards, {0, 0, 1}, {0, 0, 400, 300}, 1.2);
    scene.look(eye, {0.4 * eye.distance, 1.6 * eye.distance});
    image::Image all, some;
    scene.draw(balls, {}, all);
    const auto left = view::visible(balls, eye, 400, 300);
    CHECK(left.size() < balls.size() * 2 / 3);
    scene.draw(left, {}, some);
    CHECK(all == some);
  }
}

TEST_CASE("Spheres, rods and occlusion draw, the same every time") {
  const auto frame = grains::cube(5);
  auto style = small();
  const auto plain = grains::picture(frame, style);
  CHECK_FALSE(image::is_blank(plain));
  CHECK(plain == grains::picture(frame, style));
  CHECK(plain.pixel(0, 0)[3] == 0);
  CHECK(plain.pixel(80, 60)[3] == 255);
  for (bool view::FrameStyle::*option : {&view::FrameStyle::tilt, &view::FrameStyle::arrows,
                                         &view::FrameStyle::copies, &view::FrameStyle::occlusion}) {
    auto other = style;
    other.*option = true;
    const auto image = grains::picture(frame, other);
    CHECK_FALSE(image == plain);
    CHECK(image == grains::picture(frame, other));
  }
}

TEST_CASE("A rod joins two points") {
  view::OffscreenContext context(400, 300);
  view::SolidScene scene(context, 200, 150, {0, 0, 0}, 0);
  view::Eye eye;
  eye.towards = {0, -1, 0}, eye.up = {0, 0, 1}, eye.distance = 100, eye.focal = 1000, eye.at = {100, 75};
  scene.look(eye, {90, 110});
  image::Image image;
  scene.draw({}, {{{-5, 0, -3}, {5, 0, 3}, 0.5, 0.5, {1, 0, 0}}}, image);
  CHECK(image.pixel(100, 75)[3] == 255);
  CHECK(image.pixel(60, 99)[3] > 200);
  CHECK(image.pixel(60, 50)[3] == 0);
}
