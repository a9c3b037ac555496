#pragma once
#include <map>
#include <string>

#include "plot/display_list.hpp"
#include "plot/factors.hpp"
#include "plot/figure.hpp"
#include "plot/occupancy.hpp"
#include "plot/scale.hpp"
#include "plot/style.hpp"

/// Series as ink inside a frame.
namespace chute::plot {

/// The frame on the page and what its edges mean.
struct Frame {
  Rect rect;
  Span x, y;
  std::optional<Span> right{}, top{};  ///< of the series that count along the axis on the right, and above

  /// NaN where an axis cannot show the value.
  Point at(double px, double py) const {
    return {rect.left + x.fraction(px) * rect.width(), rect.bottom - y.fraction(py) * rect.height()};
  }
  /// The frame as this series' points count in it.
  Frame of(const Series& series) const {
    return {rect, series.top && top ? *top : x, series.right && right ? *right : y};
  }
};

/// Colour, marker and dash of a series.
struct SeriesLook {
  Color color;
  int marker = 0, dash = 0;
  Fill fill = Fill::own;
  bool hollow = false;  ///< whatever the marker: points that are not vouched for
  bool marked =
      false;  ///< a line with a few markers on its way, where nothing else but colour would tell it apart

  MarkerShape shape(double diameter) const {
    return marker_shape(marker, diameter, hollow ? Fill::hollow : fill);
  }

  std::optional<double> width{}, size{};  ///< of its line and its markers, where not the style's
  /// The style as this series has it.
  Look of(Look look) const {
    if (width) look.line_width = *width;
    if (size) look.marker_size = *size;
    return look;
  }
};

/// One legend for all panels: asked for, or the panels show mostly the same series.
bool has_common_legend(const Figure& figure);

/// One look per name, the same in every panel: colours and markers in the order in which names first appear,
/// dashes among those drawn as lines. Panels with legends of their own start anew, except that one quantity at different
/// values looks different everywhere. Names that make a table (factors.hpp) look alike along its rows and columns. "NAME fit"
/// takes the colour of NAME, a doubtful part of NAME all of its look, hollow.
std::map<std::string, SeriesLook> assign_looks(const Figure& figure, const Look& look);

/// The table that the names of a panel's series make, or of all panels' together (-1).
std::optional<Factors> factors_in(const Figure& figure, int panel);

struct Painter {
  DisplayList& list;
  const Look& look;
  Occupancy& occupied;
  int panel = -1;         ///< for the tags of what is drawn; -1: an inset
  bool over_map = false;  ///< lines must show on any colour
};

/// Everything inside the frame, in order: regions, references, bands, bars, lines, error bars, markers.
/// InputError if a region names an unknown series or a series' columns differ in length.
void draw_marks(Painter& painter, const Frame& frame, const Plot& plot,
                const std::map<std::string, SeriesLook>& looks);

/// One marker with its middle at `at`.
void draw_marker(DisplayList& list, const Look& look, const MarkerShape& shape, Color color, const Point& at);

/// The sample of a series in a legend: `width` points wide, its middle line at `at.y`.
void draw_sample(DisplayList& list, const Look& look, Kind kind, const SeriesLook& ink, Point at,
                 double width);

}  // namespace chute::plot
