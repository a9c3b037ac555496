#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>

#include "grains.hpp"
#include "image/compare.hpp"
#include "view/occlusion.hpp"
#include "view/solid_scene.hpp"
#include "view/solid_tile.hpp"

using namespace chute;
using Eigen::Vector3d;

namespace solid_tests {

namespace {

view::FrameStyle small() {
  view::FrameStyle style;
  style.width = 160, style.height = 120, style.furniture = false;
  style.background = view::Background::transparent;
  return style;
}

/// Black nothing, so that alpha tells how much of a pixel is covered.
const view::SolidLook nothing{{0, 0, 0}, {0, 0, 0}, 0};

view::Eye eye_at(const Vector3d& centre, double distance, double focal, const plot::Point& at) {
  view::Eye eye;
  eye.centre = centre, eye.axes = view::Eye::axes_of({0, -1, 0}, {0, 0, 1});
  eye.distance = distance, eye.focal = focal, eye.at = at;
  return eye;
}

image::Image picture(const view::SolidContent& content, const view::Eye& eye, int width = 200,
                     int height = 150, const view::SolidLook& look = nothing, bool all = false) {
  view::SolidScene scene(width, height, look);
  scene.look(eye);
  image::Image image;
  scene.draw(content, image, all);
  return image;
}

/// Balls of several sizes that overlap, in no order.
std::vector<view::Ball> heap(int side) {
  const auto frame = grains::cube(side);
  const auto shake = [](std::size_t i, double by) {
    return 0.6 * std::fmod(static_cast<double>(i) * by, 1.0);
  };
  std::vector<view::Ball> balls;
  for (std::size_t i = 0; i < frame.size(); ++i)
    balls.push_back({frame.centre(i) + Vector3d(shake(i, 0.618), shake(i, 0.414), shake(i, 0.732)),
                     frame.radius[i] * (1 + shake(i, 0.236)),
                     {0.1 + static_cast<double>(i % 7) * 0.1, static_cast<double>(i % 5) * 0.2, 0.5}});
  return balls;
}

}  // namespace

TEST_CASE("A sphere is seen as large as it is, where the eye says") {
  const auto eye = eye_at({1, 2, 3}, 50, 1500, {80, 90});
  const view::Ball ball{{1.5, 2, 3.25}, 1, {1, 1, 1}};
  const auto image = picture({.balls = {ball}}, eye);
  double area = 0, x = 0, y = 0;
  for (int j = 0; j < 150; ++j)
    for (int i = 0; i < 200; ++i) {
      const double cover = image.pixel(i, j)[3] / 255.0;
      area += cover, x += cover * (i + 0.5), y += cover * (j + 0.5);
    }
  CHECK(std::sqrt(area / std::numbers::pi) == Approx(30).epsilon(0.003));  // 1500 / 50
  const auto seen = eye.seen(ball.centre);
  CHECK(seen.x() == Approx(80 + 15));
  CHECK(seen.y() == Approx(90 - 7.5));
  CHECK(x / area == Approx(seen.x()).margin(0.1));
  CHECK(y / area == Approx(seen.y()).margin(0.1));
}

TEST_CASE("The box of a run fills the place that it is given") {
  const Eigen::AlignedBox3d box(Vector3d(0, 0, -1), Vector3d(10, 5, 4));
  const plot::Rect rect{20, 30, 220, 130};
  const auto axes = view::Eye::axes_of({0.5, -0.7, 0.5}, {0, 0, 1});
  CHECK((axes * axes.transpose()).isIdentity(1e-12));
  const auto eye = view::Eye::on_box(box, axes, rect, 1);
  plot::Rect seen = plot::Rect::nothing();
  for (double x : {0., 10.})
    for (double y : {0., 5.})
      for (double z : {-1., 4.}) seen.include(eye.seen({x, y, z}));
  CHECK(seen.centre().x() == Approx(120).margin(0.01));
  CHECK(seen.centre().y() == Approx(80).margin(0.01));
  CHECK(std::max(seen.width() / 200, seen.height() / 100) == Approx(1).margin(1e-6));
}

TEST_CASE("Lines of sight meet balls and rods on their surfaces, with outward normals") {
  const auto eye = eye_at({0, 0, 0}, 400, 9000, {100, 75});
  const view::Ball ball{{0.7, -3, 0.4}, 0.5, {}};
  const view::Rod rod{{-1, 2, -0.5}, {0.6, -1, 0.9}, 0.4, 0.15, {}};
  const view::SeenBall seen_ball(ball, eye, 200, 150);
  const view::SeenRod seen_rod(rod, eye, 200, 150);
  int balls = 0, rods = 0;
  for (double y = 0.25; y < 150; y += 0.5)
    for (double x = 0.25; x < 200; x += 0.5) {
      const auto place = [&](double depth) -> Vector3d { return (400 + depth) * view::sight(eye, x, y); };
      const Vector3d d = view::sight(eye, x, y).normalized(), c = seen_ball.centre;
      if ((c - c.dot(d) * d).norm() < 0.49) {
        const auto hit = view::hit(seen_ball, eye, x, y);
        const Vector3d out = place(hit.depth) - c;
        REQUIRE(out.norm() == Approx(0.5).epsilon(1e-6));
        REQUIRE((out.normalized() - hit.normal).norm() < 1e-6);
        REQUIRE(hit.normal.dot(d) < 0);
        ++balls;
      }
      if (const auto hit = view::hit(seen_rod, eye, x, y)) {
        const Vector3d axis = seen_rod.to - seen_rod.from, out = place(hit->depth) - seen_rod.from;
        const double along = out.dot(axis) / axis.squaredNorm();
        REQUIRE((along > -1e-6 && along < 1 + 1e-6));
        const double radius = 0.4 + along * (0.15 - 0.4), from_axis = (out - along * axis).norm();
        const bool is_end = along < 1e-6 || along > 1 - 1e-6;
        REQUIRE(from_axis < radius * (1 + 1e-6));
        if (!is_end) REQUIRE(from_axis == Approx(radius).epsilon(1e-6));
        REQUIRE(hit->normal.dot(d) < 1e-9);
        ++rods;
      }
    }
  CHECK(balls > 1000);
  CHECK(rods > 1000);
}

TEST_CASE("Leaving out what is hidden changes no pixel") {
  const auto balls = heap(14);
  const Eigen::AlignedBox3d box(Vector3d(-1, -1, -1), Vector3d(15, 15, 15));
  for (const Vector3d& towards :
       {Vector3d(0.5, -0.7, 0.5), Vector3d(0, 0, 1), Vector3d(1, 0, 0.1), Vector3d(-0.3, 0.9, 0.2)})
    for (const double zoom : {0.2, 1.2, 9.0}) {  // specks; many tiles; balls as large as tiles
      const auto eye = view::Eye::on_box(box, view::Eye::axes_of(towards, {0, 0, 1}), {0, 0, 400, 300}, zoom);
      const view::SolidLook look{{1, 1, 1}, {0, 0, 0}, 1, 0.5, true};
      CHECK(picture({.balls = balls}, eye, 400, 300, look) ==
            picture({.balls = balls}, eye, 400, 300, look, true));
    }
}

TEST_CASE("Every sample shows the nearest ball: tiles against every ball for itself") {
  auto balls = heap(5);
  const Eigen::AlignedBox3d box(Vector3d(-1, -1, -1), Vector3d(6, 6, 6));
  const auto eye =
      view::Eye::on_box(box, view::Eye::axes_of({0.5, -0.7, 0.5}, {0, 0, 1}), {0, 0, 100, 100}, 1);
  const auto image = picture({.balls = balls}, eye, 100, 100);
  int differ = 0;
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 100; ++x) {
      int covered = 0;
      for (int k = 0; k < 4; ++k) {
        const Vector3d d = view::sight(eye, x + 0.25 + 0.5 * (k % 2), y + 0.25 + 0.5 * (k / 2)).normalized();
        covered += std::any_of(balls.begin(), balls.end(), [&](const view::Ball& ball) {
          const Vector3d c = eye.coordinates(ball.centre);
          return (c - c.dot(d) * d).norm() < ball.radius;
        });
      }
      differ += std::abs(image.pixel(x, y)[3] - 255 * covered / 4) > 1;
    }
  CHECK(differ <= 2);  // of 10,000: lines that just touch
}

