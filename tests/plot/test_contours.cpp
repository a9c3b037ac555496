// Contours: where the values say, whole from end to end, with values on them that cover nothing.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "common/error.hpp"
#include "plot/contours.hpp"
#include "plot/layout.hpp"
#include "plot/level_lines.hpp"
#include "plot/map.hpp"
#include "plot/polyline.hpp"
#include "plot/recipe.hpp"
#include "plot/referee.hpp"

namespace contours_tests {
using namespace chute;
using namespace chute::plot;

namespace {

constexpr double side = 400;  // points
const Frame square_frame{{0, 0, side, side}, {-1, 1, Scale::linear}, {-1, 1, Scale::linear}};

template <class Value>
Map map_of(int n, Value&& value) {
  Map map;
  for (int i = 0; i < n; ++i) map.x.push_back(-1 + 2.0 * i / (n - 1));
  map.y = map.x;
  for (const double y : map.y)
    for (const double x : map.x) map.values.push_back(value(x, y));
  return map;
}

/// A few waves across a panel, and points anywhere in it.
Figure random_figure(std::mt19937& random) {
  std::uniform_real_distribution<double> phase(0, 2 * std::numbers::pi), wave(0.5, 5), place(-0.95, 0.95);
  std::vector<std::array<double, 3>> waves;
  for (int k = 0; k < 4; ++k) waves.push_back({wave(random), wave(random), phase(random)});
  Figure figure;
  figure.legend = Legend::off;
  auto& panel = figure.panels.emplace_back();
  panel.title = "$e_n=0.5$";
  panel.x.label = "$x$", panel.y.label = "$y$";
  panel.map = map_of(21, [&](double x, double y) {
    double sum = 0;
    for (const auto& [kx, ky, p] : waves) sum += std::cos(kx * x + ky * y + p);
    return sum;
  });
  panel.map->contours = 5;
  auto& points = panel.series.emplace_back();
  points.name = "points", points.kind = Kind::markers;
  for (int k = 0; k < 12; ++k) points.x.push_back(place(random)), points.y.push_back(place(random));
  return figure;
}

}  // namespace

TEST_CASE("a slope has one straight contour from edge to edge") {
  const auto lines = lines_at(map_of(9, [](double x, double) { return x; }), square_frame, 0.3);
  REQUIRE(lines.size() == 1);
  for (const auto& p : lines[0]) CHECK(p.x() == Approx(0.65 * side));
  CHECK(std::abs(lines[0].front().y() - lines[0].back().y()) == Approx(side));
}

TEST_CASE("a hill's contour runs around it once and has the right radius") {
  const auto lines =
      lines_at(map_of(41, [](double x, double y) { return std::hypot(x, y); }), square_frame, 0.6);
  REQUIRE(lines.size() == 1);
  CHECK((lines[0].front() - lines[0].back()).norm() == 0);
  double turned = 0;
  const Point middle{side / 2, side / 2};
  for (std::size_t k = 0; k < lines[0].size(); ++k) {
    const Point from = lines[0][k] - middle;
    CHECK(from.norm() == Approx(0.6 * side / 2).epsilon(0.005));
    if (k == 0) continue;
    const Point before = lines[0][k - 1] - middle;
    turned += std::atan2(before.x() * from.y() - before.y() * from.x(), before.dot(from));
  }
  CHECK(std::abs(turned) == Approx(2 * std::numbers::pi));
}

TEST_CASE("where a value is not known a contour ends") {
  auto map = map_of(9, [](double x, double) { return x; });
  map.values[4 * 9 + 5] = unknown;  // in the fifth row, at x = 0.25
  CHECK(lines_at(map, square_frame, 0.3).size() == 2);
  CHECK(lines_at(map, square_frame, -0.8).size() == 1);
}

TEST_CASE("each ring of a cone has its value on it, the line broken there, and all as said") {
  auto map = map_of(41, [](double x, double y) { return std::hypot(x, y); });
  map.levels = {0.2, 0.4, 0.6, 0.8};
  const auto look = look_of(Style::journal);
  const auto contours = contours_of(map, square_frame, look, Occupancy(square_frame.rect));
  REQUIRE(contours.size() == 4);
  for (const auto& c : contours) {
    CAPTURE(c.text);
    REQUIRE(c.value);
    const Point from = c.value->box.centre() - Point{side / 2, side / 2};
    CHECK(from.norm() == Approx(c.level * side / 2).epsilon(0.01));
    CHECK(c.text == "$0." + std::to_string(std::lround(10 * c.level)) + "$");
  }
  DisplayList list;
  Occupancy occupied(square_frame.rect);
  Painter painter{list, look, occupied, 0, true};
  draw_contours(painter, square_frame, contours);
  double drawn = 0;
  for (const auto& item : list.items) {
    const auto* stroke = std::get_if<StrokeItem>(&item);
    if (!stroke) continue;
    for (std::size_t k = 1; k < stroke->path.points.size(); ++k) {
      if (stroke->path.verbs[k] != Path::Verb::line) continue;
      Point a = stroke->path.points[k - 1], b = stroke->path.points[k];
      drawn += (b - a).norm();
      for (const auto& c : contours) CHECK_FALSE(cut_segment(a, b, c.value->box.grown(-0.01)));
    }
  }
  double whole = 0, hidden = 0;
  for (const auto& c : contours) {
    whole += std::numbers::pi * c.level * side;
    hidden += std::max(c.value->box.width(), c.value->box.height());
  }
  CHECK(drawn < whole - 0.3 * hidden);
  CHECK(drawn > whole - 2 * hidden);
}

TEST_CASE("values keep off what is taken, and a line without room has none") {
  auto map = map_of(41, [](double x, double y) { return std::hypot(x, y); });
  map.levels = {0.6};
  const auto look = look_of(Style::journal);
  Occupancy taken(square_frame.rect);
  taken.mark({0, 0, side / 2, side});
  const auto right = contours_of(map, square_frame, look, taken);
  REQUIRE(right[0].value);
  CHECK(right[0].value->box.left > side / 2);
  taken.mark({0, 0, side, side});
  CHECK_FALSE(contours_of(map, square_frame, look, taken)[0].value);
  map.values_on_lines = false;
  CHECK_FALSE(contours_of(map, square_frame, look, Occupancy(square_frame.rect))[0].value);
}

TEST_CASE("values on contours cover no marker, no line and no other value, whatever the map") {
  std::mt19937 random(7);
  int values = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const auto figure = random_figure(random);
    const auto layout = lay_out(figure);
    for (const auto& box : layout.boxes) values += box.kind == Box::Kind::value;
    for (const auto& finding : review(figure, layout)) {
      CAPTURE(trial, name(finding.kind));
      FAIL_CHECK(finding.what);
    }
  }
  CHECK(values > 60 * 4);
}

