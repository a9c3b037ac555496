// Phase diagrams: which cell has which tint, where two meet, which cells have markers; and bands between lines of equal value.
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "common/error.hpp"
#include "plot/cells.hpp"
#include "plot/contours.hpp"
#include "plot/layout.hpp"
#include "plot/map.hpp"
#include "plot/recipe.hpp"
#include "plot/referee.hpp"

namespace cells_tests {
using namespace chute;
using namespace chute::plot;

namespace {

Series phase(const std::string& name) {
  Series s;
  s.name = name, s.kind = Kind::cells;
  return s;
}

/// Two phases on either side of a line, on a grid of nx by ny.
Panel two_phases(int nx, int ny, Scale scale = Scale::linear) {
  Panel panel;
  panel.x.scale = scale;
  panel.x.label = "$x$", panel.y.label = "$y$", panel.parameters = "$z=1$";
  panel.series = {phase("flows"), phase("stops")};
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      auto& s = panel.series[i > j * nx / ny ? 0 : 1];
      s.x.push_back(scale == Scale::log ? std::pow(2.0, i) : i), s.y.push_back(10 * j);
    }
  return panel;
}

/// The tint at a point of the page; the last that was painted there.
std::optional<Color> tint_at(const DisplayList& list, Point p) {
  std::optional<Color> found;
  for (const auto& tag : list.tags) {
    if (tag.kind != Tag::Kind::area) continue;
    const auto& fill = std::get<FillItem>(list.items[tag.first]);
    for (std::size_t k = 0; k + 3 < fill.path.points.size(); k += 4) {
      Rect cell = Rect::nothing();
      for (std::size_t c = 0; c < 4; ++c) cell.include(fill.path.points[k + c]);
      if (cell.contains(p)) found = fill.color;
    }
  }
  return found;
}
bool is_same_color(Color a, Color b) {
  return std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b) < 1e-9;
}

std::vector<Point> markers_of(const DisplayList& list, const std::string& series) {
  std::vector<Point> found;
  for (const auto& tag : list.tags) {
    if (tag.kind != Tag::Kind::marker || tag.series != series) continue;
    Rect all = Rect::nothing();
    for (std::size_t i = tag.first; i < tag.last; ++i) {
      if (const auto* fill = std::get_if<FillItem>(&list.items[i])) all.include(fill->path.bounds());
      if (const auto* stroke = std::get_if<StrokeItem>(&list.items[i])) all.include(stroke->path.bounds());
    }
    found.push_back(all.centre());
  }
  return found;
}

Rect first_frame(const Layout& layout) {
  for (const auto& box : layout.boxes)
    if (box.kind == Box::Kind::frame) return box.rect;
  return {};
}

}  // namespace

TEST_CASE("every place of the plane has the tint of the nearest point of the grid") {
  for (const Scale scale : {Scale::linear, Scale::log}) {
    Figure figure;
    figure.panels = {two_phases(5, 4, scale)};
    figure.panels[0].x.min = scale == Scale::log ? std::pow(2.0, -0.5) : -0.5;
    figure.panels[0].x.max = scale == Scale::log ? std::pow(2.0, 4.5) : 4.5;
    figure.panels[0].y.min = -5, figure.panels[0].y.max = 35;
    const auto layout = lay_out(figure);
    const auto looks = assign_looks(figure, look_of(figure));
    const Rect frame = first_frame(layout);
    for (double fx = 0.01; fx < 1; fx += 0.04)
      for (double fy = 0.01; fy < 1; fy += 0.05) {
        const double i = std::round(5 * fx - 0.5), j = std::round(4 * fy - 0.5);
        if (std::abs(5 * fx - std::round(5 * fx)) < 0.01 || std::abs(4 * fy - std::round(4 * fy)) < 0.01)
          continue;
        const auto* owner = i > std::floor(j * 5 / 4) ? "flows" : "stops";
        const auto tint =
            tint_at(layout.list, {frame.left + fx * frame.width(), frame.bottom - fy * frame.height()});
        CAPTURE(fx, fy, owner);
        REQUIRE(tint);
        CHECK(is_same_color(*tint, cell_tint(looks.at(owner).color, layout.list.background)));
      }
    for (const auto& finding : review(figure, layout)) FAIL_CHECK(finding.what);
    CHECK(markers_of(layout.list, "flows").size() == figure.panels[0].series[0].x.size());
    CHECK(markers_of(layout.list, "stops").size() == figure.panels[0].series[1].x.size());
  }
}

