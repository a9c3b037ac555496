#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/toml_reader.hpp"
#include "plot/figure.hpp"
#include "read/table.hpp"

namespace chute {
class KeyLister;
}

// clang-format off
/// The plot half of a figure recipe, the table [plot]. Every key, each with its default or an example; all may be
/// left out. Texts know the TeX of mathtext.hpp.
///
///     [plot]
///     width = "single"          # 86 mm; or "double", 178 mm; or width_mm = 120 instead
///     aspect = 0.75             # height of a frame over its width, default 0.75 but 58 mm at most; or height_mm = 60 of the
///                               # page instead
///     style = "journal"         # journal | slides | dark
///     columns = 2               # of panels; default one up to 100 mm of width, else two
///     share = "automatic"       # x | y | both: one range per column, per row; numbers at the outer panels only. none: each
///                               # panel has its own; automatic: those whose axes have the same label have one
///     legend = "automatic"      # automatic | each | common | off; automatic: common if panels show the same series
///     table = false             # also as a table: a row for each of the x axis' names, a column for each series
///     kind = "automatic"        # line | markers | both | band | steps | bars | dots | cells: of series that nothing else
///                               # decides; cells: a phase diagram, the cells about the points of a grid are filled
///     x = { … }                 # axes of all panels, see below
///     y = { … }
///     right = { … }             # a second axis of y, for series with axis = "right"
///     top = { … }               # and of x, for series with x_axis = "top"
///
///     # an axis
///     label = "$h$ ($d$)"       # with its unit
///     scale = "linear"          # linear | log
///     min = 0                   # default: from the data; so is max
///     max = 16
///     from = "2026-03-07"       # in place of min, on an axis of dates; so is to
///     factor = 100              # times the data: from m to cm
///     names = ["a", "b"]        # labels of 1, 2 … in place of numbers; series then stand side by side
///
///     [[plot.panel]]            # panels that the table has and the recipe has not are drawn all the same
///     label = "a"               # the rows whose panel is this
///     tag = "a"                 # what stands in the picture for the label, (a); "" for nothing
///     title = "$\\epsilon=0$"    # after the tag, above the frame
///     parameters = "$\\mu=0$"    # after that: what was held fixed; default what the table tells (parameters.hpp)
///     x = { … }                 # replaces what [plot] says, key by key; so do y, right and top
///     y = { … }
///     legend = "automatic"      # automatic | top-left | top-right | bottom-left | bottom-right | top (above the frame) | off
///                               # | direct (names at the curves)
///     reference = [{ kind = "diagonal", at = 0 }, { kind = "horizontal", at = 0.5, label = "$v_0$" }, { kind = "vertical", at = 1 }]
///     region = [{ x_min = 0, x_max = 1, y_min = 0, y_max = 1, above = "AB eps=0", below = "BC eps=0", shade = 1 }]
///                               # shaded (0 to 3) within the ranges and between the curves that are named
///     note = [{ text = "B", x = 2.2, y = 0.17, fraction = false }]   # its middle; fraction: of the frame, from its lower left;
///                               # arrow = [2, 0.1]: to what it is about; color, size
///     map = { series = "density t=*", label = "$\\rho$", low = 0, high = 1, diverging = false, contours = 0, levels = [],
///                               # contour_labels = true, filled = 0 }
///                               # colours: each series that matches is a row, whose place along y follows its name's last =;
///                               # contours: lines of equal value, so many or at these levels; filled: bands between such lines in place of cells
///     chains = { places = "network", branches = "branch", weights = "force" }
///                               # a line through each row of `places`, along that row of `branches` (x, y: from end to end),
///                               # as thick as that of `weights` (y)
///     inset = [{ series = ["e_n=0.8*"], panel = "i", x = { … }, y = { … }, place = "automatic", width = 0.42, height = 0.4 }]
///                               # series and panel: what it shows, default all of this panel; a panel that only an inset
///                               # names is drawn there only; place: automatic or a corner; width, height: of the frame
///
///     [[plot.word]]             # parts of series' names, for legends with an entry a part (factors.hpp)
///     name = "theory"
///     label = "(4.47)"          # how the legend shows it
///
///     [[plot.series]]           # the first that matches decides; series that none matches are drawn all the same
///     match = "e_n=0.8*"        # the name in the table; * stands for anything
///     panel = "a"               # only there
///     kind = "automatic"        # as above, or off: not drawn. Automatic: a line for theory…, exact…, linear…, eq … and
///                               # … fit; else what [plot] says; else a line above 80 points, both below
///     label = "$e_n=0.8$"       # default made of the name; "" keeps it out of the legend
///     color = "automatic"       # "#c00000", or blue vermillion green purple orange sky yellow black
///     marker = "automatic"      # filled: circle up down block gem; hollow: square diamond ring triangle; cross
///     dash = "automatic"        # solid dashed dotted dash-dot long dash-dot-dot
///     width = 1.1               # of its line, in points; size: of its markers
///     axis = "left"             # or right
///     x_axis = "bottom"         # or top
///
///     [style]                   # or style = "FILE.toml" at the top of the recipe, a file with these keys, relative to it
///     colors = ["#c00000"]      # of series, in the order in which they come
///     font = "DejaVu Sans"      # of all texts; default STIX
///     ink = "#000000"           # texts and frames; paper: the ground
///     font_size = 10            # of labels, in points; the other texts follow
///     line_width = 1.1          # points; so are marker_size and hairline, and tick_size and legend_size of texts
///     markers = ["circle"]      # that series take, in this order; dashes: that lines take
// clang-format on
namespace chute::plot {

struct AxisRecipe {
  std::optional<std::string> label;
  enum class Scale { automatic, linear, log } scale = Scale::automatic;
  std::optional<double> min, max, factor;
  std::optional<double> from, to;  ///< dates, in place of min and max
  std::vector<std::string> names;
};

enum class KindChoice { automatic, line, markers, both, band, steps, bars, dots, cells, off };

struct SeriesRecipe {
  std::string match;
  bool may_be_empty =
      false;  ///< no slip if the table has none of that name, such as a mean that is nowhere steady
  std::optional<std::string> panel, label;
  KindChoice kind = KindChoice::automatic;
  int color = -1, marker = -1, dash = -1;  ///< -1: automatic
  std::optional<Color> ink;                ///< color = "#c00000"
  bool right = false, top = false;         ///< axis = "right", x_axis = "top"
  std::optional<double> width, size;       ///< points
};

struct InsetRecipe {
  std::vector<std::string> series;
  std::optional<std::string> panel;  ///< whose rows; the panel it stands in if absent
  AxisRecipe x, y;
  double width = 0.42, height = 0.4;
  Place place = Place::automatic;
};

struct MapRecipe {
  std::string series, label;
  std::optional<double> low, high;
  bool diverging = false;
  std::int64_t contours = 0, filled = 0;
  std::vector<double> levels;
  bool contour_labels = true;
};

struct ChainsRecipe {
  std::string places, branches, weights;
};

struct WordRecipe {
  std::string name, label;
};

struct PanelRecipe {
  std::string label, title;
  std::optional<std::string> tag;  ///< stands for the label in the picture
  std::optional<std::string> parameters;
  AxisRecipe x, y;
  std::optional<AxisRecipe> right, top;
  Place legend = Place::automatic;
  std::vector<Reference> references;
  std::vector<Region> regions;
  std::vector<Note> notes;
  std::vector<InsetRecipe> insets;
  std::optional<MapRecipe> map;
  std::optional<ChainsRecipe> chains;
};

struct PlotRecipe {
  std::string source;  ///< file name for messages; set by whoever reads the file
  double width = 86;
  std::optional<double> height;
  std::optional<double> aspect;
  Style style = Style::journal;
  StyleChanges changes;  ///< [style] of the recipe; set by whoever reads the file
  std::map<std::string, std::string>
      labels;  ///< of series that the recipe gives none; set by whoever has the table
  std::int64_t columns = 0;
  bool share_x = false, share_y = false, own_ranges = false;
  bool table = false;  ///< also as a table (table_sheet.hpp)
  Legend legend = Legend::automatic;
  KindChoice kind = KindChoice::automatic;
  AxisRecipe x, y;
  std::optional<AxisRecipe> right, top;
  std::vector<PanelRecipe> panels;
  std::vector<SeriesRecipe> series;
  std::vector<WordRecipe> words;
};

/// Reads [plot]: `reader.section("plot", recipe)`. Texts are set once here, so that a slip in a label names
/// its line.
void describe(TomlReader& a, PlotRecipe& recipe);
void describe(KeyLister& a, PlotRecipe& recipe);
/// [style], and a style file.
void describe(TomlReader& a, StyleChanges& style);
void describe(KeyLister& a, StyleChanges& style);

/// The figure that the recipe makes of a table with the columns panel,series,x,y and, if there, x_err,y_err.
/// InputError if a column is missing or no number, the table has no rows, or the recipe names a panel or
/// series that it lacks.
Figure figure_from(const PlotRecipe& recipe, const read::Table& table);

/// True if `name` is `pattern`, in which `*` stands for any letters, also none.
bool matches(std::string_view pattern, std::string_view name);

}  // namespace chute::plot