TEST_CASE("values on contours have as many decimals as tell them apart") {
  using Texts = std::vector<std::string>;
  CHECK(value_texts({0.2, 0.4, 0.6}) == Texts{"$0.2$", "$0.4$", "$0.6$"});
  CHECK(value_texts({1.0 / 3, 2.0 / 3}) == Texts{"$0.33$", "$0.67$"});
  CHECK(value_texts({-0.5, 0, 0.5}) == Texts{"$-0.5$", "$0.0$", "$0.5$"});
  CHECK(value_texts({100, 200}) == Texts{"$100$", "$200$"});
  CHECK(value_texts({2e-5, 4e-5}) == Texts{"$2\\times10^{-5}$", "$4\\times10^{-5}$"});
  CHECK(value_texts({1.5e7}) == Texts{"$15000000$"});
  CHECK(value_texts({0}) == Texts{"$0$"});
  CHECK(value_texts({}).empty());
}

TEST_CASE("levels of a recipe ascend, and are given one way") {
  const auto read = [](const std::string& keys) {
    const auto text =
        parse_toml("[plot]\n[[plot.panel]]\nmap = { series = \"a\", " + keys + " }\n", "f.toml");
    TomlReader reader(text, "f.toml");
    PlotRecipe recipe;
    reader.section("plot", recipe);
    reader.finish();
    return recipe;
  };
  CHECK(read("levels = [0.5, 1], contour_labels = false").panels[0].map->levels ==
        std::vector<double>{0.5, 1});
  CHECK_THROWS_WITH(read("levels = [1, 1]"), Catch::Contains("levels: must ascend"));
  CHECK_THROWS_WITH(read("levels = [1], contours = 2"), Catch::Contains("give contours or levels, not both"));
}

}  // namespace contours_tests
