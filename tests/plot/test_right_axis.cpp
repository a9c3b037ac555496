// Second axes of y and of x: their series count along them, their ticks say what they are; notes with arrows point where they should.
#include <catch2/catch.hpp>
#include <cmath>

#include "common/error.hpp"
#include "plot/layout.hpp"
#include "plot/recipe.hpp"
#include "plot/referee.hpp"

namespace right_axis_tests {
using namespace chute;
using namespace chute::plot;

namespace {

Figure figure_of(const std::string& plot) {
  const auto text =
      parse_toml("[plot]\nx = { label = \"$t$\" }\ny = { label = \"$v$\" }\n" + plot, "fig.toml");
  TomlReader reader(text, "fig.toml");
  PlotRecipe recipe;
  reader.section("plot", recipe);
  reader.finish();
  recipe.source = "fig.toml";
  return figure_from(
      recipe, read::parse_table("# parameters: e_n=0.5\npanel,series,x,y\n,v_x,0,0\n,v_x,1,0.5\n,v_x,2,1\n"
                                ",energy,0,40\n,energy,1,30\n,energy,2,20\n",
                                "fig.csv"));
}

constexpr const char* with_right =
    "right = { label = \"$E$\", factor = 10, min = 150, max = 450 }\n[[plot.series]]\nmatch = \"energy\"\naxis = \"right\"\n";

}  // namespace

TEST_CASE("points of the second axis stand at its ticks") {
  auto figure = figure_of(with_right);
  const auto layout = lay_out(figure);
  const auto& panel = figure.panels[0];
  REQUIRE(panel.right);
  CHECK(panel.series[1].y == std::vector<double>{400, 300, 200});
  CHECK(panel.series[1].label == "energy (right)");
  Rect frame;
  for (const auto& box : layout.boxes)
    if (box.kind == Box::Kind::frame) frame = box.rect;
  std::map<std::string, double> left, right;
  for (const auto& box : layout.boxes) {
    if (box.kind != Box::Kind::tick_label) continue;
    const auto text = box.text.substr(1, box.text.size() - 2);  // $300$
    if (box.rect.left > frame.right) right[text] = box.rect.centre().y();
    if (box.rect.right < frame.left) left[text] = box.rect.centre().y();
  }
  REQUIRE(right.count("300"));
  CHECK(right.at("200") > right.at("300"));  // larger values stand higher
  int found = 0;
  for (const auto& tag : layout.list.tags) {
    if (tag.kind != Tag::Kind::marker) continue;
    const auto* fill = std::get_if<FillItem>(&layout.list.items[tag.first]);
    REQUIRE(fill);
    const Point at = fill->path.bounds().centre();
    if (tag.series == "energy" && std::abs(at.x() - frame.centre().x()) < 0.4 * frame.width() / 2) {
      CHECK(at.y() == Approx(right.at("300")).margin(0.6));
      ++found;
    }
    if (tag.series == "v_x" && std::abs(at.x() - frame.centre().x()) < 0.4 * frame.width() / 2) {
      CHECK(at.y() == Approx((left.begin()->second + left.rbegin()->second) / 2).margin(0.6));
      ++found;
    }
  }
  CHECK(found == 2);
  for (const auto& finding : review(figure, layout)) FAIL_CHECK(finding.what);
}

TEST_CASE("what cannot be on the right is told") {
  CHECK_THROWS_WITH(figure_of("[[plot.panel]]\nright = { label = \"$E$\" }\n"),
                    Catch::Contains("no series of this panel has axis = \"right\""));
  CHECK_THROWS_WITH(figure_of("[[plot.series]]\nmatch = \"energy\"\naxis = \"top\"\n"),
                    Catch::Contains("fig.toml:6: plot.series[0].axis"));
}

TEST_CASE("a note's arrow ends where it points, in the note's colour") {
  const auto figure = figure_of(
      "[[plot.panel]]\nnote = [{ text = \"here\", x = 0.3, y = 30, arrow = [1, 30], color = \"#c00000\", size = 8 }]\n");
  const auto layout = lay_out(figure);
  const FillItem* head = nullptr;
  for (const auto& item : layout.list.items)
    if (const auto* fill = std::get_if<FillItem>(&item); fill && fill->path.points.size() == 3) head = fill;
  REQUIRE(head);
  CHECK(head->color.r == Approx(0xc0 / 255.0));
  Point place{0, 0};
  for (const auto& tag : layout.list.tags)
    if (tag.kind == Tag::Kind::marker && tag.series == "energy") {
      const auto* fill = std::get_if<FillItem>(&layout.list.items[tag.first]);
      if (fill && std::abs(fill->path.bounds().centre().x() - head->path.points[0].x()) < 1)
        place = fill->path.bounds().centre();
    }
  CHECK((head->path.points[0] - place).norm() < 0.7);
  CHECK_THROWS_WITH(
      lay_out(figure_of("[[plot.panel]]\nnote = [{ text = \"here\", x = 1, y = 30, arrow = [5, 30] }]\n")),
      Catch::Contains("points out of its panel"));
}

TEST_CASE("axes twice both ways: points of the second axis of x stand at its ticks, and nothing overlaps") {
  auto figure = figure_of(
      "right = { label = \"$E$\", factor = 10, min = 150, max = 450 }\n"
      "top = { label = \"$s$ (m)\", factor = 1e-5, min = -0.1e-5, max = 2.1e-5 }\n"
      "[[plot.series]]\nmatch = \"energy\"\naxis = \"right\"\nx_axis = \"top\"\n");
  const auto layout = lay_out(figure);
  const auto& panel = figure.panels[0];
  REQUIRE(panel.top);
  CHECK(panel.series[1].x == std::vector<double>{0, 1e-5, 2e-5});
  CHECK(panel.series[0].x == std::vector<double>{0, 1, 2});
  CHECK(panel.series[1].label == "energy (right, top)");
  Rect frame;
  for (const auto& box : layout.boxes)
    if (box.kind == Box::Kind::frame) frame = box.rect;
  std::map<std::string, double> above;
  bool factor = false;
  for (const auto& box : layout.boxes) {
    if (box.kind == Box::Kind::tick_label && box.rect.bottom < frame.top)
      above[box.text.substr(1, box.text.size() - 2)] = box.rect.centre().x();
    factor |= box.kind == Box::Kind::factor && box.rect.bottom < frame.top && box.text == "$\\times10^{-5}$";
  }
  CHECK(factor);
  REQUIRE(above.count("1.0"));
  CHECK(above.at("0.0") < above.at("1.0"));
  int found = 0;
  for (const auto& tag : layout.list.tags) {
    if (tag.kind != Tag::Kind::marker || tag.series != "energy") continue;
    const auto* fill = std::get_if<FillItem>(&layout.list.items[tag.first]);
    REQUIRE(fill);
    const double x = fill->path.bounds().centre().x();
    const char* ticks[] = {"0.0", "1.0", "2.0"};
    CHECK(x == Approx(above.at(ticks[found])).margin(0.6));
    ++found;
  }
  CHECK(found == 3);
  for (const auto& finding : review(figure, layout)) FAIL_CHECK(finding.what);
}

TEST_CASE("what cannot be above is told") {
  CHECK_THROWS_WITH(figure_of("[[plot.panel]]\ntop = { label = \"$s$\" }\n"),
                    Catch::Contains("no series of this panel has x_axis = \"top\""));
  CHECK_THROWS_WITH(figure_of("[[plot.series]]\nmatch = \"energy\"\nx_axis = \"right\"\n"),
                    Catch::Contains("fig.toml:6: plot.series[0].x_axis"));
}

}  // namespace right_axis_tests
