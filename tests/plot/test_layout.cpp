#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <set>

#include "common/error.hpp"
#include "plot/layout.hpp"
#include "plot/marks.hpp"
#include "plot/mathtext.hpp"
#include "plot/referee.hpp"

namespace layout_tests {
using namespace chute::plot;

namespace {

/// Numbers that do not depend on the library's distributions.
struct Dice {
  std::mt19937_64 engine;
  double uniform() { return static_cast<double>(engine() >> 11) / 9007199254740992.0; }
  int below(int n) { return static_cast<int>(uniform() * n); }
};

Axis random_axis(Dice& dice) {
  static const char* labels[] = {"",
                                 "$x$",
                                 "$\\sin\\theta$",
                                 "$\\bar{v}_x$ (m/s)",
                                 "$\\frac12\\,\\partial v_x/\\partial h$",
                                 "Speed $\\bar v_x\\ (\\sqrt{gd})$"};
  Axis axis;
  axis.label = labels[dice.below(6)];
  const double magnitude = std::pow(10, 24 * dice.uniform() - 12);
  switch (dice.below(5)) {
    case 0:
      axis.scale = Scale::log;
      axis.min = magnitude;
      axis.max =
          magnitude * std::pow(10, dice.below(2) ? 12 * dice.uniform() + 0.01 : 1.5 * dice.uniform() + 0.01);
      break;
    case 1:  // far from zero
      axis.min = (dice.below(2) ? 1 : -1) * magnitude;
      axis.max = *axis.min + magnitude * std::pow(10, -7 * dice.uniform());
      break;
    case 2:
      axis.min = -magnitude * dice.uniform(), axis.max = magnitude * dice.uniform() + 1e-9 * magnitude;
      break;
    case 3:
      axis.min = 0, axis.max = magnitude;
      break;
    default:
      break;  // from the data
  }
  return axis;
}

Series random_series(Dice& dice, const Panel& panel, int number) {
  Series s;
  s.name = "e_n=0." + std::to_string(number + 1);
  s.kind = static_cast<Kind>(dice.below(7));
  const double mx = std::pow(10, 6 * dice.uniform() - 3), my = std::pow(10, 6 * dice.uniform() - 3);
  const int n = dice.below(40);
  for (int i = 0; i < n; ++i) {
    const double t = (i + 0.5) / n;
    const auto& x = panel.x;
    const bool log = x.scale == Scale::log;
    s.x.push_back(x.min && x.max
                      ? (log ? *x.min * std::pow(*x.max / *x.min, t) : *x.min + t * (*x.max - *x.min))
                      : mx * t);
    s.y.push_back(my * (dice.uniform() - 0.3));
    s.y_err.push_back(dice.below(3) ? 0.1 * my * dice.uniform() : unknown);
  }
  return s;
}

/// A line across the panel, with a label.
Reference random_reference(Dice& dice, const Panel& panel) {
  Reference r;
  r.kind = dice.below(2) ? Reference::Kind::horizontal : Reference::Kind::vertical;
  const auto& axis = r.kind == Reference::Kind::horizontal ? panel.y : panel.x;
  r.at = axis.min && axis.max ? *axis.min + dice.uniform() * (*axis.max - *axis.min) : dice.uniform();
  if (dice.below(2)) r.label = "$v_0$";
  return r;
}

Inset random_inset(Dice& dice) {
  Inset inset;
  inset.plot.x.label = "$t$ (s)", inset.plot.y.label = "$v_x$";
  Series s;
  s.name = "e_n=0.1";
  for (int i = 0; i < 9; ++i) s.x.push_back(i), s.y.push_back(dice.uniform());
  inset.plot.series = {s};
  inset.place = static_cast<Place>(dice.below(5));
  inset.width = inset.height = 0.45;
  return inset;
}

Figure random_figure(Dice& dice) {
  Figure figure;
  const int panels = 1 + dice.below(4);
  figure.width = dice.below(2) || panels > 1 ? 178 : 86;
  figure.style = static_cast<Style>(dice.below(8) == 0 ? 2 : 0);
  figure.columns = 1 + dice.below(2);
  figure.share_x = dice.below(4) == 0, figure.share_y = dice.below(4) == 0;
  figure.aspect = 0.5 + 0.5 * dice.uniform();
  const bool titles = dice.below(4) == 0;
  for (int p = 0; p < panels; ++p) {
    Panel panel;
    if (dice.below(4)) panel.label = std::string(1, static_cast<char>('a' + p));
    if (titles) panel.title = "row, $\\epsilon=0$";
    panel.x = random_axis(dice), panel.y = random_axis(dice);
    if (dice.below(3) == 0)
      panel.notes = {{"region $B$, $\\theta_{BC}$", dice.uniform(), dice.uniform(), true, {}, {}, {}}};
    if (dice.below(3) == 0) panel.references = {random_reference(dice, panel)};
    if (dice.below(4) == 0 && panels < 3 && panel.notes.empty() && panel.references.empty())
      panel.insets = {random_inset(dice)};
    if (dice.below(8) == 0) panel.legend = static_cast<Place>(1 + dice.below(5));
    const int series = 1 + dice.below(6);
    for (int i = 0; i < series; ++i) panel.series.push_back(random_series(dice, panel, i));
    figure.panels.push_back(panel);
  }
  return figure;
}

/// What is wrong with the texts; empty if nothing is.
std::string fault(const Figure& figure, const Layout& layout) {
  for (const auto& finding : review(figure, layout))
    if (finding.kind == Finding::Kind::text_overlap) return finding.what;
  return "";
}

Series wave(const std::string& name, double height) {
  Series s;
  s.name = name;
  for (int i = 0; i <= 20; ++i) s.x.push_back(i), s.y.push_back(height * std::sin(0.3 * i));
  return s;
}

const Box* find(const Layout& layout, Box::Kind kind, int panel = 0) {
  for (const auto& b : layout.boxes)
    if (b.kind == kind && b.panel == panel) return &b;
  return nullptr;
}

}  // namespace

TEST_CASE("whatever the ranges, no text overlaps another, a frame, or the page's edge") {
  Dice dice{std::mt19937_64(20240611)};
  for (int i = 0; i < 1000; ++i) {
    const auto figure = random_figure(dice);
    const auto layout = lay_out(figure);
    INFO("figure " << i);
    REQUIRE(fault(figure, layout) == "");
  }
}

TEST_CASE("nothing is set smaller than 7 points, and lines are at least hairlines") {
  Dice dice{std::mt19937_64(7)};
  for (int i = 0; i < 100; ++i)
    for (const auto& item : lay_out(random_figure(dice)).list.items) {
      if (const auto* run = std::get_if<GlyphRun>(&item)) REQUIRE(run->size >= smallest_type);
      if (const auto* line = std::get_if<StrokeItem>(&item)) REQUIRE(line->stroke.width >= 0.5);
    }
}

TEST_CASE("tick labels of an axis have the same number of decimals") {
  Dice dice{std::mt19937_64(99)};
  for (int i = 0; i < 300; ++i) {
    Figure figure;
    figure.panels.resize(1);
    figure.panels[0].x = random_axis(dice);
    const auto layout = lay_out(figure);
    std::set<std::size_t> decimals;
    for (const auto& b : layout.boxes) {
      if (b.kind != Box::Kind::tick_label || b.rect.top < find(layout, Box::Kind::frame)->rect.bottom)
        continue;
      REQUIRE(b.text.front() == '$');  // mathematics: its minus is a minus
      const auto point = b.text.find('.');
      if (b.text.find("10^") == std::string::npos)
        decimals.insert(point == std::string::npos ? 0 : b.text.size() - point);
    }
    REQUIRE(decimals.size() <= 1);
  }
}

TEST_CASE("frames of a grid are aligned and of one size") {
  Figure figure;
  figure.width = 178;
  for (int p = 0; p < 4; ++p) {
    Panel panel;
    panel.y.label = p % 2 ? "$\\sigma_x$" : "";
    panel.y.max = std::pow(10, p);
    panel.series = {wave("a", 1)};
    figure.panels.push_back(panel);
  }
  const auto layout = lay_out(figure);
  std::vector<Rect> f;
  for (int p = 0; p < 4; ++p) f.push_back(find(layout, Box::Kind::frame, p)->rect);
  REQUIRE((f[0].left == f[2].left && f[1].left == f[3].left && f[0].top == f[1].top &&
           f[2].bottom == f[3].bottom));
  for (const auto& r : f) REQUIRE((r.width() == Approx(f[0].width()) && r.height() == Approx(f[0].height())));
  REQUIRE(layout.list.width == Approx(178 * 72 / 25.4));
}

TEST_CASE("the page has the size that was asked for") {
  Figure figure;
  figure.width = 86, figure.height = 64;
  figure.panels.resize(2);
  const auto list = lay_out(figure).list;
  REQUIRE(list.width == Approx(86 / 25.4 * 72));
  REQUIRE(list.height == Approx(64 / 25.4 * 72));
}

TEST_CASE("a legend covers no data, and goes above the frame when there is no room inside") {
  Figure figure;
  figure.panels.resize(1);
  auto& panel = figure.panels[0];
  panel.series = {wave("e_n=0.4", 1), wave("e_n=0.7", 0.5)};
  const auto roomy = lay_out(figure);
  const auto* legend = find(roomy, Box::Kind::legend);
  const auto* frame = find(roomy, Box::Kind::frame);
  REQUIRE((legend && frame->rect.contains(legend->rect)));

  for (int k = 0; k < 60; ++k) panel.series.push_back(wave("x" + std::to_string(k), std::cos(0.1 * k)));
  for (std::size_t k = 2; k < panel.series.size(); ++k) panel.series[k].label = "";
  for (auto& s : panel.series)
    for (std::size_t i = 0; i < s.x.size(); ++i) s.y[i] = (i % 2 ? 1 : -1) * s.y[7];
  panel.y.max = 1.1;  // or the range would grow instead
  const auto full = lay_out(figure);
  legend = find(full, Box::Kind::legend), frame = find(full, Box::Kind::frame);
  REQUIRE((legend && legend->rect.bottom < frame->rect.top));
}

TEST_CASE("panels that show the same series share one legend; others have their own") {
  Figure figure;
  figure.width = 178;
  figure.panels.resize(2);
  for (auto& p : figure.panels) p.series = {wave("e_n=0.4", 1), wave("e_n=0.7", 0.5)};
  const auto count = [&] {
    int n = 0;
    for (const auto& b : lay_out(figure).boxes) n += b.kind == Box::Kind::legend;
    return n;
  };
  REQUIRE(count() == 1);
  figure.panels[1].series = {wave("mu=0.1", 1), wave("mu=0.3", 0.5)};
  REQUIRE(count() == 2);
  figure.legend = Legend::off;
  REQUIRE(count() == 0);
}

TEST_CASE("panels with legends of their own start their colours anew; a common legend never repeats one") {
  Figure figure;
  figure.width = 178;
  figure.panels.resize(2);
  figure.panels[0].series = {wave("mu=0.1", 1), wave("mu=0.3", 0.5)};
  figure.panels[1].series = {wave("k=1", 1), wave("k=2", 0.5)};
  for (auto& p : figure.panels)
    for (auto& s : p.series) s.kind = Kind::line;
  const auto& look = look_of(Style::journal);
  const auto same = [](Color a, Color b) { return a.r == b.r && a.g == b.g && a.b == b.b; };
  auto looks = assign_looks(figure, look);
  REQUIRE(same(looks.at("k=1").color, looks.at("mu=0.1").color));
  REQUIRE((looks.at("k=1").dash == 0 && looks.at("k=2").dash == 1));
  figure.legend = Legend::common;
  looks = assign_looks(figure, look);
  REQUIRE_FALSE(same(looks.at("k=1").color, looks.at("mu=0.1").color));
  REQUIRE(looks.at("k=2").dash == 3);
  figure.panels[0].series.push_back(wave("mu=0.1 fit", 1));
  looks = assign_looks(figure, look);
  REQUIRE(same(looks.at("mu=0.1 fit").color, looks.at("mu=0.1").color));
}

TEST_CASE("a range that is ours to choose grows for a legend") {
  Figure figure;
  figure.panels.resize(1);
  auto& panel = figure.panels[0];
  for (int k = 0; k < 3; ++k) {
    panel.series.push_back(wave("mu=0." + std::to_string(k), 0));
    for (std::size_t i = 0; i < panel.series.back().x.size(); ++i)
      panel.series.back().y[i] = i % 2 ? 1 - 0.1 * k : 0.1 * k;  // to and fro over the whole frame
    panel.series.back().kind = Kind::line;
  }
  const auto grown = lay_out(figure);
  REQUIRE(find(grown, Box::Kind::frame)->rect.contains(find(grown, Box::Kind::legend)->rect));
  panel.y.max = 1;
  const auto fixed = lay_out(figure);
  REQUIRE(find(fixed, Box::Kind::legend)->rect.bottom < find(fixed, Box::Kind::frame)->rect.top);
}

TEST_CASE("what cannot be laid out is refused in one line") {
  Figure figure;
  REQUIRE_THROWS_AS(lay_out(figure), chute::InputError);
  figure.panels.resize(1);
  figure.source = "fig.toml";
  auto& panel = figure.panels[0];
  const auto message = [&] {
    try {
      lay_out(figure);
      return std::string();
    } catch (const chute::InputError& error) {
      return std::string(error.what());
    }
  };
  panel.x.min = 2, panel.x.max = 1;
  REQUIRE(message() == "fig.toml: axis \"\": min 2 must be below max 1");
  panel.x = {"$x$", Scale::log, -1, {}, {}};
  REQUIRE(message() == "fig.toml: axis \"$x$\": -1 is no limit of a log axis, must be > 0");
  panel.x = {std::string(200, 'm'), Scale::linear, {}, {}, {}};
  REQUIRE(message().find("fig.toml: label \"mmm") == 0);
  panel.x = {};
  panel.series = {wave("a", 1)};
  panel.series[0].y.pop_back();
  REQUIRE(message() == "fig.toml: series \"a\": y has another length than x");
  panel.series = {wave("AB", 1)};
  panel.regions = {{{}, {}, {}, {}, "AC", "", 0}};
  REQUIRE(message() == "fig.toml: region: no series \"AC\" in this panel, did you mean \"AB\"?");
  panel.regions.clear();
  figure.width = 20;
  figure.columns = 3;
  figure.panels.resize(3, panel);
  REQUIRE(message().find("too small for 3 panels") != std::string::npos);
}

TEST_CASE("wild data are drawn without leaving the frame's neighbourhood") {
  Figure figure;
  figure.panels.resize(1);
  auto& panel = figure.panels[0];
  for (auto kind : {Kind::line, Kind::both, Kind::band, Kind::steps, Kind::bars, Kind::dots})
    for (auto scale : {Scale::linear, Scale::log}) {
      Series s;
      s.name = "wild", s.kind = kind;
      const double inf = std::numeric_limits<double>::infinity();
      s.x = {0, 1, 2, 3, 4, 5, 6, 7}, s.y = {1, 1e300, unknown, -1e300, inf, -inf, 1e-300, 2};
      s.y_err = {unknown, 1, 2, inf, 3, 1e308, 5, 0};
      panel.series = {s};
      panel.y.scale = scale;
      panel.y.min = scale == Scale::log ? 1e-3 : -1, panel.y.max = 10;
      const auto layout = lay_out(figure);
      for (const auto& item : layout.list.items) {
        const Path* path = nullptr;
        if (const auto* f = std::get_if<FillItem>(&item)) path = &f->path;
        if (const auto* l = std::get_if<StrokeItem>(&item)) path = &l->path;
        if (!path) continue;
        for (Point p : path->points) REQUIRE((std::abs(p.x()) < 2000 && std::abs(p.y()) < 2000));
      }
    }
}

}  // namespace layout_tests
