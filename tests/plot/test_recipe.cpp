#include <catch2/catch.hpp>

#include "common/error.hpp"
#include "plot/layout.hpp"
#include "plot/marks.hpp"
#include "plot/recipe.hpp"

namespace recipe_tests {
using namespace chute;
using namespace chute::plot;

namespace {

PlotRecipe recipe_of(const std::string& text) {
  const auto table = parse_toml(text, "fig.toml");
  TomlReader reader(table, "fig.toml");
  PlotRecipe recipe;
  reader.section("plot", recipe);
  reader.finish();
  recipe.source = "fig.toml";
  return recipe;
}

const char* rows = R"(# x: h
panel,series,x,y,x_err,y_err
a,e_n=0.4,1,10,,0.5
a,e_n=0.4,2,20,0.1,
a,e_n=0.8 fine,1,11,,
a,theory,1,12,,
b,e_n=0.4,1,30,,
i,zoom,1,40,,
)";

Figure figure_of(const std::string& text, const char* csv = rows) {
  return figure_from(recipe_of(text), read::parse_table(csv, "fig.csv"));
}

std::string message(const std::string& text, const char* csv = rows) {
  try {
    lay_out(figure_of(text, csv));
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

}  // namespace

TEST_CASE("without a recipe everything in the table is drawn") {
  const auto figure = figure_of("[plot]");
  REQUIRE(figure.panels.size() == 3);
  const auto& a = figure.panels[0];
  REQUIRE((a.label == "a" && a.series.size() == 3));
  const auto& s = a.series[0];
  REQUIRE((s.name == "e_n=0.4" && s.x == std::vector<double>{1, 2} && s.y == std::vector<double>{10, 20}));
  REQUIRE((s.y_err[0] == 0.5 && std::isnan(s.y_err[1]) && s.x_err[1] == 0.1));
  REQUIRE(s.kind == Kind::both);
  REQUIRE(a.series[2].kind == Kind::line);  // theory
  REQUIRE_NOTHROW(lay_out(figure));
}

TEST_CASE("a recipe says how panels and series look") {
  const auto figure = figure_of(R"toml(
[plot]
width = "double"
aspect = 0.6
style = "slides"
columns = 3
share = "x"
legend = "each"
kind = "markers"
x = { label = "$h$ (cm)", min = 0, factor = 100 }
y = { label = "$y$" }
[[plot.panel]]
label = "b"
title = "second"
y = { label = "$\\eta$", scale = "log" }
legend = "top-left"
reference = [{ kind = "diagonal" }, { kind = "horizontal", at = 25, label = "$v_0$" }]
note = [{ text = "B", x = 0.5, y = 0.5, fraction = true }]
[[plot.panel]]
label = "a"
region = [{ x_min = 100, x_max = 150, shade = 2 }]
inset = [{ panel = "i", series = ["zo*"], y = { max = 50 }, width = 0.5, place = "top-right" }]
[[plot.series]]
match = "*fine"
kind = "line"
label = "fine bins"
color = "black"
dash = "dotted"
[[plot.series]]
match = "theory"
panel = "a"
kind = "off"
)toml");
  REQUIRE(
      (figure.width == 178 && figure.aspect == 0.6 && figure.style == Style::slides && figure.columns == 3));
  REQUIRE((figure.share_x && !figure.share_y && figure.legend == Legend::each));
  REQUIRE(figure.panels.size() == 2);  // i is drawn as an inset only
  const auto &b = figure.panels[0], &a = figure.panels[1];
  REQUIRE(
      (b.title == "second" && b.y.label == "$\\eta$" && b.y.scale == Scale::log && b.x.label == "$h$ (cm)"));
  REQUIRE((b.references.size() == 2 && b.notes.size() == 1 && b.legend == Place::top_left));
  REQUIRE((a.y.label == "$y$" && a.x.min == 0.0));
  REQUIRE(a.series.size() == 2);
  REQUIRE((a.series[0].x == std::vector<double>{100, 200} && a.series[0].x_err[1] == Approx(10)));
  REQUIRE(a.series[0].kind == Kind::markers);
  REQUIRE((a.series[1].kind == Kind::line && a.series[1].label == "fine bins" && a.series[1].color == 7 &&
           a.series[1].dash == 2 && !a.series[1].marker));
  REQUIRE(
      (a.insets.size() == 1 && a.insets[0].plot.series[0].name == "zoom" && a.insets[0].plot.y.max == 50.0));
}

TEST_CASE("a style says which markers and dashes series take, and how large texts are") {
  const auto text = parse_toml(
      "markers = [\"cross\", \"block\"]\ndashes = [\"dotted\"]\nfont_size = 12\nlegend_size = 7.5\n",
      "style.toml");
  TomlReader reader(text, "style.toml");
  StyleChanges style;
  describe(reader, style);
  reader.finish();
  auto figure =
      figure_of("[plot]\nkind = \"markers\"\n[[plot.series]]\nmatch = \"*fine\"\nmarker = \"ring\"\n");
  figure.changes = style;
  const Look look = look_of(figure);
  CHECK((look.label_size == 12 && look.legend_size == 7.5 && look.tick_size == Approx(10.8)));
  const auto looks = assign_looks(figure, look);
  CHECK(looks.at("e_n=0.4").marker == 9);       // cross
  CHECK(looks.at("e_n=0.8 fine").marker == 5);  // its own
  CHECK(looks.at("theory").dash == 2);          // dotted
  CHECK(looks.at("theory").color.b == look.colors[2].b);
  const auto wrong = parse_toml("markers = [\"star\"]\n", "style.toml");
  TomlReader again(wrong, "style.toml");
  CHECK_THROWS_WITH(describe(again, style),
                    Catch::Contains("style.toml:1: markers: \"star\" is not known, allowed: circle"));
}

TEST_CASE("a table of one panel has no (a)") {
  const auto figure = figure_of("[plot]", "panel,series,x,y,x_err,y_err\na,s,1,2,,\n");
  REQUIRE(figure.panels.at(0).label.empty());
}

TEST_CASE("slips are named with file and line") {
  REQUIRE(message("[plot]\nwidht = \"single\"") ==
          "fig.toml:2: plot.widht: unknown key, did you mean width?");
  REQUIRE(message("[plot]\nstyle = \"jornal\"").find("fig.toml:2: plot.style: \"jornal\" is not known") == 0);
  REQUIRE(message("[plot]\n\nx = { label = \"$\\\\thta$\" }").find("fig.toml:3: plot.x.label: text") == 0);
  REQUIRE(message("[plot]\nx = { label = \"$\\\\thta$\" }").find("did you mean \\theta?") !=
          std::string::npos);
  REQUIRE(message("[plot]\n[[plot.panel]]\nlabel = \"z\"") ==
          "fig.toml: plot: panel \"z\": no rows of that panel in fig.csv");
  REQUIRE(message("[plot]\n[[plot.series]]\nmatch = \"e_n=0.5\"\nmay_be_empty = true").empty());
  REQUIRE(message("[plot]\n[[plot.series]]\nmatch = \"e_n=0.5\"") ==
          "fig.toml: plot: series \"e_n=0.5\": none of that name in fig.csv, did you mean \"e_n=0.4\"?");
  REQUIRE(message("[plot]\nx = { min = 2, max = 1 }").find("must be below max") != std::string::npos);
  REQUIRE(message("[plot]\nwidth = \"single\"\nwidth_mm = 5").find("fig.toml:3: plot.width_mm") == 0);
  REQUIRE(message("[plot]", "panel,series,x\na,s,1\n").find("fig.csv") == 0);
  REQUIRE(message("[plot]", "panel,series,x,y\na,s,1,abc\n").find("fig.csv:2") == 0);
  REQUIRE(message("[plot]", "panel,series,x,y\n") == "fig.csv: no rows to draw");
}

TEST_CASE("patterns match names") {
  REQUIRE(matches("*", ""));
  REQUIRE(matches("e_n=*", "e_n=0.4"));
  REQUIRE(matches("* fit", "R=3mm fit"));
  REQUIRE(matches("a*c*e", "abcde"));
  REQUIRE_FALSE(matches("e_n", "e_n=0.4"));
  REQUIRE_FALSE(matches("*x", "xy"));
}

TEST_CASE("an axis with names has them for ticks, and its series side by side") {
  const auto figure =
      figure_of("[plot]\nx = { names = [\"one\", \"$v_x$\"] }\n[[plot.panel]]\nlabel = \"a\"\ntag = \"z\"");
  const auto& panel = figure.panels[0];
  REQUIRE((panel.label == "z" && panel.series.size() == 3));
  REQUIRE(panel.series[1].x[0] == 1);  // the middle one of three
  REQUIRE(panel.series[0].x[0] == Approx(2 - panel.series[2].x[0]));
  REQUIRE(panel.series[0].x[1] - panel.series[0].x[0] == Approx(1));
  std::vector<std::string> names;
  for (const auto& box : lay_out(figure).boxes)
    if (box.kind == Box::Kind::tick_label && box.panel == 0 && !std::isdigit(box.text[1]))
      names.push_back(box.text);
  REQUIRE(names == std::vector<std::string>{"one", "$v_x$"});
  REQUIRE(message("[plot]\nx = { names = [\"$\\\\lalala$\"] }").find("fig.toml:2: plot.x.names:") == 0);
  REQUIRE(message("[plot]\nx = { names = [\"a\"], scale = \"log\" }").find("not on a log axis") !=
          std::string::npos);
  const std::string wide(60, 'm');
  REQUIRE(message("[plot]\nx = { names = [\"" + wide + "\", \"" + wide + "\"] }")
              .find("too short for its 2 names") != std::string::npos);
}

TEST_CASE("a note at the frame's edge moves in; one that is larger than the panel is refused") {
  const auto note = [](const std::string& text) {
    return "[plot]\n[[plot.panel]]\nlabel = \"a\"\nnote = [{ text = \"" + text +
           "\", x = 1, y = 1, fraction = true }]";
  };
  const auto boxes = lay_out(figure_of(note("corner"))).boxes;
  const auto kind = [](Box::Kind wanted) {
    return [wanted](const Box& b) { return b.kind == wanted && b.panel == 0; };
  };
  const auto text = std::find_if(boxes.begin(), boxes.end(), kind(Box::Kind::note));
  const auto frame = std::find_if(boxes.begin(), boxes.end(), kind(Box::Kind::frame));
  REQUIRE((text != boxes.end() && frame->rect.contains(text->rect)));
  REQUIRE(message(note(std::string(90, 'm'))).find("larger than its panel") != std::string::npos);
}

}  // namespace recipe_tests
