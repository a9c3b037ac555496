#include "plot/recipe.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <functional>

#include "common/error.hpp"
#include "common/keys.hpp"
#include "plot/draw.hpp"
#include "plot/fonts.hpp"
#include "plot/mathtext.hpp"
#include "read/iso_time.hpp"

namespace chute::plot {
namespace {
using namespace std::string_view_literals;

constexpr std::array width_words{"single"sv, "double"sv};
constexpr std::array style_words{"journal"sv, "slides"sv, "dark"sv};
constexpr std::array share_words{"automatic"sv, "none"sv, "x"sv, "y"sv, "both"sv};
constexpr std::array legend_words{"automatic"sv, "each"sv, "common"sv, "off"sv};
constexpr std::array kind_words{"automatic"sv, "line"sv, "markers"sv, "both"sv,  "band"sv,
                                "steps"sv,     "bars"sv, "dots"sv,    "cells"sv, "off"sv};
constexpr std::array place_words{"automatic"sv,    "top-left"sv, "top-right"sv, "bottom-left"sv,
                                 "bottom-right"sv, "top"sv,      "off"sv,       "direct"sv};
constexpr std::array side_words{"left"sv, "right"sv};
constexpr std::array end_words{"bottom"sv, "top"sv};
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
enum class YAxis { left, right };
enum class XAxis { bottom, top };
enum class Ordinal : int {};

/// A slip in a text names its line.
void check_texts(TomlReader& a, std::string_view key, const std::vector<std::string>& texts) {
  try {
    for (const auto& text : texts) set_text(text, 10);
  } catch (const InputError& error) {
    a.fail(key, error.what());
  }
}

template <class Archive>
void check_texts(Archive&, std::string_view, const std::vector<std::string>&) {}

template <class Archive>
void read_text(Archive& a, std::string_view key, std::string& target, const char* words) {
  a.value(key, target, words);
  check_texts(a, key, {target});
}
template <class Archive>
void read_text(Archive& a, std::string_view key, std::optional<std::string>& target, const char* words) {
  a.value(key, target, words);
  check_texts(a, key, {target.value_or("")});
}

/// A word of an order that starts with "automatic", as a number that is -1 for it.
template <class Archive>
void read_ordinal(Archive& a, std::string_view key, int& target, std::span<const std::string_view> words,
                  const char* text) {
  Ordinal chosen{target + 1};
  a.choice(key, chosen, words, text);
  target = static_cast<int>(chosen) - 1;
}

/// "#c00000" or "#c00", as on the web; nothing if it is something else.
std::optional<Color> color_from(const std::string& text) {
  if (text.size() != 7 && text.size() != 4) return {};
  std::string digits = text.substr(1);
  if (digits.size() == 3) digits = {digits[0], digits[0], digits[1], digits[1], digits[2], digits[2]};
  std::uint32_t rgb = 0;
  const char* end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, rgb, 16);
  if (text[0] != '#' || error != std::errc() || stop != end) return {};
  return Color::hex(rgb);
}

/// Words as their numbers.
void read_order(TomlReader& a, std::string_view key, std::vector<int>& target,
                std::span<const std::string_view> words, const char* text) {
  std::vector<std::string> chosen;
  a.value(key, chosen, text);
  for (const auto& word : chosen) {
    const auto found = std::find(words.begin(), words.end(), word);
    a.check(found != words.end(), key,
            fmt::format("\"{}\" is not known, allowed: {}", word, fmt::join(words, ", ")));
    target.push_back(static_cast<int>(found - words.begin()));
  }
}
void read_order(KeyLister& a, std::string_view key, std::vector<int>&,
                std::span<const std::string_view> words, const char* text) {
  a.value(key, std::vector<std::string>(), text);
  (void)words;
}

void check_font(TomlReader& a, const std::optional<std::string>& font) {
  try {
    if (font) font_family(*font);
  } catch (const InputError& error) {
    a.fail("font", error.what());
  }
}
void check_font(KeyLister&, const std::optional<std::string>&) {}

constexpr const char* color_form =
    "is no colour: write \"#c00000\", red, green and blue in hexadecimal digits";

void read_color(TomlReader& a, std::string_view key, std::optional<Color>& target, const char* words) {
  std::optional<std::string> text;
  a.value(key, text, words);
  if (!text) return;
  target = color_from(*text);
  a.check(target.has_value(), key, fmt::format("\"{}\" {}", *text, color_form));
}
void read_color(KeyLister& a, std::string_view key, std::optional<Color>&, const char* words) {
  a.value(key, std::optional<std::string>(), words);
}
void read_colors(TomlReader& a, std::string_view key, std::vector<Color>& target, const char* words) {
  std::vector<std::string> texts;
  a.value(key, texts, words);
  for (const auto& text : texts) {
    const auto color = color_from(text);
    a.check(color.has_value(), key, fmt::format("\"{}\" {}", text, color_form));
    target.push_back(*color);
  }
}
void read_colors(KeyLister& a, std::string_view key, std::vector<Color>&, const char* words) {
  a.value(key, std::vector<std::string>(), words);
}

/// A colour of the style by name, or any other as #c00000.
void read_series_color(TomlReader& a, SeriesRecipe& series, const char* words) {
  std::optional<std::string> text;
  a.value("color", text, words);
  if (text && text->starts_with('#'))
    read_color(a, "color", series.ink, words);
  else
    read_ordinal(a, "color", series.color, color_words, words);
}
void read_series_color(KeyLister& a, SeriesRecipe& series, const char* words) {
  read_ordinal(a, "color", series.color, color_words, words);
}

void read_date(TomlReader& a, std::string_view key, std::optional<double>& target, const char* words) {
  std::optional<std::string> text;
  a.value(key, text, words);
  if (!text) return;
  target = read::iso_time(*text);
  a.check(
      target.has_value(), key,
      fmt::format(
          "\"{}\" is no date: write \"2026-03-07\", \"2026-03-07T14:05:09\" or with a zone, +01:00, behind it",
          *text));
}
void read_date(KeyLister& a, std::string_view key, std::optional<double>&, const char* words) {
  a.value(key, std::optional<std::string>(), words);
}

}  // namespace

