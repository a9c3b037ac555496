#pragma once
#include <vector>

#include "plot/marks.hpp"

/// Where a map's values, taken as linear between the middles of its cells, have a given level: four middles and their mean make
/// four triangles, on each of which the value is a plane. Nothing where a value is not known.
namespace chute::plot {

/// Where the value is at least `level`.
Path area_above(const Map& map, const Frame& frame, double level);

/// The lines on which the value is `level`, each from end to end; one that runs around something ends at its first point.
std::vector<std::vector<Point>> lines_at(const Map& map, const Frame& frame, double level);

}  // namespace chute::plot
