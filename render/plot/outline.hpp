#pragma once
#include <vector>

#include "plot/display_list.hpp"

/// Paths to polygons and pens to triangles, for back ends that know neither curves nor pens.
namespace chute::plot {

struct Contour {
  std::vector<Point> points;
  bool closed = false;
};

/// Curves become chords that stray from them by at most `tolerance`.
std::vector<Contour> flatten(const Path& path, double tolerance);

/// Triangles (three points each, any orientation) whose union a fan fill by winding number takes: the fans of
/// all contours about their first point.
void fan_triangles(const std::vector<Contour>& contours, std::vector<Point>& triangles);

/// Triangles whose union is what the pen covers: dashes, joins and caps as in PostScript.
void pen_triangles(const std::vector<Contour>& contours, const Stroke& stroke, double tolerance,
                   std::vector<Point>& triangles);

}  // namespace chute::plot
