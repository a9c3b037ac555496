#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "common/toml_reader.hpp"
#include "plot/color_vision.hpp"
#include "plot/density.hpp"
#include "plot/factors.hpp"
#include "plot/layout.hpp"
#include "plot/marks.hpp"
#include "plot/parameters.hpp"
#include "plot/recipe.hpp"
#include "plot/referee.hpp"
#include "plot/style.hpp"

namespace referee_tests {
using namespace chute::plot;

namespace {

std::size_t count(const Figure& figure, const Layout& layout, Finding::Kind kind) {
  std::size_t n = 0;
  for (const auto& f : review(figure, layout)) n += f.kind == kind;
  return n;
}
std::size_t count(const Figure& figure, Finding::Kind kind) { return count(figure, lay_out(figure), kind); }

Series points(const std::string& name, std::vector<double> x, std::vector<double> y,
              Kind kind = Kind::markers) {
  Series s;
  s.name = name, s.kind = kind, s.x = std::move(x), s.y = std::move(y);
  return s;
}

Series slope(const std::string& name, double height, Kind kind) {
  Series s;
  s.name = name, s.kind = kind;
  for (int i = 0; i <= 8; ++i) s.x.push_back(0.1 * i), s.y.push_back(height * (1 + 0.1 * i));
  return s;
}

Figure one_panel(std::vector<Series> series) {
  Figure figure;
  figure.panels.resize(1);
  figure.panels[0].parameters = "$\\mu=0.5$";
  figure.panels[0].series = std::move(series);
  return figure;
}

std::size_t arrows(const Figure& figure) {
  std::size_t n = 0;
  for (const auto& tag : lay_out(figure).list.tags) n += tag.kind == Tag::Kind::beyond;
  return n;
}

}  // namespace

TEST_CASE("a palette's colours differ to deuteranopes, to protanopes and in grey, and from their ground") {
  // Known values first: grey stays grey, and pure red and green of one luminance are near to a deuteranope.
  const Color grey = Color::hex(0x808080);
  REQUIRE(difference(as_deuteranope(grey), grey) < 1);
  REQUIRE(difference(as_protanope(grey), grey) < 1);
  REQUIRE(lab_of(Color::hex(0xffffff)).l == Approx(100).margin(0.1));
  REQUIRE(lab_of(grey).l == Approx(53.59).margin(0.05));
  const Color red = Color::hex(0xD55E00),
              olive = Color::hex(0x9C8A00);  // which earlier palettes had side by side
  REQUIRE(difference(as_deuteranope(red), as_deuteranope(olive)) < 0.1 * difference(red, olive));

  for (const auto style : {Style::journal, Style::slides, Style::dark}) {
    const auto& look = look_of(style);
    REQUIRE(look.colors.size() == color_count);
    for (std::size_t i = 0; i < look.colors.size(); ++i) {
      REQUIRE(grey_difference(look.colors[i], look.paper) > 20);
      for (std::size_t k = i + 1; k < look.colors.size(); ++k) {
        const auto &a = look.colors[i], &b = look.colors[k];
        INFO("colours " << i << " and " << k);
        REQUIRE(difference(a, b) > 25);
        REQUIRE(difference(as_deuteranope(a), as_deuteranope(b)) > 15);
        REQUIRE(difference(as_protanope(a), as_protanope(b)) > 15);
        REQUIRE(grey_difference(a, b) > 7);
      }
    }
  }
}

TEST_CASE("the referee finds what is made wrong") {
  using F = Finding::Kind;
  auto figure = one_panel({slope("mu=0.1", 1, Kind::markers), slope("mu=0.3", 2, Kind::markers)});
  REQUIRE(review(figure, lay_out(figure)).empty());
  SECTION("no parameters") {
    figure.panels[0].parameters.clear();
    REQUIRE(count(figure, F::no_parameters) == 1);
  }
  SECTION("colour alone, and not even that") {
    for (auto& s : figure.panels[0].series) s.marker = 0;
    REQUIRE(count(figure, F::color_alone) == 1);
    for (auto& s : figure.panels[0].series) s.color = 2;
    REQUIRE((count(figure, F::color_alone) == 0 && count(figure, F::alike) == 1));
  }
  SECTION("lines of one dash") {
    for (auto& s : figure.panels[0].series) s.kind = Kind::line, s.dash = 0;
    REQUIRE(count(figure, F::color_alone) == 1);
    figure.panels[0].legend = Place::direct;  // but where each has its name
    REQUIRE(count(figure, F::color_alone) == 0);
  }
  SECTION("a marker that is gone, or moved onto the frame; a legend over a point") {
    auto layout = lay_out(figure);
    const auto marker = std::find_if(layout.list.tags.begin(), layout.list.tags.end(),
                                     [](const Tag& t) { return t.kind == Tag::Kind::marker; });
    Rect frame, legend;
    for (const auto& box : layout.boxes) {
      if (box.kind == Box::Kind::frame) frame = box.rect;
      if (box.kind == Box::Kind::legend) legend = box.rect;
    }
    const auto move_to = [&](Point to) {
      auto& path = std::get<FillItem>(layout.list.items[marker->first]).path;
      const Point from = path.bounds().centre();
      for (auto& p : path.points) p += to - from;
    };
    move_to({frame.left, frame.centre().y()});
    REQUIRE(count(figure, layout, F::marker_on_frame) == 1);
    move_to(legend.centre());
    REQUIRE(count(figure, layout, F::text_on_data) == 1);
    layout.list.tags.erase(marker);
    REQUIRE(count(figure, layout, F::point_lost) == 1);
  }
  SECTION("two texts at one place") {
    auto layout = lay_out(figure);
    auto copy = layout.boxes.back();
    layout.boxes.push_back(copy);
    REQUIRE(count(figure, layout, F::text_overlap) == 1);
  }
}

TEST_CASE("points outside given limits become arrows, and none is lost") {
  auto figure = one_panel({points("v", {0.5, 1, 2, 3, 9, 1.5, 2.5}, {1, 2, 3, 20, 1, -5, 2})});
  auto& panel = figure.panels[0];
  panel.x.min = 0, panel.x.max = 4, panel.y.min = 0, panel.y.max = 10;
  REQUIRE(arrows(figure) == 3);  // above, to the right, below
  REQUIRE(review(figure, lay_out(figure)).empty());
  panel.y.scale = Scale::log, panel.y.min = 0.1;
  REQUIRE(arrows(figure) == 3);  // what a logarithm cannot show lies below
  REQUIRE(count(figure, Finding::Kind::point_lost) == 0);
  panel.series[0].x.assign(50, 9), panel.series[0].y.assign(50, 2);  // at one place: one arrow for all
  REQUIRE(arrows(figure) == 1);
  REQUIRE(count(figure, Finding::Kind::point_lost) == 0);
  // bins too, but not empty ones
  figure = one_panel({points("n", {0.5, 1.5, 2.5, 3.5}, {1, 20, 2, 0}, Kind::bars)});
  figure.panels[0].y.max = 10, figure.panels[0].x.max = 3;
  REQUIRE(arrows(figure) == 1);
}

TEST_CASE("a panel whose points are mostly elsewhere is a fault") {
  auto figure = one_panel({points("v", {1, 2, 3, 4}, {1, 2, 3, 4})});
  figure.panels[0].y.max = 3.5;
  REQUIRE(arrows(figure) == 1);
  REQUIRE(review(figure, lay_out(figure)).empty());
  figure.panels[0].y.max = 1.5;
  REQUIRE(count(figure, Finding::Kind::mostly_outside) == 1);
}

TEST_CASE("a bin that is too high is an arrow, and no fault") {
  auto figure = one_panel({points("n", {0.5, 1.5, 2.5, 3.5}, {10, 1, 2, 1}, Kind::steps)});
  figure.panels[0].y.max = 3;
  REQUIRE(arrows(figure) == 1);
  REQUIRE(review(figure, lay_out(figure)).empty());
}

TEST_CASE("a legend says what a hollow marker means, also where whole series are told to be hollow") {
  auto figure = one_panel({slope("a", 1, Kind::both), slope("b", 2, Kind::both)});
  const auto samples = [&] {
    std::vector<std::string> names;
    for (const auto& tag : lay_out(figure).list.tags)
      if (tag.kind == Tag::Kind::sample) names.push_back(tag.series);
    return names;
  };
  REQUIRE(samples() == std::vector<std::string>{"$a$", "$b$"});
  figure.panels[0].series[0].hollow = true;
  REQUIRE(samples() == std::vector<std::string>{"$a$", "$b$", "not settled"});
}

TEST_CASE("numbers that change with the size of their frame leave no gap beside them") {
  // at one size the axis has ticks such as 0.5, which leave it the room for fewer, 0 and 1, and so on
  Figure figure = one_panel({slope("a", 1, Kind::line)});
  auto& s = figure.panels[0].series[0];
  s.x = {0, 1, 5}, s.y = {0, -0.39, 3.6};
  figure.panels[0].y.label = "$\\psi_f$";
  for (double width = 60; width < 110; width += 0.5) {
    figure.width = width;
    const auto layout = lay_out(figure);
    double label = 0, numbers = 1e9;
    for (const auto& box : layout.boxes) {
      if (box.kind == Box::Kind::axis_label) label = std::max(label, box.rect.right);
      if (box.kind == Box::Kind::tick_label && box.rect.right < layout.list.width / 3)
        numbers = std::min(numbers, box.rect.left);
    }
    INFO("width " << width);
    REQUIRE(numbers - label < 6);  // points
    REQUIRE(review(figure, layout).empty());
  }
}

TEST_CASE("wherever limits and points are, no marker is cut and no point is lost") {
  std::mt19937_64 engine(11);
  const auto uniform = [&] { return static_cast<double>(engine() >> 11) / 9007199254740992.0; };
  for (int i = 0; i < 400; ++i) {
    Figure figure;
    figure.width = i % 2 ? 86 : 178, figure.columns = i % 2 ? 1 : 1 + i % 3;
    for (int p = 0; p < figure.columns; ++p) {
      Panel panel;
      panel.label = std::string(1, static_cast<char>('a' + p));
      panel.x.label = p ? "$x$" : "$t$", panel.y.label = i % 3 ? "$y$" : "";
      for (int k = 0; k < 3; ++k) {
        auto s = points("mu=" + std::to_string(k), {}, {},
                        k == 0   ? Kind::dots
                        : k == 1 ? Kind::markers
                                 : Kind::both);
        for (int n = 0; n < 12; ++n)  // many exactly at round numbers, where limits are
          s.x.push_back(std::round(8 * uniform()) / 8),
              s.y.push_back(n % 3 ? std::round(4 * uniform()) / 4 : uniform());
        panel.series.push_back(s);
      }
      if (i % 4) panel.x.min = 0, panel.x.max = i % 5 ? 1 : 0.75;
      if (i % 7) panel.y.min = i % 2 ? 0 : 0.25, panel.y.max = 1;
      if (i % 11 == 0) panel.y.scale = Scale::log, panel.y.min = 0.1;
      figure.panels.push_back(panel);
    }
    const auto layout = lay_out(figure);
    INFO("figure " << i);
    for (const auto& f : review(figure, layout)) {
      INFO(name(f.kind) << " in panel " << f.panel << " of " << figure.columns << ": " << f.what);
      REQUIRE(f.kind != Finding::Kind::marker_on_frame);
      REQUIRE(f.kind != Finding::Kind::point_lost);
    }
  }
}

TEST_CASE("names that make a table have one entry for each row and column") {
  std::vector<Series> series;
  double height = 1;
  for (const char* phi : {"Phi=1.75", "Phi=2.25", "Phi=3"})
    for (const char* e_n : {"e_n=0.1", "e_n=0.5", "e_n=0.7"})
      series.push_back(slope(std::string(e_n) + " " + phi, height += 0.5, Kind::markers));
  auto figure = one_panel(series);
  const auto factors = factors_in(figure, -1);
  REQUIRE(factors);
  REQUIRE((factors->colors.size() == 3 && factors->styles.size() == 3 && !factors->has_lines));
  const auto looks = assign_looks(figure, look_of(Style::journal));
  const auto& a = looks.at("e_n=0.1 Phi=3");
  REQUIRE((a.marker == looks.at("e_n=0.7 Phi=3").marker && a.fill != looks.at("e_n=0.7 Phi=3").fill));
  REQUIRE((a.fill == looks.at("e_n=0.1 Phi=2.25").fill && a.marker != looks.at("e_n=0.1 Phi=2.25").marker));
  const auto samples = [&] {
    std::size_t n = 0;
    for (const auto& tag : lay_out(figure).list.tags) n += tag.kind == Tag::Kind::sample;
    return n;
  };
  REQUIRE(samples() == 6);
  REQUIRE(review(figure, lay_out(figure)).empty());
  // of which only starts that part are left: it keeps its place, and hollow gets an entry
  auto parted = figure;
  parted.panels[0].series.back().name += " apart";
  const auto parted_looks = assign_looks(parted, look_of(Style::journal));
  const auto &last = parted_looks.at("e_n=0.7 Phi=3 apart"), &beside = parted_looks.at("e_n=0.1 Phi=3");
  REQUIRE((last.hollow && last.marker == beside.marker));
  std::size_t entries = 0;
  for (const auto& tag : lay_out(parted).list.tags) entries += tag.kind == Tag::Kind::sample;
  REQUIRE(entries == 7);
  // with lines of a theory among them the colours are told at the curves
  auto& all = figure.panels[0].series;
  for (int k = 0; k < 3; ++k) {
    auto theory = slope(std::string("theory ") + (k == 0   ? "Phi=1.75"
                                                  : k == 1 ? "Phi=2.25"
                                                           : "Phi=3"),
                        2 + 1.5 * k, Kind::line);
    for (auto& s : all)
      if (s.name.ends_with(theory.name.substr(7)))
        for (std::size_t i = 0; i < s.y.size(); ++i) s.y[i] = theory.y[i];
    all.push_back(theory);
  }
  REQUIRE(factors_in(figure, -1)->has_lines);
  REQUIRE(count(figure, Finding::Kind::color_alone) == 0);
  REQUIRE(samples() == 4);
  // what asks for a colour of its own is left alone
  all[0].color = 3;
  REQUIRE_FALSE(factors_in(figure, -1));
}

TEST_CASE("lines of a table whose names find no room beside them get markers, and the legend has these") {
  // so many lines so near to each other that no name fits between
  std::vector<Series> series;
  double height = 1;
  for (const char* phi : {"Phi=1", "Phi=2", "Phi=3", "Phi=4"})
    for (const char* method : {"soft", "hard"})
      series.push_back(slope(std::string(method) + " " + phi, height += 0.02, Kind::line));
  for (auto& s : series)  // all over the panel
    for (std::size_t i = 0; i < s.x.size(); ++i) s.y[i] = height - s.y[i] + (i % 2 ? 1.0 : -1.0) * 3;
  auto figure = one_panel(series);
  figure.width = 60;
  REQUIRE(factors_in(figure, -1)->has_lines);
  const auto layout = lay_out(figure);
  std::size_t named = 0;
  for (const auto& tag : layout.list.tags) named += tag.kind == Tag::Kind::named;
  REQUIRE(named == 0);
  REQUIRE(count(figure, layout, Finding::Kind::color_alone) == 0);
  REQUIRE(count(figure, layout, Finding::Kind::alike) == 0);
  // a sample of a colour has its marker, one of a method none
  std::size_t marked = 0;
  for (const auto& tag : layout.list.tags)
    if (tag.kind == Tag::Kind::sample) marked += tag.last - tag.first > 1;
  REQUIRE(marked == 4);
}

TEST_CASE(
    "a part that the averages do not count looks as the whole does, hollow, and has one entry for all") {
  auto figure =
      one_panel({slope("e_n=0.4", 1, Kind::both), slope("e_n=0.8", 2, Kind::both),
                 slope("e_n=0.4 unsettled", 3, Kind::markers), slope("e_n=0.8 unsettled", 4, Kind::markers)});
  const auto looks = assign_looks(figure, look_of(Style::journal));
  const auto &whole = looks.at("e_n=0.8"), &part = looks.at("e_n=0.8 unsettled");
  REQUIRE((whole.marker == part.marker && !whole.hollow && part.hollow));
  REQUIRE((whole.color.r == part.color.r && whole.color.b == part.color.b));
  std::size_t samples = 0;
  for (const auto& tag : lay_out(figure).list.tags) samples += tag.kind == Tag::Kind::sample;
  REQUIRE(samples == 3);
  REQUIRE(review(figure, lay_out(figure)).empty());
}

TEST_CASE("what is in doubt stretches an axis a little, and is an arrow where it lies farther off") {
  auto figure = one_panel({points("v", {0, 1, 2, 3}, {1, 2, 3, 5})});
  auto& panel = figure.panels[0];
  const double just_below_the_end = 5 - 1e-3, a_little_above = 5 + 0.25 * (5 - 1),
               far_above = 5 + 0.4 * (5 - 1);
  panel.series.push_back(points("v unsettled", {1, 2}, {just_below_the_end, a_little_above}));
  REQUIRE(arrows(figure) == 0);
  REQUIRE(review(figure, lay_out(figure)).empty());  // none is cut by the frame
  panel.series.back() = points("v unsettled", {1, 2}, {just_below_the_end, far_above});
  REQUIRE(arrows(figure) == 1);
  REQUIRE(review(figure, lay_out(figure)).empty());
  // on a logarithmic axis the same in decades: one of the decade's third, not of the whole
  panel.y.scale = Scale::log;
  panel.series[0].y = {1, 2, 5, 10}, panel.series.back().y = {3, 10 * std::pow(10, 0.25)};
  REQUIRE(arrows(figure) == 0);
  panel.series.back().y = {3, 10 * std::pow(10, 0.4)};
  REQUIRE(arrows(figure) == 1);
}

TEST_CASE("an inset keeps off the data where there is room, and the referee finds one that does not") {
  // a curve through the corner that is asked for
  auto figure = one_panel({slope("a", 1, Kind::line)});
  auto& panel = figure.panels[0];
  panel.series[0].x = {0, 0.3, 1}, panel.series[0].y = {0, 1, 1};
  panel.legend = Place::off;
  Inset& inset = panel.insets.emplace_back();
  inset.plot.series = panel.series, inset.place = Place::top_left;
  REQUIRE(review(figure, lay_out(figure)).empty());
  inset.width = 0.85, inset.height = 0.8;  // room nowhere
  REQUIRE(count(figure, Finding::Kind::text_on_data) == 1);
}

TEST_CASE("a legend asked into a corner keeps off a line there, and the referee finds one that does not") {
  auto figure = one_panel({slope("a", 1, Kind::line), slope("b", 1.02, Kind::line)});
  auto& panel = figure.panels[0];
  panel.x.min = 0, panel.x.max = 1, panel.y.min = 0;
  panel.legend = Place::top_left;
  for (const double at : {0.1, 0.25}) panel.references.push_back({Reference::Kind::vertical, at, ""});
  REQUIRE(review(figure, lay_out(figure)).empty());
  for (double at = 0.05; at < 1; at += 0.1) panel.references.push_back({Reference::Kind::vertical, at, ""});
  REQUIRE(count(figure, Finding::Kind::text_on_data) == 1);  // where there is no room
}

TEST_CASE("a line's name keeps off the frame's ticks") {
  auto figure = one_panel({points("v", {-0.2, 0, 0.2}, {1, 2, 3})});
  auto& panel = figure.panels[0];
  panel.x.min = -0.22, panel.x.max = 0.22;
  for (const double at : {-0.2, 0.2})
    panel.references.push_back({Reference::Kind::vertical, at, "$\\gamma$"});
  const auto layout = lay_out(figure);
  Rect frame;
  for (const auto& box : layout.boxes)
    if (box.kind == Box::Kind::frame) frame = box.rect;
  std::size_t names = 0;
  for (const auto& box : layout.boxes) {
    if (box.kind != Box::Kind::note) continue;
    ++names;
    REQUIRE(frame.grown(-look_of(Style::journal).major_tick).contains(box.rect));
  }
  REQUIRE(names == 2);
}

TEST_CASE("a crowd of dots becomes a density that holds all of them") {
  Panel panel;
  auto s = points("impacts", {}, {}, Kind::dots);
  for (int i = 0; i < 20000; ++i)
    s.x.push_back(std::fmod(0.61803398875 * i, 1)), s.y.push_back(s.x.back() * s.x.back());
  s.x.push_back(0.5), s.y.push_back(7);  // beyond the axis: stays a dot, which becomes an arrow
  panel.series = {s};
  panel.y.max = 1;
  draw_crowd_as_density(panel);
  REQUIRE((panel.map && panel.map->log && panel.series.size() == 1 && panel.series[0].x.size() == 1));
  double sum = 0;
  for (const double v : panel.map->values)
    if (std::isfinite(v)) sum += std::pow(10, v);
  REQUIRE(sum == Approx(20000));
  panel.map.reset(), panel.series[0].x.resize(1);
  draw_crowd_as_density(panel);
  REQUIRE_FALSE(panel.map);  // few stay dots
}

TEST_CASE("crowds that show one quantity have one range of it, unless told") {
  for (const bool own : {false, true}) {
    Figure figure;
    figure.own_ranges = own;
    for (const double scale : {1.0, 3.0}) {
      auto& panel = figure.panels.emplace_back();
      panel.x.label = "x", panel.y.label = "v";
      auto s = points("impacts", {}, {}, Kind::dots);
      for (int i = 0; i < 20000; ++i)
        s.x.push_back(std::fmod(0.61803398875 * i, 1)), s.y.push_back(scale * s.x.back());
      panel.series = {s};
    }
    draw_crowds_as_densities(figure);
    REQUIRE((figure.panels[0].map && figure.panels[1].map));
    REQUIRE((*figure.panels[0].y.max > 2) != own);
    double sum = 0;
    for (const double v : figure.panels[0].map->values)
      if (std::isfinite(v)) sum += std::pow(10, v);
    REQUIRE(sum == Approx(20000));
  }
}

TEST_CASE("panels that show one quantity have one range, unless told") {
  Figure figure;
  figure.width = 178;
  for (int p = 0; p < 2; ++p) {
    Panel panel;
    panel.y.label = "$v_x$ (m/s)";
    panel.series = {slope("a", p ? 10 : 1, Kind::line)};
    figure.panels.push_back(panel);
  }
  const auto ticks = [&](int panel) {
    std::vector<std::string> texts;
    for (const auto& box : lay_out(figure).boxes)
      if (box.kind == Box::Kind::tick_label && box.panel == panel) texts.push_back(box.text);
    return texts;
  };
  REQUIRE(ticks(0) == ticks(1));
  figure.own_ranges = true;
  REQUIRE(ticks(0) != ticks(1));
}

TEST_CASE("what the table's comments tell stands above the panels") {
  const std::vector<std::string> comments{"parameters: e_n=0.7", "parameters a: sin(theta)=0.057 Phi=2.5",
                                          "hollow b: mu=0.5"};
  REQUIRE(parameters_of(comments, "a") == "$e_n=0.7$, $\\sin\\theta=0.057$, $\\Phi=2.5$");
  REQUIRE(parameters_of(comments, "b") == "$e_n=0.7$");
  REQUIRE((is_told_hollow(comments, "b", "mu=0.5") && !is_told_hollow(comments, "a", "mu=0.5")));
}

}  // namespace referee_tests
