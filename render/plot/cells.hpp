#pragma once
#include <map>
#include <string>
#include <vector>

#include "plot/marks.hpp"

/// Phase diagrams: the plane as cells, each of which belongs to one series.
namespace chute::plot {

/// The places of all series of kind `cells` as a grid, and whose each place is.
struct CellGrid {
  std::vector<double> x, y;  ///< middles, ascending
  std::vector<int> owner;    ///< of place (i, j) at j times the number of x, plus i: which series; -1: none

  bool empty() const { return owner.empty(); }
  int at(std::size_t i, std::size_t j) const { return owner[j * x.size() + i]; }
};

/// InputError if two rows claim one place: which of them is it?
CellGrid cell_grid(const Plot& plot);

/// Every cell in a light tint of its series' colour, a line wherever two series meet, and the series' markers in the cells, so
/// that no phase is told by colour alone: in every cell if these are wide enough, else in so many that markers stay apart, but
/// at least in one of each connected region.
void draw_cells(Painter& painter, const Frame& frame, const Plot& plot, const CellGrid& grid,
                const std::map<std::string, SeriesLook>& looks);

/// The tint of a cell: the series' colour on the figure's ground.
Color cell_tint(Color series, Color ground);

}  // namespace chute::plot