template <class Archive>
static void describe(Archive& a, AxisRecipe& axis) {
  read_text(a, "label", axis.label, "with its unit");
  a.choice("scale", axis.scale, scale_words, "");
  a.value("min", axis.min, "default from the data");
  a.value("max", axis.max, "default from the data");
  a.check(!axis.min || !axis.max || *axis.min < *axis.max, "min", "must be below max");
  a.check(
      axis.scale != AxisRecipe::Scale::log || ((!axis.min || *axis.min > 0) && (!axis.max || *axis.max > 0)),
      "scale", "a log axis has min and max > 0");
  read_date(a, "from", axis.from, "a date in place of min, \"2026-03-07\" or \"2026-03-07T14:05\"");
  read_date(a, "to", axis.to, "a date in place of max");
  a.check(!(axis.min && axis.from) && !(axis.max && axis.to), "from",
          "give from or min, to or max, not both");
  a.check(!axis.from || !axis.to || *axis.from < *axis.to, "from", "must be before to");
  a.value("factor", axis.factor, "times the data: 100 from m to cm");
  a.value("names", axis.names, "labels of 1, 2 … in place of numbers");
  a.check(axis.names.empty() || axis.scale != AxisRecipe::Scale::log, "names", "not on a log axis");
  check_texts(a, "names", axis.names);
}

template <class Archive>
static void describe(Archive& a, Reference& reference) {
  a.choice("kind", reference.kind, reference_words, "of a line that is no data");
  if (!Archive::reading || reference.kind == Reference::Kind::diagonal)
    a.value("at", reference.at, "horizontal: y; vertical: x; diagonal: y = x + at");
  else
    a.required("at", reference.at);
  read_text(a, "label", reference.label, "along it");
}

template <class Archive>
static void describe(Archive& a, Region& region) {
  a.value("x_min", region.x_min, "of a shaded part; so");
  a.value("x_max", region.x_max, "");
  a.value("y_min", region.y_min, "");
  a.value("y_max", region.y_max, "");
  a.value("above", region.above, "the series that bounds it from below");
  a.value("below", region.below, "and from above");
  std::int64_t shade = 0;
  a.value("shade", shade, between(0, 3), "of the style");
  region.shade = static_cast<int>(shade);
}

