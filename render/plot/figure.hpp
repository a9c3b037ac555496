#pragma once
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "plot/geometry.hpp"

/// A figure as plain data: what is shown, not where. All texts are in the language of mathtext.hpp. Numbers
/// are in the units of the axes; NaN means "not known" (an error) or "a gap" (a coordinate).
namespace chute::plot {

inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

enum class Style { journal, slides, dark };  ///< dark: the journal's sizes on a dark ground
enum class Scale { linear, log };

struct Axis {
  std::string label;  ///< with its unit: `$v_x$ (m/s)`
  Scale scale = Scale::linear;
  std::optional<double> min, max;  ///< automatic where absent
  std::vector<std::string> names;  ///< of the places 1, 2, 3 …: labels in place of numbers
  bool times = false;              ///< dates and times of day, in seconds since the begin of 1970
};

enum class Kind {
  line,     ///< points joined
  markers,  ///< points, with error bars where errors are known
  both,
  band,   ///< y - y_err to y + y_err filled, y as a line
  steps,  ///< a histogram's outline; x are bin centres
  bars,   ///< a histogram, filled
  dots,   ///< small dots, for thousands of points
  cells,  ///< the cells of a grid about the points, filled: a phase diagram
};

struct Series {
  std::string name;  ///< as in the CSV; series of one name look the same in all panels
  std::optional<std::string>
      label;  ///< in the legend; made from the name where absent; empty: not in the legend
  Kind kind = Kind::both;
  std::vector<double> x, y;
  std::vector<double> x_err, y_err;  ///< empty or as long as x; NaN where not known
  bool faint = false;                ///< its lines are only hinted at
  bool hollow = false;  ///< its markers are hollow and not joined: points that averages do not vouch for
  bool right = false;   ///< its y counts along the axis on the right
  bool top = false;     ///< its x counts along the axis above
  // Automatic where absent: counted through the orders of style.hpp
  std::optional<int> color, marker, dash;
  std::optional<Color> ink;           ///< a colour of its own in place of one of those
  std::optional<double> width, size;  ///< of its line and its markers, in points
};

/// A line that is no data: y = x, an axis, a limit.
struct Reference {
  enum class Kind { diagonal, horizontal, vertical } kind = Kind::diagonal;
  double at = 0;      ///< horizontal: y; vertical: x; diagonal: y = x + at
  std::string label;  ///< set along the line, empty: none
};

/// A shaded part of a panel: where x and y lie in the given ranges (unbounded where absent), between the
/// curves of two series where named.
struct Region {
  std::optional<double> x_min, x_max, y_min, y_max;
  std::string above, below;  ///< names of series that bound it from beneath and from the top
  int shade = 0;             ///< counted through the order of style.hpp
};

struct Note {
  std::string text;
  double x = 0, y = 0;         ///< of its middle, in the units of the axes
  bool fraction = false;       ///< x and y are fractions of the frame from its lower left corner instead
  std::vector<double> arrow;   ///< [x, y] of what it is about, in the units of the axes; empty: no arrow
  std::optional<Color> ink;    ///< of text and arrow
  std::optional<double> size;  ///< of its type, in points
};

enum class Place {
  automatic,
  top_left,
  top_right,
  bottom_left,
  bottom_right,
  top,
  off,
  direct
};  ///< top: above the frame; direct: of a legend, names at the curves themselves

inline bool in_corner(Place p) {
  return p != Place::automatic && p != Place::top && p != Place::off && p != Place::direct;
}

/// A quantity over the plane, as colours of cells.
struct Map {
  std::vector<double> x, y;         ///< middles of the cells, ascending
  std::vector<double> values;       ///< of cell (i, j) at j times the number of x, plus i; NaN: blank
  std::optional<double> low, high;  ///< of the colours; automatic where absent
  std::string label;                ///< of the colour bar, with its unit
  bool diverging = false;           ///< for values of both signs: white is 0
  bool log = false;                 ///< values are decimal logarithms; the bar shows what they are of
  int contours = 0;                 ///< lines of equal value, evenly between the ends of the colours
  int filled = 0;  ///< so many bands of one colour each between lines of equal value, in place of cells
  std::vector<double> levels;   ///< the values of such lines instead, ascending
  bool values_on_lines = true;  ///< each has its value on it, where there is room
};

/// Lines through points, as thick as a number: a network of forces.
struct Chains {
  std::vector<double> x, y;    ///< their middles
  std::vector<double> dx, dy;  ///< from end to end
  std::vector<double> weight;  ///< the thickness is in proportion
};

struct Plot {
  std::string title;
  Axis x, y;
  std::optional<Axis> right;  ///< of the series that say so; its ticks stand on the right
  std::optional<Axis> top;    ///< of x, likewise above
  std::vector<Series> series;
  std::vector<Reference> references;
  std::vector<Region> regions;
  std::vector<Note> notes;
  std::optional<Map> map;  ///< beneath everything else; its colour bar stands on the right
  std::optional<Chains> chains;
};

/// A small plot inside a panel.
struct Inset {
  Plot plot;
  double width = 0.42, height = 0.4;  ///< of the frame
  Place place = Place::automatic;     ///< where it covers no data, or a corner
};

struct Panel : Plot {
  std::string label;       ///< "a": set as (a)
  std::string parameters;  ///< what was held fixed, behind label and title above the frame
  std::vector<Inset> insets;
  Place legend = Place::automatic;
};

enum class Legend { automatic, each, common, off };  ///< automatic: common if the panels show the same series

/// What a figure has otherwise than its style, in points.
struct StyleChanges {
  std::vector<Color> colors;        ///< of series, in the order in which they come
  std::optional<std::string> font;  ///< family of all texts
  std::optional<Color> ink, paper;
  std::optional<double> font_size, tick_size, legend_size;
  std::optional<double> line_width, marker_size, hairline;
  std::vector<int> markers, dashes;  ///< that series take, in this order: numbers of style.hpp; empty: all
};

struct Figure {
  double width = 86;             ///< mm
  std::optional<double> height;  ///< mm; from `aspect` where absent
  std::optional<double>
      aspect;  ///< height of a panel's frame over its width; absent: 0.75, less for wide frames
  Style style = Style::journal;
  StyleChanges changes;
  int columns = 0;                        ///< 0: one up to 100 mm or for one panel, two otherwise
  bool share_x = false, share_y = false;  ///< one range per column / per row; labels only at the outer panels
  bool own_ranges = false;                ///< otherwise panels whose axes have the same label have one range
  std::vector<std::pair<std::string, std::string>>
      words;  ///< parts of names and how a legend of factors shows them
  Legend legend = Legend::automatic;
  std::vector<Panel> panels;
  std::string source;  ///< what it was made from, named in messages about it; may be empty
};

}  // namespace chute::plot
