#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "common/error.hpp"
#include "plot/draw.hpp"
#include "plot/outline.hpp"

namespace raster_tests {
using namespace chute::plot;
using chute::image::Image;

namespace {

/// Black on white, one pixel per point unless said otherwise.
DisplayList page(double width, double height) {
  DisplayList list;
  list.width = width, list.height = height;
  return list;
}

/// Ink in pixels: 1 for a black one.
double ink(const Image& image) {
  double sum = 0;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) sum += (255 - image.rgba[i]) / 255.0;
  return sum;
}

double area(const std::vector<Point>& triangles) {
  double sum = 0;
  for (std::size_t i = 0; i < triangles.size(); i += 3) {
    const Point u = triangles[i + 1] - triangles[i], v = triangles[i + 2] - triangles[i];
    sum += std::abs(u.x() * v.y() - u.y() * v.x()) / 2;
  }
  return sum;
}

const Color black{};

}  // namespace

TEST_CASE("whole pixels are painted exactly, parts of pixels by their area") {
  auto list = page(20, 20);
  Path box;
  list.fill(box.rectangle({3, 4, 7, 9}), black);
  const auto exact = rasterise(list, 72);
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 20; ++x)
      REQUIRE(exact.pixel(x, y)[0] == (x >= 3 && x < 7 && y >= 4 && y < 9 ? 0 : 255));

  list.items.clear();
  Path half;
  list.fill(half.rectangle({3.5, 4.25, 7, 9}), black);
  const auto parts = rasterise(list, 72);
  REQUIRE(parts.pixel(3, 5)[0] == 128);  // half of the samples
  REQUIRE(parts.pixel(5, 4)[0] == 64);
  REQUIRE(ink(parts) == Approx(3.5 * 4.75).epsilon(0.01));
}

TEST_CASE("filling follows the winding number, whichever way the contours run") {
  for (const bool reversed : {false, true}) {
    auto list = page(40, 40);
    Path ring;
    ring.rectangle({5, 5, 35, 35});
    if (reversed)
      ring.move({10, 10}).line({10, 30}).line({30, 30}).line({30, 10}).close();
    else
      ring.rectangle({10, 10, 30, 30});
    list.fill(ring, black);
    REQUIRE(ink(rasterise(list, 72)) == Approx(reversed ? 900 - 400 : 900));
  }
  auto list = page(40, 40);
  Path circle;
  list.fill(circle.circle({20, 20}, 15), black);
  REQUIRE(ink(rasterise(list, 72)) == Approx(std::numbers::pi * 225).epsilon(2e-3));
}

TEST_CASE("upright rectangles are drawn whichever way they run") {
  // Mesa's llvmpipe takes pairs of triangles that look like one for a rectangle; see raster.cpp
  for (int start = 0; start < 4; ++start)
    for (const bool reversed : {false, true}) {
      Point corners[4] = {{5, 5}, {15, 5}, {15, 7}, {5, 7}};
      auto list = page(20, 20);
      Path path;
      for (int i = 0; i < 4; ++i) {
        const Point p = corners[(start + (reversed ? 4 - i : i)) % 4];
        i ? path.line(p) : path.move(p);
      }
      list.fill(path.close(), black);
      REQUIRE(ink(rasterise(list, 72)) == Approx(20));
    }
}

TEST_CASE("a transparent path paints each place once, however it crosses itself") {
  auto list = page(40, 40);
  Path cross;
  cross.move({5, 20}).line({35, 20}).move({20, 5}).line({20, 35});
  list.stroke(cross, {4, {}, Cap::butt, Join::miter}, Color{0, 0, 0, 0.5});
  REQUIRE(int(rasterise(list, 72).pixel(20, 20)[0]) == Approx(128).margin(1));
}