template <class Archive>
static void describe(Archive& a, Note& note) {
  a.required("text", note.text, "a text in the panel");
  check_texts(a, "text", {note.text});
  a.value("fraction", note.fraction, "x and y are parts of the frame, from its lower left");
  a.required("x", note.x, "of its middle");
  a.required("y", note.y, "of its middle");
  a.value("arrow", note.arrow, "[x, y] of what it is about: an arrow goes there");
  a.check(note.arrow.empty() || note.arrow.size() == 2, "arrow", "must be [x, y], in the units of the axes");
  read_color(a, "color", note.ink, "of text and arrow, \"#c00000\"");
  a.value("size", note.size, between(smallest_type, 40), "of its type, in points; default that of legends");
}

template <class Archive>
static void describe(Archive& a, InsetRecipe& inset) {
  a.value("series", inset.series, "that it shows; default all of the panel");
  a.value("panel", inset.panel, "whose rows; default of the panel that it stands in");
  a.section("x", inset.x);
  a.section("y", inset.y);
  a.value("width", inset.width, between(0.1, 0.9), "of the frame");
  a.value("height", inset.height, between(0.1, 0.9), "of the frame");
  a.choice("place", inset.place, std::span(place_words).first(5), "");
}

template <class Archive>
static void describe(Archive& a, MapRecipe& map) {
  a.required("series", map.series, "each that matches is a row of colours, at the number its name ends with");
  read_text(a, "label", map.label, "of the colour bar");
  a.value("low", map.low, "of the colours; default from the data");
  a.value("high", map.high, "of the colours; default from the data");
  a.value("diverging", map.diverging, "white is 0");
  a.value("contours", map.contours, between(0, 50), "lines of equal value, evenly between low and high");
  a.value("levels", map.levels, "the values of such lines instead, ascending");
  a.check(map.contours == 0 || map.levels.empty(), "levels", "give contours or levels, not both");
  a.check(
      std::adjacent_find(map.levels.begin(), map.levels.end(), std::greater_equal<>()) == map.levels.end(),
      "levels", "must ascend");
  a.value("contour_labels", map.contour_labels, "lines have their values on them, where there is room");
  a.value("filled", map.filled, between(0, 50),
          "so many bands of one colour each between lines of equal value, in place of cells");
}

template <class Archive>
static void describe(Archive& a, ChainsRecipe& chains) {
  a.required("places", chains.places, "series: middles of lines");
  a.required("branches", chains.branches, "series: from end to end");
  a.required("weights", chains.weights, "series: how thick");
}

template <class Archive>
static void describe(Archive& a, PanelRecipe& panel) {
  a.value("label", panel.label, "the rows whose panel is this");
  a.value("tag", panel.tag, "what stands in the picture for it; \"\" for nothing");
  read_text(a, "title", panel.title, "above the frame");
  read_text(a, "parameters", panel.parameters, "what was held fixed; default what the table says");
  a.section("x", panel.x);
  a.section("y", panel.y);
  a.section("right", panel.right);
  a.section("top", panel.top);
  a.choice("legend", panel.legend, place_words, "top: above the frame");
  a.sections("reference", panel.references);
  a.sections("region", panel.regions);
  a.sections("note", panel.notes);
  a.sections("inset", panel.insets);
  a.section("map", panel.map);
  a.section("chains", panel.chains);
}

template <class Archive>
static void describe(Archive& a, WordRecipe& word) {
  a.required("name", word.name, "a part of a series' name");
  a.required("label", word.label, "what the legend has for it");
  check_texts(a, "label", {word.label});
}

template <class Archive>
static void describe(Archive& a, SeriesRecipe& series) {
  a.required("match", series.match, "the name in the table; * stands for anything");
  a.value("may_be_empty", series.may_be_empty, "no slip if the table has none of that name");
  a.value("panel", series.panel, "only there");
  read_text(a, "label", series.label, "in the legend; default made of the name; \"\" keeps it out");
  a.choice("kind", series.kind, kind_words, "off: not drawn");
  read_series_color(a, series, "or any other, \"#c00000\"");
  read_ordinal(a, "marker", series.marker, marker_words, "");
  read_ordinal(a, "dash", series.dash, dash_words, "");
  a.value("width", series.width, positive, "of its line, in points");
  a.value("size", series.size, positive, "of its markers, in points");
  YAxis side = YAxis::left;
  a.choice("axis", side, side_words, "along which its y counts; right: that of [plot.right]");
  series.right = side == YAxis::right;
  XAxis end = XAxis::bottom;
  a.choice("x_axis", end, end_words, "along which its x counts; top: that of [plot.top]");
  series.top = end == XAxis::top;
}

