#pragma once
#include <optional>
#include <string>
#include <vector>

#include "common/toml_reader.hpp"
#include "plot/figure.hpp"
#include "read/table.hpp"

// clang-format off
/// The plot half of a figure recipe, the table [plot]:
///
///     [plot]
///     width = "single"                 # 86 mm | "double", 178 mm; or width_mm = 120
///     aspect = 0.75                    # of each frame; or height_mm for the page
///     style = "journal"                # journal | slides | dark
///     columns = 2
///     share = "x"                      # none | x | y | both: one range per column / row, labels outside only
///     legend = "automatic"             # automatic | each | common | off
///     kind = "both"                    # line | markers | both | band | steps | bars | dots
///     x = { label = "$h$ ($d$)", min = 0, max = 16 }     # also scale = "log", factor = 100 (times the data)
///
///     [[plot.panel]]                   # for the rows whose panel is `label`; other panels are drawn all the same
///     label = "a"
///     title = "..."
///     y = { label = "$\\eta$" }        # replaces what [plot] says, key by key
///     legend = "top-right"             # automatic | top-left ... bottom-right | top (above the frame) | off
///     reference = [{ kind = "diagonal" }, { kind = "horizontal", at = 0.5, label = "..." }]
///     region = [{ above = "AB eps=0", below = "BC eps=0", shade = 1 }, { x_min = 0, x_max = 1 }]
///     note = [{ text = "B", x = 2.2, y = 0.17 }, { text = "...", x = 0.5, y = 0.9, fraction = true }]
///     inset = [{ series = ["e_n=0.8*"], panel = "i", x = {...}, y = {...}, place = "top-right", width = 0.4 }]
///
///     [[plot.series]]                  # the first that matches decides; other series are drawn all the same
///     match = "e_n=0.8*"               # the name in the CSV; * stands for anything
///     panel = "a"                      # only there
///     kind = "line"                    # or "off": not drawn
///     label = "$e_n=0.8$"              # "" keeps it out of the legend
///     color = "blue"                   # blue vermillion green purple orange sky yellow black
///     marker = "circle"                # circle square up diamond down ring block triangle gem cross
///     dash = "dashed"                  # solid dashed dotted dash-dot long dash-dot-dot
///
/// Where the recipe gives no kind, theory, fits and series of more than 80 points are lines, the others markers
/// and lines. A panel that only an inset names is drawn in the inset only.
// clang-format on
namespace chute::plot {

struct AxisRecipe {
  std::optional<std::string> label;
  enum class Scale { automatic, linear, log } scale = Scale::automatic;
  std::optional<double> min, max, factor;
  std::vector<std::string> names;
};

enum class KindChoice { automatic, line, markers, both, band, steps, bars, dots, off };

struct SeriesRecipe {
  std::string match;
  std::optional<std::string> panel, label;
  KindChoice kind = KindChoice::automatic;
  int color = -1, marker = -1, dash = -1;  ///< -1: automatic
};

struct InsetRecipe {
  std::vector<std::string> series;
  std::optional<std::string> panel;  ///< whose rows; the panel it stands in if absent
  AxisRecipe x, y;
  double width = 0.42, height = 0.4;
  Place place = Place::automatic;
};

struct PanelRecipe {
  std::string label, title;
  std::optional<std::string> tag;  ///< stands for the label in the picture
  AxisRecipe x, y;
  Place legend = Place::automatic;
  std::vector<Reference> references;
  std::vector<Region> regions;
  std::vector<Note> notes;
  std::vector<InsetRecipe> insets;
};

struct PlotRecipe {
  std::string source;  ///< file name for messages; set by whoever reads the file
  double width = 86;
  std::optional<double> height;
  double aspect = 0.75;
  Style style = Style::journal;
  std::int64_t columns = 0;
  bool share_x = false, share_y = false;
  Legend legend = Legend::automatic;
  KindChoice kind = KindChoice::automatic;
  AxisRecipe x, y;
  std::vector<PanelRecipe> panels;
  std::vector<SeriesRecipe> series;
};

/// Reads [plot]: `reader.section("plot", recipe)`. Texts are set once here, so that a slip in a label names
/// its line.
void describe(TomlReader& a, PlotRecipe& recipe);

/// The figure that the recipe makes of a table with the columns panel,series,x,y and, if there, x_err,y_err.
/// InputError if a column is missing or no number, the table has no rows, or the recipe names a panel or
/// series that it lacks.
Figure figure_from(const PlotRecipe& recipe, const read::Table& table);

/// True if `name` is `pattern`, in which `*` stands for any letters, also none.
bool matches(std::string_view pattern, std::string_view name);

}  // namespace chute::plot
