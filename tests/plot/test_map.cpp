// Maps: colours of known values, rows from a table, contours where the values say, and a colour bar that has room.
#include <catch2/catch.hpp>
#include <set>

#include "common/error.hpp"
#include "plot/layout.hpp"
#include "plot/map.hpp"
#include "plot/recipe.hpp"

namespace map_tests {
using namespace chute;
using namespace chute::plot;

namespace {

Map ramp(int n) {
  Map map;
  for (int i = 0; i < n; ++i) map.x.push_back(i + 0.5), map.y.push_back(i + 0.5);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) map.values.push_back(i);
  return map;
}
bool same(Color a, Color b) { return std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b) < 1e-9; }

}  // namespace

TEST_CASE("the ends of a map have the ends of its colours, and white is 0 where signs differ") {
  CHECK(same(map_color(0, false), Color::hex(0x440154)));
  CHECK(same(map_color(1, false), Color::hex(0xfde725)));
  CHECK(same(map_color(7, false), Color::hex(0xfde725)));
  CHECK(same(map_color(0.5, true), Color::hex(0xf7f7f7)));
  auto map = ramp(4);
  CHECK(range_of(map).low == 0);
  CHECK(range_of(map).high == 3);
  map.diverging = true;
  CHECK(range_of(map).low == -3);
  map.high = 5;
  CHECK(range_of(map).high == 5);
}

TEST_CASE("figures of any doubles have a page: along axes and in colours") {
  constexpr double most = std::numeric_limits<double>::max(),
                   least = std::numeric_limits<double>::denorm_min();
  const std::pair<double, double> ranges[] = {{-most, most},      {1e308, std::nextafter(1e308, most)},
                                              {1e308, most},      {-most, 1},
                                              {least, 4 * least}, {0, least},
                                              {least, most},      {-least, least}};
  for (const auto& [low, high] : ranges)
    for (const auto scale : {Scale::linear, Scale::log})
      for (const bool with_map : {false, true}) {
        INFO(low << " to " << high << (scale == Scale::log ? " log" : "") << (with_map ? " map" : ""));
        Figure figure;
        figure.panels.resize(1);
        auto& panel = figure.panels[0];
        if (with_map) {
          panel.map = ramp(2);
          panel.map->values = {low, high, low, high};
          panel.map->contours = 2;
        } else {
          panel.x.scale = panel.y.scale = scale;
          Series series;
          series.name = "a", series.label = "a";
          series.x = {low, high}, series.y = {high, low};
          panel.series = {series};
          panel.legend = Place::top_right;
        }
        const auto page = lay_out(figure).list;
        CHECK(std::isfinite(page.width));
        CHECK(std::isfinite(page.height));
        for (const auto& item : page.items) {
          if (const auto* fill = std::get_if<FillItem>(&item))
            for (const auto& p : fill->path.points) REQUIRE((std::isfinite(p.x()) && std::isfinite(p.y())));
          if (const auto* stroke = std::get_if<StrokeItem>(&item))
            for (const auto& p : stroke->path.points) REQUIRE((std::isfinite(p.x()) && std::isfinite(p.y())));
        }
      }
}

TEST_CASE("cells are filled where they lie, joined along a row, and unknown ones stay blank") {
  auto map = ramp(4);
  map.values[5] = unknown;
  DisplayList list;
  const Frame frame{{0, 0, 400, 400}, {0, 4, Scale::linear}, {0, 4, Scale::linear}};
  draw_map(list, frame, map);
  // Which colour lies at a point of the page.
  const auto at = [&](double x, double y) {
    std::optional<Color> found;
    for (const auto& item : list.items)
      if (const auto* fill = std::get_if<FillItem>(&item))
        for (std::size_t k = 0; k + 3 < fill->path.points.size(); k += 4) {
          Rect cell = Rect::nothing();
          for (std::size_t c = 0; c < 4; ++c) cell.include(fill->path.points[k + c]);
          if (cell.contains(Point{x, y})) found = fill->color;
        }
    return found;
  };
  REQUIRE(at(50, 350));
  CHECK(same(*at(50, 350), map_color(0.5 / 96, false)));
  CHECK(same(*at(350, 50), map_color(95.5 / 96, false)));
  CHECK_FALSE(at(150, 250));  // second column, second row from below
}

TEST_CASE("a recipe makes a map of rows that are named by their place") {
  const auto text = parse_toml(
      "[plot]\n[[plot.panel]]\nlabel = \"a\"\nx = { label = \"$x$\" }\ny = { label = \"$t$\" }\n"
      "map = { series = \"density t=*\", label = \"density\", contours = 2 }\n",
      "fig.toml");
  TomlReader reader(text, "fig.toml");
  PlotRecipe recipe;
  reader.section("plot", recipe);
  reader.finish();
  const auto table = read::parse_table(
      "panel,series,x,y\na,density t=10,1,5\na,density t=10,2,6\na,density t=2.5,1,3\na,density t=2.5,2,4\na,mean,1,2\n",
      "fig.csv");
  const auto figure = figure_from(recipe, table);
  const auto& panel = figure.panels[0];
  REQUIRE(panel.map);
  CHECK(panel.map->x == std::vector<double>{1, 2});
  CHECK(panel.map->y == std::vector<double>{2.5, 10});
  CHECK(panel.map->values == std::vector<double>{3, 4, 5, 6});
  CHECK(panel.series.size() == 1);  // the mean is drawn over it
  CHECK(*panel.x.min == 0.5);
  const auto layout = lay_out(figure);
  for (const auto& a : layout.boxes) {
    CHECK(a.rect.right <= layout.list.width);
    for (const auto& b : layout.boxes)
      if (&a != &b && a.kind != Box::Kind::frame && b.kind != Box::Kind::frame) {
        CAPTURE(a.text, b.text);
        CHECK_FALSE(a.rect.overlaps(b.rect));
      }
  }
}

}  // namespace map_tests
