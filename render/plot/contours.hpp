#pragma once
#include <optional>
#include <string>
#include <vector>

#include "plot/marks.hpp"
#include "plot/mathtext.hpp"

/// Contours of a map, with their values on them.
namespace chute::plot {

/// One line of equal value on the page.
struct LevelLine {
  double level = 0;
  std::string text;  ///< the value, as it is set
  Color ink;         ///< shows on the map's colour at this level
  std::vector<Point> points;

  struct Value {
    TextBox text;
    Point at{0, 0};  ///< where its baseline begins
    Rect box;        ///< the line is broken there
  };
  std::optional<Value> value{};  ///< none where the line is short or has no room for it
};

/// The levels: those that the map gives, or as many as it asks for between the ends of its colours.
std::vector<double> contour_levels(const Map& map);

/// The lines of all levels; each has its value on it where that covers nothing that `taken` holds, no other line and no other
/// value. Values stand upright.
std::vector<LevelLine> contours_of(const Map& map, const Frame& frame, const Look& look,
                                   const Occupancy& taken);

/// Draws them, and tells the occupancy where.
void draw_contours(Painter& painter, const Frame& frame, const std::vector<LevelLine>& contours);

}  // namespace chute::plot
