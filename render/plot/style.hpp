#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "plot/display_list.hpp"
#include "plot/figure.hpp"

/// How figures look: sizes in points, inks, and the orders in which series take them.
namespace chute::plot {

struct Look {
  double label_size = 10, tick_size = 9, legend_size = 9, panel_size = 10;
  double hairline = 0.5;                    ///< frame, ticks, error bars
  double line_width = 1.1;                  ///< of curves
  double marker_size = 4.6;                 ///< diameter of the round one; the others have its area
  double dot_radius = 0.55;                 ///< of scatter plots
  double major_tick = 4, minor_tick = 2.2;  ///< lengths
  double cap = 3;                           ///< width of an error bar's ends
  double margin = 3;                        ///< around everything
  Color ink, paper, quiet;                  ///< text and frames; ground; reference lines
  std::vector<Color> colors, shades;        ///< series; regions
  std::vector<int> markers, dashes;         ///< in the order in which series take them; empty: by number

  /// What the series that comes as number `k` has.
  int marker(int k) const { return taken(markers, k); }
  int dash(int k) const { return taken(dashes, k); }

 private:
  static int taken(const std::vector<int>& order, int k) {
    return order.empty() ? k : order[static_cast<std::size_t>(k) % order.size()];
  }
};

const Look& look_of(Style style);
/// The style with the figure's changes.
Look look_of(const Figure& figure);

/// Clear of ticks: how far legends, panel labels and insets stand from their frame.
inline constexpr double inset_from_frame = 6;
/// Between frame, tick labels and axis labels.
inline double gap_of(const Look& look) { return 0.33 * look.tick_size; }

/// The hues of Wong (Nature Methods 8, 441), as Okabe and Ito chose them, at lightnesses that also differ in grey and to
/// deuteranopes and protanopes: found by a search over lightness, chroma and hue, and held to least differences by a test
/// (tests/plot/test_referee.cpp). In every style a series also differs from its neighbours by marker and dash.
inline constexpr int color_count = 8;

inline constexpr int marker_count = 10;
struct MarkerShape {
  Path path;
  enum class Paint { filled, hollow, strokes } paint = Paint::filled;
  Path inside;  ///< filled within a hollow one; empty: nothing
};
/// Shape `index` (any number, counted round) about the origin for a circle of the given diameter.
MarkerShape marker_shape(int index, double size);

/// How a shape is filled: what tells the second of two factors of a series' name.
enum class Fill : std::uint8_t { own, filled, hollow, half, dotted };
MarkerShape marker_shape(int index, double size, Fill fill);

/// Dash pattern `index` in multiples of the line's width; 0 is solid.
std::vector<double> dash_pattern(int index, double line_width);
inline constexpr int dash_count = 6;

}  // namespace chute::plot
