#pragma once
#include <vector>

#include "plot/occupancy.hpp"

/// Lines cut to a frame, so that no coordinate leaves the neighbourhood of the page however wild the data
/// are.
namespace chute::plot {

/// Adds the line through `points`, cut to a little around `frame` (the clip hides the rest); a point that is
/// NaN is a gap.
void add_polyline(Path& path, const std::vector<Point>& points, const Rect& frame);

/// The closed polygon through `points`, cut to a little around `frame`.
Path polygon_inside(const std::vector<Point>& points, const Rect& frame);

/// Tells the occupancy about the line.
void mark_polyline(Occupancy& occupied, const std::vector<Point>& points, const Rect& frame, double width);

/// Cuts a segment to a rectangle; false if nothing is left.
bool cut_segment(Point& a, Point& b, const Rect& to);

}  // namespace chute::plot