TEST_CASE("Spheres, rods and occlusion draw, the same every time") {
  const auto frame = grains::cube(5);
  auto style = small();
  const auto plain = grains::picture(frame, style);
  CHECK_FALSE(image::is_blank(plain));
  CHECK(plain == grains::picture(frame, style));
  CHECK(plain.pixel(0, 0)[3] == 0);
  CHECK(plain.pixel(80, 60)[3] == 255);
  using Change = std::function<void(view::FrameStyle&)>;
  for (const auto& change :
       {Change([](auto& s) { s.tilt = true; }), Change([](auto& s) { s.arrows = true; }),
        Change([](auto& s) { s.copies = true; }), Change([](auto& s) { s.occlusion = true; }),
        Change([](auto& s) { s.outlines = true; }), Change([](auto& s) { s.floor = true; }),
        Change([](auto& s) { s.box = true; })}) {
    auto other = style;
    change(other);
    const auto image = grains::picture(frame, other);
    CHECK_FALSE(image == plain);
    CHECK(image == grains::picture(frame, other));
  }
}

TEST_CASE("All of a velocity arrow is seen: it begins at the surface of its grain") {
  auto frame = grains::cube(1);
  for (auto& array : frame.arrays) array.values.clear();
  frame.x.clear(), frame.y.clear(), frame.z.clear(), frame.radius.clear();
  grains::add(frame, 0, 0, 0, 0.5, 2), grains::add(frame, 10, 0, 0, 0.5, 0);
  auto style = small();
  style.width = 800, style.camera.azimuth = 0, style.camera.elevation = 90;  // from above, x to the right
  style.color = "none";
  const auto covered = [](const image::Image& image) {
    int most = 0;
    for (int y = 0; y < image.height; ++y) {
      int count = 0;
      for (int x = 0; x < image.width; ++x) count += image.pixel(x, y)[3] > 128;
      most = std::max(most, count);
    }
    return most;
  };
  const double two_diameters = covered(grains::picture(frame, style));
  style.arrows = true;
  const double with_arrow = covered(grains::picture(frame, style));
  // the fastest has an arrow of 1.6 mean diameters (Studio::arrow_length)
  CHECK(with_arrow - two_diameters == Approx(1.6 * two_diameters / 2).epsilon(0.06));
}

