#include <fmt/format.h>

#include <algorithm>

#include "common/atomic_file.hpp"
#include "common/toml_reader.hpp"
#include "golden.hpp"
#include "plot/draw.hpp"
#include "plot/layout.hpp"
#include "plot/map.hpp"
#include "plot/mathtext.hpp"
#include "plot/recipe.hpp"
#include "plot/referee.hpp"
#include "plot/style.hpp"
#include "plot/table_sheet.hpp"

namespace chute::golden {
namespace {
using namespace chute::plot;

constexpr double dpi = 118;  // a figure of one column is 400 pixels wide

Figure load(const std::string& name) {
  const std::string base = std::string(CHUTE_SOURCE_DIR) + "/golden/data/" + name;
  const auto text = parse_toml(read_file(base + ".toml"), name + ".toml");
  TomlReader reader(text, name + ".toml");
  PlotRecipe recipe;
  recipe.source = name + ".toml";
  reader.required_section("plot", recipe);
  reader.finish();
  return figure_from(recipe, read::read_table(base + ".csv"));
}

image::Image draw(const Figure& figure) { return rasterise(lay_out(figure).list, dpi); }

using Change = std::function<void(Figure&)>;

Golden golden_of(const std::string& name, const std::vector<std::pair<std::string, Change>>& changes) {
  Golden golden;
  golden.name = name;
  golden.made_by = fmt::format("plot::rasterise at {} dpi of data/{}.toml and data/{}.csv", dpi, name, name);
  golden.draw = [name] { return draw(load(name)); };
  for (const auto& [what, change] : changes)
    golden.mutants.push_back({what, [name, change = change] {
                                auto figure = load(name);
                                change(figure);
                                return draw(figure);
                              }});
  return golden;
}

void lengthen_errors(Figure& figure) {
  for (auto& panel : figure.panels)
    for (auto& s : panel.series)
      for (double& e : s.y_err) e *= 1.1;
}
void widen_range(Figure& figure) {
  auto& y = figure.panels[0].y;
  y.min = y.min.value_or(0), y.max = 1.02 * y.max.value_or(1);
}

/// A figure over names, as a table.
Golden golden_table(const std::string& name, const std::vector<std::pair<std::string, Change>>& changes) {
  const auto draw_table = [name](const Change& change) {
    auto figure = load(name);
    change(figure);
    const auto sheet = table_sheet(figure, "A pushed cylinder, in short",
                                   {"±: half of its range where the law leaves it ringing"});
    return rasterise(lay_out(sheet, look_of(figure)).list, dpi);
  };
  Golden golden;
  golden.name = name;
  golden.made_by =
      fmt::format("plot::table_sheet at {} dpi of data/{}.toml and data/{}.csv", dpi, name, name);
  golden.draw = [=] { return draw_table([](Figure&) {}); };
  for (const auto& [what, change] : changes)
    golden.mutants.push_back({what, [=, change = change] { return draw_table(change); }});
  return golden;
}

/// All the type there is: the subset of TeX on one page.
DisplayList type_specimen(const char* digit) {
  DisplayList page;
  page.width = 245, page.height = 150;
  double y = 16;
  const std::string lines[] = {
      "Mean velocity $\\bar{v}_x$ ($\\mathrm{cm/s}$), AVATAR",
      std::string("$\\sin\\theta=0.0") + digit + "$, $\\epsilon_{\\max}$, $\\theta=14.4\\degree$, $-x+y$",
      "$\\frac12\\,\\partial v_x/\\partial h$, $\\sqrt{gd}$, $(\\bar v_x-v_0)^2$, $10^{-3}$",
      "$\\alpha\\beta\\gamma\\delta\\epsilon\\zeta\\eta\\theta\\iota\\kappa\\lambda\\mu\\nu\\xi\\pi\\rho\\sig"
      "ma\\tau\\phi\\chi\\psi\\omega$",
      "$\\Gamma\\Delta\\Theta\\Lambda\\Xi\\Pi\\Sigma\\Phi\\Psi\\Omega$ $\\hat x\\,\\tilde "
      "v\\,\\dot\\omega\\,\\ddot x\\,\\vec v\\,\\overline{ab}$",
      "$x_{i+1}^{2n}\\propto v'_x$, $a\\times b\\cdot c\\pm d$, $\\langle v\\rangle\\ll\\infty$"};
  for (const auto& line : lines) {
    draw_text(page, set_text(line, 10), {8, y}, Color{});
    y += 24;
  }
  return page;
}

}  // namespace

std::vector<Golden> plot_goldens() {
  Golden type;
  type.name = "type";
  type.made_by = fmt::format("plot::rasterise at {} dpi of the type specimen in tests/golden/plots.cpp", dpi);
  type.draw = [] { return rasterise(type_specimen("4"), dpi); };
  type.mutants = {{"one digit of a label", [] { return rasterise(type_specimen("5"), dpi); }}};
  return {
      type,
      golden_of("profiles", {{"error bars 10 % longer", lengthen_errors},
                             {"one series left out", [](Figure& f) { f.panels[2].series.pop_back(); }},
                             {"a colour for another", [](Figure& f) { f.panels[0].series[1].color = 4; }},
                             {"a range 2 % wider", widen_range}}),
      golden_of("histogram",
                {{"one bin 10 % higher", [](Figure& f) { f.panels[3].series[0].y[2] *= 1.1; }},
                 {"panels swapped", [](Figure& f) { std::swap(f.panels[0], f.panels[1]); }},
                 {"outlines instead of bars", [](Figure& f) { f.panels[2].series[0].kind = Kind::steps; }}}),
      golden_of("map", {{"colour range 2 % wider",
                         [](Figure& f) {
                           const auto range = range_of(*f.panels[0].map);
                           f.panels[0].map->low = range.low,
                           f.panels[0].map->high = range.high + 0.02 * (range.high - range.low);
                         }},
                        {"one cell missing", [](Figure& f) { f.panels[0].map->values[40] = unknown; }},
                        {"one contour fewer", [](Figure& f) { --f.panels[1].map->contours; }},
                        {"colours of one sign", [](Figure& f) { f.panels[1].map->diverging = false; }},
                        {"upside down", [](Figure& f) { std::ranges::reverse(f.panels[1].map->values); }}}),
      golden_of("combined", {{"one place of another phase",
                              [](Figure& f) {
                                auto &from = f.panels[0].series[1], &to = f.panels[0].series[2];
                                to.x.push_back(from.x.back()), to.y.push_back(from.y.back());
                                from.x.pop_back(), from.y.pop_back();
                                for (auto* s : {&from, &to})
                                  s->x_err.assign(s->x.size(), unknown), s->y_err = s->x_err;
                              }},
                             {"cells for bands", [](Figure& f) { f.panels[1].map->filled = 0; }},
                             {"one band more", [](Figure& f) { ++f.panels[1].map->filled; }},
                             {"an arrow to another place",
                              [](Figure& f) {
                                f.panels[1].notes[0].arrow = {1.5, 0.3};
                              }},
                             {"the second axis 2 % longer", [](Figure& f) { f.panels[2].right->max = 45; }},
                             {"one axis for both", [](Figure& f) { f.panels[2].series[1].right = false; }}}),
      golden_of("contours",
                {{"a contour at another value", [](Figure& f) { f.panels[0].map->levels[2] = 0.6; }},
                 {"no values on the contours", [](Figure& f) { f.panels[0].map->values_on_lines = false; }},
                 {"a marker where a value stood", [](Figure& f) { f.panels[0].series[0].x[7] = 5.0; }},
                 {"one contour fewer", [](Figure& f) { --f.panels[1].map->contours; }}}),
      golden_of("twin-axes",
                {{"the axis above 2 % longer", [](Figure& f) { f.panels[0].top->max = 2.6e-3; }},
                 {"one axis of x for both", [](Figure& f) { f.panels[0].series[1].top = false; }},
                 {"errors of x 10 % longer",
                  [](Figure& f) {
                    for (double& e : f.panels[0].series[1].x_err) e *= 1.1;
                  }}}),
      golden_of("return-map",
                {{"no diagonal", [](Figure& f) { f.panels[1].references.clear(); }},
                 {"x and y exchanged",
                  [](Figure& f) { std::swap(f.panels[0].series[0].x, f.panels[0].series[0].y); }},
                 {"one digit of a title", [](Figure& f) { f.panels[1].title = "$\\epsilon_{\\max}=0.3$"; }}}),
      golden_of("log-axes", {{"linear for log", [](Figure& f) { f.panels[0].x.scale = Scale::linear; }},
                             {"one digit of a label",
                              [](Figure& f) { f.panels[0].series[0].label = "$t_n=80^{-5}\\,\\mathrm{s}$"; }},
                             {"solid for dashed", [](Figure& f) { f.panels[0].series[1].dash = 0; }}}),
      golden_of("phase-diagram",
                {{"a region left out", [](Figure& f) { f.panels[0].regions.pop_back(); }},
                 {"a range 2 % wider", widen_range},
                 {"a letter for another", [](Figure& f) { f.panels[0].notes[1].text = std::string("R"); }}}),
      golden_of("error-bars", {{"error bars 10 % longer", lengthen_errors},
                               {"no errors in x",
                                [](Figure& f) {
                                  for (auto& s : f.panels[0].series) s.x_err.clear();
                                }},
                               {"circle for triangle", [](Figure& f) { f.panels[0].series[2].marker = 0; }}}),
      golden_of("band",
                {{"band 10 % wider", lengthen_errors},
                 {"no unit in the legend", [](Figure& f) { f.panels[0].series[0].label = "$k_n=10^6$"; }}}),
      golden_of("inset", {{"no inset", [](Figure& f) { f.panels[0].insets.clear(); }},
                          {"another curve inside",
                           [](Figure& f) {
                             for (double& y : f.panels[0].insets[0].plot.series[0].y) y *= 1.05;
                           }}}),
      golden_of("dark",
                {{"on white", [](Figure& f) { f.style = Style::journal; }},
                 {"the line at v_0 moved by 2 %", [](Figure& f) { f.panels[0].references[0].at *= 1.02; }}}),
      golden_of("markers", {{"two markers exchanged",
                             [](Figure& f) {
                               f.panels[0].series[2].marker = 3;
                               f.panels[0].series[3].marker = 2;
                             }},
                            {"two dashes exchanged",
                             [](Figure& f) {
                               f.panels[1].series[1].dash = 2;
                               f.panels[1].series[2].dash = 1;
                             }}}),
      golden_of("scatter",
                {{"larger dots for some", [](Figure& f) { f.panels[0].series[1].kind = Kind::markers; }},
                 {"one series left out", [](Figure& f) { f.panels[0].series.pop_back(); }}}),
      golden_of("slides", {{"type of a journal", [](Figure& f) { f.style = Style::journal; }},
                           {"error bars 10 % longer", lengthen_errors}}),
      golden_of("names", {{"two names exchanged",
                           [](Figure& f) { std::swap(f.panels[1].x.names[2], f.panels[1].x.names[3]); }},
                          {"one digit of a title", [](Figure& f) { f.panels[1].title = "$F_p=0.3\\,mg$"; }}}),
      golden_of("decay", {{"linear for log", [](Figure& f) { f.panels[0].y.scale = Scale::linear; }},
                          {"band 10 % wider", lengthen_errors}}),
      golden_of("shared", {{"ranges of their own", [](Figure& f) { f.share_y = false; }},
                           {"an axis left out", [](Figure& f) { f.panels[1].references.pop_back(); }},
                           {"a note moved", [](Figure& f) { f.panels[0].notes[0].y -= 0.05; }}}),
      golden_of("steps", {{"one series left out", [](Figure& f) { f.panels[0].series.pop_back(); }},
                          {"linear for log", [](Figure& f) { f.panels[0].y.scale = Scale::log; }}}),
      golden_of("beyond", {{"points outside forgotten",
                            [](Figure& f) {
                              for (auto& s : f.panels[0].series)
                                if (s.name == "mu=0.5")
                                  for (auto* column : {&s.x, &s.y, &s.x_err, &s.y_err})
                                    column->resize(column->size() - 2);
                            }},
                           {"what is doubtful filled",
                            [](Figure& f) {
                              for (auto& s : f.panels[0].series)
                                if (s.name == "mu=0.1 apart") s.name = "mu=0.1", s.label = "";
                            }}}),
      golden_of("factors", {{"an entry for each series", [](Figure& f) { f.panels[0].series[2].marker = 0; }},
                            {"two styles exchanged",
                             [](Figure& f) { std::swap(f.panels[0].series[2], f.panels[0].series[4]); }},
                            {"a word for another", [](Figure& f) { f.words[1].second = "correct"; }}}),
      golden_of("density", {{"a scale of colours that is not logarithmic",
                             [](Figure& f) { f.panels[0].map->log = false; }},
                            {"colour range 2 % wider",
                             [](Figure& f) {
                               const auto range = range_of(*f.panels[0].map);
                               f.panels[0].map->high = range.high + 0.02 * (range.high - range.low);
                             }},
                            {"no line at pi/2", [](Figure& f) { f.panels[0].references.clear(); }}}),
      golden_of("parameters", {{"ranges of their own", [](Figure& f) { f.own_ranges = true; }},
                               {"one digit of a parameter",
                                [](Figure& f) { f.panels[1].parameters = f.panels[0].parameters; }}}),
      golden_table("table",
                   {{"one digit of a number", [](Figure& f) { f.panels[1].series[0].y[1] += 2e-3; }},
                    {"an error left out", [](Figure& f) { f.panels[1].series[2].y_err[0] = unknown; }},
                    {"two columns exchanged",
                     [](Figure& f) { std::swap(f.panels[1].series[1].name, f.panels[1].series[2].name); }}}),
  };
}

std::vector<std::string> referee_on_plots() {
  std::vector<std::string> found;
  for (const auto& golden : plot_goldens()) {
    if (golden.name == "type") continue;  // a specimen, no figure
    const auto figure = load(golden.name);
    for (const auto& f : review(figure, lay_out(figure)))
      if (f.kind != Finding::Kind::no_parameters)  // most goldens show a kind of mark, and no experiment
        found.push_back(fmt::format("{}: {}: {}", golden.name, plot::name(f.kind), f.what));
  }
  return found;
}

}  // namespace chute::golden