TEST_CASE("a place without a row stays blank, and two rows at one place are refused") {
  auto panel = two_phases(5, 4);
  auto& s = panel.series[1];
  for (std::size_t k = 0; k < s.x.size(); ++k)
    if (s.x[k] == 1 && s.y[k] == 30) s.x.erase(s.x.begin() + long(k)), s.y.erase(s.y.begin() + long(k));
  panel.x.min = -0.5, panel.x.max = 4.5, panel.y.min = -5, panel.y.max = 35;
  Figure figure;
  figure.panels = {panel};
  const auto layout = lay_out(figure);
  const Rect frame = first_frame(layout);
  CHECK_FALSE(
      tint_at(layout.list, {frame.left + 0.3 * frame.width(), frame.bottom - 0.875 * frame.height()}));
  CHECK(tint_at(layout.list, {frame.left + 0.1 * frame.width(), frame.bottom - 0.875 * frame.height()}));
  panel.series[0].x.push_back(0), panel.series[0].y.push_back(0);
  CHECK_THROWS_WITH(cell_grid(panel), Catch::Contains("both have a row at x = 0, y = 0"));
}

TEST_CASE("in fine grids markers stay apart, and every region has one") {
  auto panel = two_phases(120, 90);
  // an island of one cell, far from where thinned markers stand by chance
  panel.series.push_back(phase("island"));
  auto& flows = panel.series[0];
  const auto at = flows.x.size() / 3;
  panel.series[2].x = {flows.x[at]}, panel.series[2].y = {flows.y[at]};
  flows.x.erase(flows.x.begin() + long(at)), flows.y.erase(flows.y.begin() + long(at));
  Figure figure;
  figure.panels = {panel};
  const auto layout = lay_out(figure);
  CHECK(markers_of(layout.list, "island").size() == 1);
  std::vector<Point> all = markers_of(layout.list, "flows");
  const auto others = markers_of(layout.list, "stops");
  all.insert(all.end(), others.begin(), others.end());
  CHECK(all.size() > 40);
  CHECK(all.size() < 1000);
  const double size = look_of(figure).marker_size;
  for (std::size_t a = 0; a < all.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) CHECK((all[a] - all[b]).norm() > 1.8 * size);
  for (const auto& finding : review(figure, layout)) FAIL_CHECK(finding.what);
}

TEST_CASE("lines run where phases meet, and nowhere else") {
  auto panel = two_phases(5, 4);
  panel.x.min = -0.5, panel.x.max = 4.5, panel.y.min = -5, panel.y.max = 35;
  Figure figure;
  figure.panels = {panel};
  const auto grid = cell_grid(panel);
  DisplayList list;
  const Rect page{0, 0, 500, 400};
  Occupancy occupied(page);
  const Look look = look_of(figure);
  Painter painter{list, look, occupied};
  draw_cells(painter, {page, {-0.5, 4.5, Scale::linear}, {-5, 35, Scale::linear}}, panel, grid,
             assign_looks(figure, look));
  double length = 0;
  for (const auto& item : list.items) {
    const auto* stroke = std::get_if<StrokeItem>(&item);
    if (!stroke || stroke->path.verbs.size() % 2 || stroke->stroke.cap != Cap::square) continue;
    for (std::size_t k = 0; k + 1 < stroke->path.points.size(); k += 2)
      length += (stroke->path.points[k + 1] - stroke->path.points[k]).norm();
  }
  // "stops" ends behind column 0, 1, 2, 3 in rows 0 to 3: four uprights and three steps of one cell, 100 by 100 points each
  CHECK(length == Approx(4 * 100 + 3 * 100));
}

TEST_CASE("rows that lie on no grid make no cells") {
  Series s;
  s.name = "anywhere", s.kind = Kind::cells;
  for (int i = 0; i < 1001; ++i) s.x.push_back(i), s.y.push_back(i * 10 % 1001);
  Plot plot;
  plot.series = {s};
  CHECK_THROWS_WITH(cell_grid(plot),
                    Catch::Contains("1001 values of x and 1001 of y make more than 1000000 cells"));
  plot.series[0].x.pop_back(), plot.series[0].y.pop_back();
  CHECK(cell_grid(plot).owner.size() == 1000 * 1000);
}