TEST_CASE("A rod joins two points") {
  const auto eye = eye_at({0, 0, 0}, 100, 1000, {100, 75});
  const auto image = picture({.rods = {{{-5, 0, -3}, {5, 0, 3}, 0.5, 0.5, {1, 0, 0}}}}, eye);
  CHECK(image.pixel(100, 75)[3] == 255);
  CHECK(image.pixel(60, 99)[3] > 200);
  CHECK(image.pixel(60, 50)[3] == 0);
}

TEST_CASE("Occlusion darkens where surfaces face each other, and nothing that stands alone") {
  const auto eye = eye_at({0, 0, 0}, 100, 4000, {100, 75});
  const view::Ball left{{-0.9, 0, 0}, 1, {1, 1, 1}}, right{{0.9, 0, 0}, 1, {1, 1, 1}};
  auto shaded = nothing;
  shaded.occlusion = 1;
  const auto bright = picture({.balls = {left, right}}, eye),
             dark = picture({.balls = {left, right}}, eye, 200, 150, shaded);
  CHECK(dark.pixel(97, 75)[0] < 0.8 * bright.pixel(97, 75)[0]);
  CHECK(dark.pixel(40, 75)[0] > 0.97 * bright.pixel(40, 75)[0]);
  const auto alone = picture({.balls = {left}}, eye),
             still_alone = picture({.balls = {left}}, eye, 200, 150, shaded);
  for (int x = 30; x < 98; ++x) CHECK(still_alone.pixel(x, 75)[0] >= alone.pixel(x, 75)[0] - 3);
}

TEST_CASE(
    "Bands turn with the ball: a quarter turn about an axis of the ball changes nothing, half of it does") {
  const auto eye = eye_at({0, 0, 0}, 100, 4000, {100, 75});
  view::Ball ball{{0, 0, 0}, 1, {.8, .8, .8}};
  const auto turned = [&](double angle) {
    ball.orientation = Eigen::Quaterniond(Eigen::AngleAxisd(0.3, Vector3d::UnitX()) *
                                          Eigen::AngleAxisd(angle, Vector3d::UnitY()))
                           .cast<float>();
    return picture({.balls = {ball}}, eye);
  };
  const auto start = turned(0.2);
  CHECK(image::compare(start, turned(0.2 + std::numbers::pi / 2)).over < 10);
  CHECK(image::compare(start, turned(0.2 + std::numbers::pi / 4)).over > 500);
  ball.orientation = {0, 0, 0, 0};
  CHECK(image::compare(start, picture({.balls = {ball}}, eye)).over > 500);
}