TEST_CASE("the pen covers what PostScript's would: dashes, caps, joins") {
  const auto drawn = [](const Path& path, const Stroke& stroke) {
    std::vector<Point> triangles;
    pen_triangles(flatten(path, 0.01), stroke, 0.001, triangles);
    return area(triangles);
  };
  Path line;
  line.move({0, 0}).line({20, 0});
  REQUIRE(drawn(line, {2, {}, Cap::butt}) == Approx(40));
  REQUIRE(drawn(line, {2, {}, Cap::square}) == Approx(44));
  REQUIRE(drawn(line, {2, {}, Cap::round}) == Approx(40 + std::numbers::pi).epsilon(2e-3));
  REQUIRE(drawn(line, {2, {3, 2}, Cap::butt}) == Approx(2 * (3 * 4)));
  REQUIRE(drawn(line, {2, {8}, Cap::butt}) == Approx(2 * (8 + 4)));  // odd lists alternate: on 8, off 8, on 4
  Path corner;
  corner.move({0, 0}).line({10, 0}).line({10, 10});
  // two arms, of which the quads overlap in one quarter of the square at the corner: the join adds the outer
  // part
  REQUIRE(drawn(corner, {2, {}, Cap::butt, Join::bevel}) == Approx(40 + 0.5));
  REQUIRE(drawn(corner, {2, {}, Cap::butt, Join::miter}) == Approx(40 + 1));
  REQUIRE(drawn(corner, {2, {}, Cap::butt, Join::round}) == Approx(40 + std::numbers::pi / 4).epsilon(2e-3));
  Path closed;
  closed.rectangle({0, 0, 10, 10});
  REQUIRE(drawn(closed, {2, {}, Cap::butt, Join::miter}) == Approx(4 * 20 + 4));
  Path sharp;  // beyond the limit a mitre becomes a bevel
  sharp.move({0, 0}).line({10, 0}).line({0, 1});
  REQUIRE(drawn(sharp, {2, {}, Cap::butt, Join::miter, 4}) ==
          Approx(drawn(sharp, {2, {}, Cap::butt, Join::bevel, 4})));
  Path point;
  point.move({5, 5}).line({5, 5});
  REQUIRE(drawn(point, {2, {}, Cap::round}) == Approx(std::numbers::pi).epsilon(2e-3));
  REQUIRE(drawn(point, {2, {}, Cap::butt}) == 0);
  Path empty;
  REQUIRE(drawn(empty, {}) == 0);
}

TEST_CASE("nothing is drawn outside a clip") {
  auto list = page(40, 40);
  list.items.emplace_back(ClipBegin{{10, 10, 20, 30}});
  Path all;
  list.fill(all.rectangle({0, 0, 40, 40}), black);
  list.items.emplace_back(DotsItem{Path{}.circle({0, 0}, 3), {{2, 2}, {30, 30}}, black});
  list.items.emplace_back(ClipEnd{});
  REQUIRE(ink(rasterise(list, 72)) == 200);
  Path dot;
  list.fill(dot.rectangle({0, 0, 1, 1}), black);
  REQUIRE(ink(rasterise(list, 72)) == 201);
}

TEST_CASE("tiles leave no seams") {
  auto list = page(600, 300);
  Path box;
  list.fill(box.rectangle({10, 10, 590, 290}), black);
  REQUIRE(ink(rasterise(list, 72)) == 580 * 280);
  list.items.clear();
  DotsItem dots{Path{}.rectangle({-2, -2, 2, 2}), {}, black};
  for (int x = 4; x < 600; x += 8)
    for (int y = 4; y < 300; y += 8) dots.at.push_back({double(x), double(y)});
  list.items.emplace_back(dots);
  REQUIRE(ink(rasterise(list, 72)) == 16.0 * static_cast<double>(dots.at.size()));
}

TEST_CASE("a transparent ground stays transparent") {
  auto list = page(10, 10);
  list.background = Color{1, 1, 1, 0};
  Path box;
  list.fill(box.rectangle({0, 0, 5, 10}), Color::hex(0xD55E00, 0.5));
  const auto image = rasterise(list, 72);
  REQUIRE(int(image.pixel(2, 2)[3]) == Approx(128).margin(1));
  REQUIRE(int(image.pixel(2, 2)[0]) == Approx(0xD5).margin(2));
  REQUIRE(image.pixel(7, 2)[3] == 0);
}

TEST_CASE("pictures that no one can hold are refused") {
  REQUIRE_THROWS_AS(rasterise(page(1e6, 10), 300), chute::InputError);
  REQUIRE_THROWS_AS(rasterise(page(0, 10), 300), chute::InputError);
}

}  // namespace raster_tests