TEST_CASE("a recipe makes a phase diagram of a sweep's rows, which fills its frame") {
  const auto text = parse_toml("[plot]\nkind = \"cells\"\nx = { label = \"$x$\" }\n", "fig.toml");
  TomlReader reader(text, "fig.toml");
  PlotRecipe recipe;
  reader.section("plot", recipe);
  reader.finish();
  const auto figure =
      figure_from(recipe, read::parse_table("panel,series,x,y\n,steady,0.1,2\n,stopped,0.2,2\n,steady,0.1,3\n"
                                            ",x unsettled,0.2,3\n",
                                            "fig.csv"));
  const auto& panel = figure.panels[0];
  CHECK(panel.series.size() == 3);
  for (const auto& s : panel.series) CHECK(s.kind == Kind::cells);
  CHECK(*panel.x.min == Approx(0.05));
  CHECK(*panel.x.max == Approx(0.25));
  CHECK(*panel.y.min == Approx(1.5));
  const auto layout = lay_out(figure);
  int legends = 0;
  for (const auto& box : layout.boxes)
    if (box.kind == Box::Kind::legend) {
      ++legends;
      CHECK_FALSE(box.rect.overlaps(first_frame(layout)));
    }
  CHECK(legends == 1);
}

TEST_CASE("names of phases stand in place of markers, and numbers at the ends of a colour bar on the page") {
  Figure figure;
  figure.panels = {two_phases(60, 40)};
  figure.panels[0].notes = {{"flows freely", 40, 100, false, {}, {}, {}},
                            {"stops", 0.2, 0.8, true, {}, {}, {}}};
  for (const auto& finding : review(figure, lay_out(figure))) FAIL_CHECK(finding.what);
  Figure field;
  field.panels.resize(1);
  auto& panel = field.panels[0];
  panel.x.label = "$x$", panel.y.label = "$y$", panel.parameters = "$z=1$";
  panel.x.min = panel.y.min = 0, panel.x.max = panel.y.max = 2.7;
  panel.map = Map{{0, 1, 2}, {0, 1, 2}, {0, 1, 0, 1, 0, 1, 0, 1, 0}, 0, 1, "$w$", false, false, 3, 4, {}};
  for (const auto& finding : review(field, lay_out(field))) FAIL_CHECK(finding.what);
}

TEST_CASE("bands end where the value is that of their line") {
  // z = x + 2 y is linear, so that triangles have it exactly: of the square from 0 to 1 z < c takes c²/4 up to c = 1
  Map map;
  for (int k = 0; k <= 6; ++k) map.x.push_back(k / 6.0), map.y.push_back(k / 6.0);
  for (const double y : map.y)
    for (const double x : map.x) map.values.push_back(x + 2 * y);
  map.filled = 6, map.contours = 5;
  DisplayList list;
  const Frame frame{{0, 0, 100, 100}, {0, 1, Scale::linear}, {0, 1, Scale::linear}};
  draw_map(list, frame, map);
  const Look look = look_of(Style::journal);
  Occupancy occupied(frame.rect);
  Painter painter{list, look, occupied};
  map.values_on_lines = false;
  draw_contours(painter, frame, contours_of(map, frame, look, occupied));
  std::vector<double> areas;
  std::size_t lines = 0;
  for (const auto& item : list.items) {
    if (const auto* stroke = std::get_if<StrokeItem>(&item)) {
      ++lines;
      for (const auto& p : stroke->path.points)
        CHECK(p.x() / 100 + 2 * (1 - p.y() / 100) == Approx(0.5 * double(lines)));
    }
    const auto* fill = std::get_if<FillItem>(&item);
    if (!fill) continue;
    // the shoelace formula over every part
    double area = 0;
    std::size_t begin = 0, end = 0;
    for (const auto verb : fill->path.verbs) {
      if (verb == Path::Verb::move) begin = end;
      if (verb != Path::Verb::close) {
        ++end;
        continue;
      }
      double part = 0;
      for (std::size_t k = begin; k < end; ++k) {
        const Point a = fill->path.points[k], b = fill->path.points[k + 1 < end ? k + 1 : begin];
        part += (a.x() * b.y() - b.x() * a.y()) / 2;
      }
      CHECK(part <= 1e-9);  // all turn the same way, or they would cut holes
      area += std::abs(part);
    }
    areas.push_back(area / 1e4);
  }
  REQUIRE(areas.size() == 6);
  CHECK(lines == 5);
  const auto below = [](double c) {
    const double over = std::max(0.0, c - 1);
    return c <= 2 ? (c * c - over * over) / 4 : 1 - (3 - c) * (3 - c) / 4;
  };
  for (int k = 0; k < 6; ++k) CHECK(areas[std::size_t(k)] == Approx(1 - below(0.5 * k)));
  map.values[8] = unknown;  // the four cells about it are blank
  DisplayList with_hole;
  draw_map(with_hole, frame, map);
  const auto& lowest = std::get<FillItem>(with_hole.items[0]);
  for (const auto& p : lowest.path.points)
    CHECK((p.x() > 100 / 3.0 - 1e-9 || p.y() < 100 - 100 / 3.0 + 1e-9));
}

}  // namespace cells_tests