TEST_CASE("A spot lies where the ball was hit") {
  const auto eye = eye_at({0, 0, 0}, 100, 4000, {100, 75});
  const view::Ball ball{{0, 0, 0}, 1, {.5, .5, .5}};
  const auto image = picture({.balls = {ball}, .spots = {{0, Vector3d(0.6, -0.8, 0)}}}, eye);
  CHECK(image.pixel(124, 75)[0] > image.pixel(124, 75)[2] + 50);  // red of the mark
  CHECK(image.pixel(76, 75)[0] == Approx(image.pixel(76, 75)[2]).margin(2));
}

TEST_CASE("A pane covers what is behind it, not what is before it") {
  const auto eye = eye_at({0, 0, 0}, 100, 2000, {100, 75});
  const std::vector<Vector3d> corners{{-3, 0, -3}, {3, 0, -3}, {3, 0, 3}, {-3, 0, 3}};
  const view::Ball before{{-1.5, -2, 0}, 1, {1, 1, 1}}, behind{{1.5, 2, 0}, 1, {1, 1, 1}};
  const auto image = picture({.balls = {before, behind}, .panes = {{corners, {0, 0, 1}, 0.5}}}, eye);
  CHECK(image.pixel(70, 75)[0] > 150);
  CHECK(image.pixel(130, 75)[0] < 130);
  CHECK(image.pixel(100, 30)[3] == Approx(128).margin(1));
  CHECK(image.pixel(100, 10)[3] == 0);
}

TEST_CASE("A ball's shadow lies on the floor, away from the light") {
  view::Eye eye;
  eye.axes = view::Eye::axes_of({0, -1, 1}, {0, 0, 1}), eye.distance = 100, eye.focal = 1500,
  eye.at = {100, 75};
  const view::SolidContent content{.balls = {{{0, 0, 1}, 1, {1, 1, 1}}},
                                   .floor = view::Floor{{0, 0, 0}, {0, 0, 1}, 6}};
  const auto image = picture(content, eye);
  // The key lamp stands on the left: on the right the floor is darker than as far away on the left. Its soft edge ends
  // two radii beyond the shadow.
  const auto dark = [&](double x) {
    const auto at = eye.seen({x, 0, 0});
    return int{image.pixel(static_cast<int>(at.x()), static_cast<int>(at.y()))[3]};
  };
  CHECK(dark(1.5) > 20);
  CHECK(dark(1.5) > dark(-1.5) + 5);
  CHECK(dark(-3.2) == 0);
}

TEST_CASE("The shadow of what is high falls no farther aside than it may") {
  view::Eye eye;
  eye.axes = view::Eye::axes_of({0, -1, 1}, {0, 0, 1}), eye.distance = 100, eye.focal = 1500,
  eye.at = {100, 75};
  const auto shadow_below = [&](double reach) {
    const view::SolidContent content{.balls = {{{0, 0, 30}, 1, {1, 1, 1}}},  // above the picture
                                     .floor = view::Floor{{0, 0, 0}, {0, 0, 1}, 40, reach}};
    return picture(content, eye).pixel(100, 75)[3];
  };
  CHECK(shadow_below(0) > 30);
  CHECK(shadow_below(0.01) > 30);
  CHECK(shadow_below(std::numeric_limits<double>::infinity()) == 0);
}

TEST_CASE("What is cut away is not drawn") {
  const auto frame = grains::cube(4);
  auto style = small();
  const auto whole = grains::picture(frame, style);
  style.cuts = {{2, true, 1.5}};
  const auto half = grains::picture(frame, style);
  const auto covered = [](const image::Image& image) {
    int count = 0;
    for (std::size_t i = 3; i < image.rgba.size(); i += 4) count += image.rgba[i] > 0;
    return count;
  };
  CHECK(covered(half) < 0.85 * covered(whole));
  CHECK(covered(half) > 0.3 * covered(whole));
}

