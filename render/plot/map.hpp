#pragma once
#include <array>
#include <vector>

#include "plot/layout.hpp"
#include "plot/marks.hpp"

/// Maps: a quantity over the plane as colours, with a bar that says what they mean.
namespace chute::plot {

/// Colour of t in [0, 1]: Matplotlib's viridis, or, for both signs, the diverging map RdBu of ColorBrewer.
Color map_color(double t, bool diverging);

/// Range of the values, as the map asks for it or as they are.
struct MapRange {
  double low = 0, high = 1;
};
MapRange range_of(const Map& map);

/// Edges of cells along an axis, halfway between their middles as the axis shows them.
std::vector<double> cell_edges(const std::vector<double>& middles, Scale scale = Scale::linear);

/// The cells, inside the frame. Contours are drawn beside them (contours.hpp).
void draw_map(DisplayList& list, const Frame& frame, const Map& map);

/// The same as bands between lines of equal value: what draw_map does where `filled` asks for it.
void draw_bands(DisplayList& list, const Frame& frame, const Map& map);

/// How far the colour bar of a map reaches out to the right of its frame, whose height is given.
double bar_width(const Look& look, const Map& map, double height);
/// And above it: half of a number that stands at its end.
double bar_above(const Look& look, const Map& map, double height);
void draw_bar(DisplayList& list, const Look& look, const Rect& frame, const Map& map, int panel,
              std::vector<Box>& boxes);

/// The thickest line is as thick as the middles of neighbours are far apart, about; those that would be too thin to see are
/// left out.
void draw_chains(Painter& painter, const Frame& frame, const Chains& chains);

/// Where dots became a density (density.hpp), its cells are data that no text may cover, as the dots were.
void mark_crowd(Occupancy& occupied, const Frame& frame, const Map& map);

}  // namespace chute::plot
