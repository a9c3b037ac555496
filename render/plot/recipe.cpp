#include "plot/recipe.hpp"

#include "common/error.hpp"
#include "plot/mathtext.hpp"

namespace chute::plot {
namespace {
using namespace std::string_view_literals;

constexpr std::array width_words{"single"sv, "double"sv};
constexpr std::array style_words{"journal"sv, "slides"sv, "dark"sv};
constexpr std::array share_words{"automatic"sv, "none"sv, "x"sv, "y"sv, "both"sv};
constexpr std::array legend_words{"automatic"sv, "each"sv, "common"sv, "off"sv};
constexpr std::array kind_words{"automatic"sv, "line"sv, "markers"sv, "both"sv, "band"sv,
                                "steps"sv,     "bars"sv, "dots"sv,    "off"sv};
constexpr std::array place_words{"automatic"sv,    "top-left"sv, "top-right"sv, "bottom-left"sv,
                                 "bottom-right"sv, "top"sv,      "off"sv,       "direct"sv};
constexpr std::array scale_words{"automatic"sv, "linear"sv, "log"sv};
constexpr std::array reference_words{"diagonal"sv, "horizontal"sv, "vertical"sv};
constexpr std::array color_words{"automatic"sv, "blue"sv, "vermillion"sv, "green"sv, "purple"sv,
                                 "orange"sv,    "sky"sv,  "yellow"sv,     "black"sv};
constexpr std::array marker_words{"automatic"sv, "circle"sv, "square"sv,   "up"sv,  "diamond"sv, "down"sv,
                                  "ring"sv,      "block"sv,  "triangle"sv, "gem"sv, "cross"sv};
constexpr std::array dash_words{"automatic"sv, "solid"sv, "dashed"sv,      "dotted"sv,
                                "dash-dot"sv,  "long"sv,  "dash-dot-dot"sv};

enum class Width { single_column, double_column };
enum class Share { automatic, none, x, y, both };
enum class Ordinal : int {};

/// A slip in a text names its line.
void check_texts(TomlReader& a, std::string_view key, const std::vector<std::string>& texts) {
  try {
    for (const auto& text : texts) set_text(text, 10);
  } catch (const InputError& error) {
    a.fail(key, error.what());
  }
}

void read_text(TomlReader& a, std::string_view key, std::string& target) {
  a.value(key, target);
  check_texts(a, key, {target});
}
void read_text(TomlReader& a, std::string_view key, std::optional<std::string>& target) {
  std::string text;
  read_text(a, key, text);
  if (a.has(key)) target = text;
}

/// A word of an order that starts with "automatic", as a number that is -1 for it.
void read_ordinal(TomlReader& a, std::string_view key, int& target, std::span<const std::string_view> words) {
  Ordinal chosen{target + 1};
  a.choice(key, chosen, words);
  target = static_cast<int>(chosen) - 1;
}

}  // namespace

static void describe(TomlReader& a, AxisRecipe& axis) {
  read_text(a, "label", axis.label);
  a.choice("scale", axis.scale, scale_words);
  a.value("min", axis.min);
  a.value("max", axis.max);
  a.check(!axis.min || !axis.max || *axis.min < *axis.max, "min", "must be below max");
  a.check(
      axis.scale != AxisRecipe::Scale::log || ((!axis.min || *axis.min > 0) && (!axis.max || *axis.max > 0)),
      "scale", "a log axis has min and max > 0");
  a.value("factor", axis.factor);
  a.value("names", axis.names);
  a.check(axis.names.empty() || axis.scale != AxisRecipe::Scale::log, "names", "not on a log axis");
  check_texts(a, "names", axis.names);
}

static void describe(TomlReader& a, Reference& reference) {
  a.choice("kind", reference.kind, reference_words);
  if (reference.kind == Reference::Kind::diagonal)
    a.value("at", reference.at);
  else
    a.required("at", reference.at);
  read_text(a, "label", reference.label);
}

static void describe(TomlReader& a, Region& region) {
  a.value("x_min", region.x_min);
  a.value("x_max", region.x_max);
  a.value("y_min", region.y_min);
  a.value("y_max", region.y_max);
  a.value("above", region.above);
  a.value("below", region.below);
  std::int64_t shade = 0;
  a.value("shade", shade, between(0, 3));
  region.shade = static_cast<int>(shade);
}

static void describe(TomlReader& a, Note& note) {
  a.required("text", note.text);
  read_text(a, "text", note.text);
  a.value("fraction", note.fraction);
  a.required("x", note.x);
  a.required("y", note.y);
}

static void describe(TomlReader& a, InsetRecipe& inset) {
  a.value("series", inset.series);
  a.value("panel", inset.panel);
  a.section("x", inset.x);
  a.section("y", inset.y);
  a.value("width", inset.width, between(0.1, 0.9));
  a.value("height", inset.height, between(0.1, 0.9));
  a.choice("place", inset.place, std::span(place_words).first(5));
}

static void describe(TomlReader& a, MapRecipe& map) {
  a.required("series", map.series);
  read_text(a, "label", map.label);
  a.value("low", map.low);
  a.value("high", map.high);
  a.value("diverging", map.diverging);
  a.value("contours", map.contours, between(0, 50));
}

static void describe(TomlReader& a, ChainsRecipe& chains) {
  a.required("places", chains.places);
  a.required("branches", chains.branches);
  a.required("weights", chains.weights);
}

static void describe(TomlReader& a, PanelRecipe& panel) {
  a.value("label", panel.label);
  a.value("tag", panel.tag);
  read_text(a, "title", panel.title);
  read_text(a, "parameters", panel.parameters);
  a.section("x", panel.x);
  a.section("y", panel.y);
  a.choice("legend", panel.legend, place_words);
  a.sections("reference", panel.references);
  a.sections("region", panel.regions);
  a.sections("note", panel.notes);
  a.sections("inset", panel.insets);
  a.section("map", panel.map);
  a.section("chains", panel.chains);
}

static void describe(TomlReader& a, WordRecipe& word) {
  a.required("name", word.name);
  a.required("label", word.label);
  read_text(a, "label", word.label);
}

static void describe(TomlReader& a, SeriesRecipe& series) {
  a.required("match", series.match);
  a.value("may_be_empty", series.may_be_empty);
  a.value("panel", series.panel);
  read_text(a, "label", series.label);
  a.choice("kind", series.kind, kind_words);
  read_ordinal(a, "color", series.color, color_words);
  read_ordinal(a, "marker", series.marker, marker_words);
  read_ordinal(a, "dash", series.dash, dash_words);
}

void describe(TomlReader& a, PlotRecipe& recipe) {
  Width width = Width::single_column;
  a.choice("width", width, width_words);
  recipe.width = width == Width::single_column ? 86 : 178;
  std::optional<double> exact;
  a.value("width_mm", exact, between(20, 1000));
  a.check(!exact || !a.has("width"), "width_mm", "give width or width_mm, not both");
  if (exact) recipe.width = *exact;
  a.value("height_mm", recipe.height, between(15, 1000));
  a.value("aspect", recipe.aspect, between(0.1, 5));
  a.check(!recipe.height || !a.has("aspect"), "aspect", "give height_mm or aspect, not both");
  a.choice("style", recipe.style, style_words);
  a.value("columns", recipe.columns, between(1, 12));
  Share share = Share::automatic;
  a.choice("share", share, share_words);
  recipe.share_x = share == Share::x || share == Share::both;
  recipe.share_y = share == Share::y || share == Share::both;
  recipe.own_ranges = share == Share::none;
  a.choice("legend", recipe.legend, legend_words);
  a.choice("kind", recipe.kind, std::span(kind_words).first(8));
  a.section("x", recipe.x);
  a.section("y", recipe.y);
  a.sections("panel", recipe.panels);
  a.sections("series", recipe.series);
  a.sections("word", recipe.words);
}

}  // namespace chute::plot