template <class Archive>
static void describe_keys(Archive& a, PlotRecipe& recipe) {
  Width width = Width::single_column;
  a.choice("width", width, width_words, "86 or 178 mm, one or two columns of a journal");
  recipe.width = width == Width::single_column ? 86 : 178;
  std::optional<double> exact, pixels;
  a.value("width_mm", exact, between(20, 1000), "instead");
  a.value("width_px", pixels, between(200, 40000), "instead: of the PNG");
  if constexpr (Archive::reading) {
    a.check(exact.has_value() + pixels.has_value() + a.has("width") <= 1, "width",
            "give one of width, width_mm and width_px");
    constexpr double mm_per_inch = 25.4;
    if (exact) recipe.width = *exact;
    if (pixels) recipe.width = *pixels / default_dpi * mm_per_inch;
  }
  a.value("height_mm", recipe.height, between(15, 1000), "of the page");
  a.value("aspect", recipe.aspect, between(0.1, 5), "instead: height of a frame over its width");
  if constexpr (Archive::reading)
    a.check(!recipe.height || !a.has("aspect"), "aspect", "give height_mm or aspect, not both");
  a.choice("style", recipe.style, style_words, "");
  a.value("columns", recipe.columns, between(1, 12), "of panels; default one up to 100 mm, else two");
  Share share = Share::automatic;
  a.choice("share", share, share_words, "one range per column, per row");
  recipe.share_x = share == Share::x || share == Share::both;
  recipe.share_y = share == Share::y || share == Share::both;
  recipe.own_ranges = share == Share::none;
  a.choice("legend", recipe.legend, legend_words, "automatic: common if panels show the same series");
  a.value("table", recipe.table,
          "also as a table: a row for each of the x axis' names, a column for each series");
  a.choice("kind", recipe.kind, std::span(kind_words).first(9), "of series that nothing else decides");
  a.section("x", recipe.x);
  a.section("y", recipe.y);
  a.section("right", recipe.right);
  a.section("top", recipe.top);
  a.sections("panel", recipe.panels);
  a.sections("series", recipe.series);
  a.sections("word", recipe.words);
  if constexpr (Archive::reading) {
    const bool named = !recipe.x.names.empty() ||
                       std::any_of(recipe.panels.begin(), recipe.panels.end(),
                                   [](const PanelRecipe& panel) { return !panel.x.names.empty(); });
    a.check(!recipe.table || named, "table",
            "a table has the names of the x axis as its rows: give plot.x.names");
  }
}
void describe(TomlReader& a, PlotRecipe& recipe) { describe_keys(a, recipe); }
void describe(KeyLister& a, PlotRecipe& recipe) { describe_keys(a, recipe); }

template <class Archive>
static void describe_keys(Archive& a, StyleChanges& style) {
  read_colors(a, "colors", style.colors, "[\"#c00000\", …] of series, in the order in which they come");
  a.value(
      "font", style.font,
      "family of all texts, as fc-list names it; letters that it lacks, such as signs of mathematics, are STIX");
  check_font(a, style.font);
  read_color(a, "ink", style.ink, "of texts and frames, \"#000000\"");
  read_color(a, "paper", style.paper, "of the ground, \"#ffffff\"");
  a.value("font_size", style.font_size, between(4, 40), "of labels, in points; the other texts follow");
  a.value("tick_size", style.tick_size, between(4, 40), "of the numbers at ticks, in points");
  a.value("legend_size", style.legend_size, between(4, 40), "of legends and notes, in points");
  read_order(a, "markers", style.markers, std::span(marker_words).subspan(1),
             "that series take, in this order: [\"circle\", \"cross\", …]");
  read_order(a, "dashes", style.dashes, std::span(dash_words).subspan(1),
             "that lines take, in this order: [\"solid\", \"dotted\", …]");
  a.value("line_width", style.line_width, positive, "of curves, in points");
  a.value("marker_size", style.marker_size, positive, "diameter of the round one, in points");
  a.value("hairline", style.hairline, positive, "of frames, ticks and error bars, in points");
}
void describe(TomlReader& a, StyleChanges& style) { describe_keys(a, style); }
void describe(KeyLister& a, StyleChanges& style) { describe_keys(a, style); }

}  // namespace chute::plot