TEST_CASE("A camera that follows a grain sees it in one place, and no jump at the periodic ends") {
  auto style = small();
  style.camera.follow = view::Follow{8};
  style.color = "none", style.spin = false;
  const auto first = grains::cube(2);  // id 8 is added, above
  std::vector<read::GrainFrame> frames;
  view::Surveyor surveyor(style);
  for (int i = 0; i < 12; ++i) {
    auto frame = first;
    frame.domain = {Vector3d(0, 0, 0), Vector3d(5, 0, 0)};
    frame.time = 0.5 * i;
    grains::add(frame, std::fmod(3.0 + 1.6 * i, 5.0), 0, 4, 0.5, 3.2);
    frames.push_back(frame);
    surveyor.see(frame, frame.time);
  }
  const auto survey = surveyor.finish();
  REQUIRE(survey.path.size() == 12);
  for (std::size_t i = 1; i < 12; ++i) CHECK(survey.path[i].x() - survey.path[i - 1].x() == Approx(1.6));
  view::FrameRenderer renderer(style, survey);
  const auto top = [&](std::size_t i) {  // the middle of the highest row of pixels that is covered
    const auto& image = renderer.draw({.frame = frames[i], .focus = survey.path[i]});
    for (int y = 0; y < image.height; ++y) {
      double sum = 0, count = 0;
      for (int x = 0; x < image.width; ++x)
        if (image.pixel(x, y)[3] > 100) sum += x, count += 1;
      if (count > 0) return sum / count;
    }
    return -1.0;
  };
  const double place = top(0);
  for (std::size_t i = 1; i < 12; ++i) CHECK(top(i) == Approx(place).margin(1.5));
}

namespace {

/// The colour in the middle of a picture, 0 to 255.
Vector3d middle(const image::Image& image) {
  const auto* pixel = image.pixel(image.width / 2, image.height / 2);
  return {double(pixel[0]), double(pixel[1]), double(pixel[2])};
}

view::Ball glass(double depth, double radius, const view::Rgb& color, double opacity) {
  view::Ball ball{{0, depth, 0}, radius, color};
  ball.opacity = opacity;
  return ball;
}

/// What a thing of this colour shows where nothing is before it.
Vector3d alone(view::Ball ball, const view::Eye& eye) {
  ball.opacity = 1;
  return middle(picture({.balls = {ball}}, eye));
}

}  // namespace

TEST_CASE("Of several balls of glass behind one another all are seen, each through those before it") {
  const auto eye = eye_at({0, 0, 0}, 50, 1500, {100, 75});
  const view::SolidLook white{{1, 1, 1}, {0, 0, 0}, 1};
  const auto a = glass(-6, 1, {0.9, 0.1, 0.1}, 0.3), b = glass(0, 1.5, {0.1, 0.8, 0.1}, 0.5),
             c = glass(5, 1, {0.1, 0.1, 0.9}, 0.2);
  const Vector3d ground(255, 255, 255);
  const Vector3d expected =
      0.3 * alone(a, eye) + 0.7 * (0.5 * alone(b, eye) + 0.5 * (0.2 * alone(c, eye) + 0.8 * ground));
  // the eye's order, whatever that in the file is
  for (const auto& balls : {std::vector{a, b, c}, std::vector{c, b, a}, std::vector{b, c, a}})
    CHECK((middle(picture({.balls = balls}, eye, 200, 150, white)) - expected).norm() < 2);
  // something solid between them is not seen through, and what lies before it is
  const view::Ball wall{{0, 2.5, 0}, 0.5, {0.5, 0.5, 0.5}};
  const Vector3d with_wall = 0.3 * alone(a, eye) + 0.7 * (0.5 * alone(b, eye) + 0.5 * alone(wall, eye));
  CHECK((middle(picture({.balls = {c, wall, b, a}}, eye, 200, 150, white)) - with_wall).norm() < 2);
  // a pane that stands between two of them is a layer, too
  const view::Pane pane{{{-9, 2.5, -9}, {9, 2.5, -9}, {9, 2.5, 9}, {-9, 2.5, 9}}, {0, 0, 0}, 0.4};
  const Vector3d with_pane =
      0.3 * alone(a, eye) + 0.7 * (0.5 * alone(b, eye) + 0.5 * 0.6 * (0.2 * alone(c, eye) + 0.8 * ground));
  CHECK((middle(picture({.balls = {a, b, c}, .panes = {pane}}, eye, 200, 150, white)) - with_pane).norm() <
        2);
}

TEST_CASE("A heap of glass is its balls, each drawn for itself, laid over each other by their depths") {
  const auto eye = eye_at({1, 1, 1}, 40, 700, {80, 60});
  auto balls = heap(3);  // they cut through each other
  std::vector<image::Image> alone;
  std::vector<view::SeenBall> seen;
  for (auto& ball : balls) {
    alone.push_back(picture({.balls = {ball}}, eye, 160, 120));
    seen.emplace_back(ball, eye, 160, 120);
    ball.opacity = 0.2 + 0.3 * ball.color.r;
  }
  const auto whole = picture({.balls = balls}, eye, 160, 120);
  /// Those that a line of sight meets, the nearest first.
  const auto met = [&](double x, double y) {
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < balls.size(); ++i)
      if (const auto depth = view::depth_at(seen[i], eye, x, y)) order.emplace_back(*depth, i);
    std::sort(order.begin(), order.end());
    std::vector<std::size_t> names;
    for (const auto& [depth, i] : order) names.push_back(i);
    return names;
  };
  int compared = 0;
  double worst = 0;
  std::size_t most = 0;
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 160; ++x) {
      const auto order = met(x + 0.25, y + 0.25);
      bool same = true;  // in all of the pixel
      for (const auto& [dx, dy] : {std::pair{0.75, 0.25}, {0.25, 0.75}, {0.75, 0.75}})
        same = same && met(x + dx, y + dy) == order;
      if (!same) continue;
      Eigen::Vector4d expected(0, 0, 0, 0);
      double through = 1;
      for (const auto i : order) {
        for (int c = 0; c < 4; ++c) expected[c] += through * balls[i].opacity * alone[i].pixel(x, y)[c];
        through *= 1 - balls[i].opacity;
      }
      for (int c = 0; c < 4; ++c) worst = std::max(worst, std::abs(expected[c] - whole.pixel(x, y)[c]));
      compared += !order.empty(), most = std::max(most, order.size());
    }
  CHECK(compared > 2000);
  CHECK(most > 3);
  CHECK(worst <= 1.5);  // every ball alone is rounded, and so is the whole
}

TEST_CASE("A body of several balls is one layer of glass, and light falls through it onto the floor") {
  const auto eye = eye_at({0, 0, 0}, 50, 1500, {100, 75});
  auto near = glass(-1, 1, {0.9, 0.2, 0.1}, 0.4), far = glass(1, 1.5, {0.9, 0.2, 0.1}, 0.4);
  const auto two = picture({.balls = {near, far}}, eye);
  near.body = far.body = 7;
  const auto one = picture({.balls = {far, near}}, eye);
  CHECK((middle(one) - 0.4 * alone(near, eye)).norm() < 2);
  CHECK((middle(two) - 0.4 * alone(near, eye) - 0.6 * 0.4 * alone(far, eye)).norm() < 2);

  auto above = eye_at({0, 0, 0}, 200, 1500, {100, 75});
  above.axes = view::Eye::axes_of({0.3, -0.6, 0.7}, {0, 0, 1});
  const view::SolidLook white{{1, 1, 1}, {0, 0, 0}, 1};
  const auto shadow = [&](double opacity) {
    view::Ball ball{{0, 0, 2}, 1, {1, 1, 1}};
    ball.opacity = opacity;
    const auto image =
        picture({.balls = {ball}, .floor = view::Floor{{0, 0, 0}, {0, 0, 1}, 9}}, above, 200, 150, white);
    int darkest = 255;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) {
        view::SeenBall seen(ball, above, 200, 150);
        if (!view::depth_at(seen, above, x + 0.5, y + 0.5))
          darkest = std::min<int>(darkest, image.pixel(x, y)[0]);
      }
    return 255 - darkest;
  };
  CHECK(shadow(1) > 40);
  CHECK(shadow(0.25) == Approx(0.25 * shadow(1)).margin(2));
}

}  // namespace solid_tests
