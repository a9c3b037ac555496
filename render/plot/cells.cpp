#include "plot/cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/error.hpp"
#include "plot/map.hpp"
#include "plot/shading.hpp"

namespace chute::plot {
namespace {

/// How much of the series' colour a tint has. Markers of the full colour must stand out from it: above 0.5 they do not, below
/// 0.15 neighbouring phases look alike on paper.
constexpr double tint_strength = 0.3;

/// Markers in cells are at least so many of their sizes apart.
constexpr double marker_spacing = 2.4;

/// Cells reach this far over their edges, in points, so that no seam shows between two of one colour.
constexpr double cell_overlap = 0.125;

std::size_t place_of(const std::vector<double>& middles, double value) {
  return static_cast<std::size_t>(std::lower_bound(middles.begin(), middles.end(), value) - middles.begin());
}

void sort_and_merge(std::vector<double>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

bool is_known(const Series& s, std::size_t i) { return std::isfinite(s.x[i]) && std::isfinite(s.y[i]); }

/// Edges of the grid on the page: verticals from left to right, horizontals from bottom to top.
struct Edges {
  std::vector<double> x, y;
  Edges(const CellGrid& grid, const Frame& frame) {
    for (const double e : cell_edges(grid.x, frame.x.scale)) x.push_back(frame.at(e, frame.y.low).x());
    for (const double e : cell_edges(grid.y, frame.y.scale)) y.push_back(frame.at(frame.x.low, e).y());
  }
};

/// Cells of one series; those beside each other in a row are joined to one rectangle.
Path cells_of(const CellGrid& grid, const Edges& edges, int owner) {
  Path path;
  for (std::size_t j = 0; j < grid.y.size(); ++j)
    for (std::size_t i = 0; i < grid.x.size(); ++i) {
      if (grid.at(i, j) != owner) continue;
      std::size_t end = i + 1;
      while (end < grid.x.size() && grid.at(end, j) == owner) ++end;
      path.rectangle(Rect{edges.x[i], edges.y[j + 1], edges.x[end], edges.y[j]}.grown(cell_overlap));
      i = end;
    }
  return path;
}

/// Where cells of different series meet. Pieces in a row are one line, so that its ends meet in clean corners.
Path borders(const CellGrid& grid, const Edges& edges) {
  Path path;
  const std::size_t nx = grid.x.size(), ny = grid.y.size();
  const auto trace = [&](std::size_t count, auto differs, auto point) {
    for (std::size_t k = 0; k < count; ++k) {
      if (!differs(k)) continue;
      const std::size_t first = k;
      while (k < count && differs(k)) ++k;
      path.move(point(first)).line(point(k));
    }
  };
  for (std::size_t i = 0; i + 1 < nx; ++i)
    trace(
        ny, [&](std::size_t j) { return grid.at(i, j) != grid.at(i + 1, j); },
        [&](std::size_t j) {
          return Point{edges.x[i + 1], edges.y[j]};
        });
  for (std::size_t j = 0; j + 1 < ny; ++j)
    trace(
        nx, [&](std::size_t i) { return grid.at(i, j) != grid.at(i, j + 1); },
        [&](std::size_t i) {
          return Point{edges.x[i], edges.y[j + 1]};
        });
  return path;
}

/// Which cells have a marker.
class Marked {
 public:
  Marked(const CellGrid& grid, const Edges& edges, double spacing)
      : grid_(grid), marked_(grid.owner.size(), false) {
    const std::size_t nx = grid.x.size(), ny = grid.y.size();
    const auto columns = thinned(edges.x, spacing), rows = thinned(edges.y, spacing);
    for (std::size_t j = 0; j < ny; ++j)
      for (std::size_t i = 0; i < nx; ++i) marked_[j * nx + i] = columns[i] && rows[j] && grid.at(i, j) >= 0;
    mark_lonely_regions();
  }
  bool at(std::size_t i, std::size_t j) const { return marked_[j * grid_.x.size() + i]; }

 private:
  const CellGrid& grid_;
  std::vector<bool> marked_;

  /// The cells along an axis whose middles are `spacing` apart, from half of that on.
  static std::vector<bool> thinned(const std::vector<double>& edges, double spacing) {
    std::vector<bool> kept(edges.size() - 1, false);
    double last = edges.front() - (edges.back() > edges.front() ? spacing : -spacing) / 2;
    for (std::size_t k = 0; k + 1 < edges.size(); ++k) {
      const double middle = (edges[k] + edges[k + 1]) / 2;
      if (std::abs(middle - last) < spacing) continue;
      kept[k] = true, last = middle;
    }
    return kept;
  }

  /// A region that thinning left without a marker gets one, in the cell nearest its middle.
  void mark_lonely_regions() {
    const std::size_t nx = grid_.x.size(), ny = grid_.y.size();
    std::vector<bool> seen(marked_.size(), false);
    for (std::size_t start = 0; start < seen.size(); ++start) {
      if (seen[start] || grid_.owner[start] < 0) continue;
      std::vector<std::size_t> region{start};
      seen[start] = true;
      for (std::size_t k = 0; k < region.size(); ++k) {
        const std::size_t i = region[k] % nx, j = region[k] / nx;
        const auto visit = [&](std::size_t cell) {
          if (!seen[cell] && grid_.owner[cell] == grid_.owner[start])
            seen[cell] = true, region.push_back(cell);
        };
        if (i > 0) visit(region[k] - 1);
        if (i + 1 < nx) visit(region[k] + 1);
        if (j > 0) visit(region[k] - nx);
        if (j + 1 < ny) visit(region[k] + nx);
      }
      if (std::none_of(region.begin(), region.end(), [&](std::size_t cell) { return marked_[cell]; }))
        marked_[middle_of(region, nx)] = true;
    }
  }

  static std::size_t middle_of(const std::vector<std::size_t>& region, std::size_t nx) {
    const auto place = [&](std::size_t cell) {
      const std::size_t column = cell % nx, row = cell / nx;
      return Point{static_cast<double>(column), static_cast<double>(row)};
    };
    Point mean{0, 0};
    for (const auto cell : region) mean += place(cell) / static_cast<double>(region.size());
    return *std::min_element(region.begin(), region.end(), [&](std::size_t a, std::size_t b) {
      return (place(a) - mean).squaredNorm() < (place(b) - mean).squaredNorm();
    });
  }
};

}  // namespace

CellGrid cell_grid(const Plot& plot) {
  CellGrid grid;
  for (const auto& s : plot.series)
    for (std::size_t i = 0; s.kind == Kind::cells && i < s.x.size(); ++i)
      if (is_known(s, i)) grid.x.push_back(s.x[i]), grid.y.push_back(s.y[i]);
  sort_and_merge(grid.x), sort_and_merge(grid.y);
  constexpr std::size_t most = 1'000'000;  // a page has hardly more dots
  if (grid.x.size() * grid.y.size() > most)
    throw InputError(fmt::format(
        "cells: {} values of x and {} of y make more than {} cells: rows are to lie on a grid; draw markers",
        grid.x.size(), grid.y.size(), most));
  grid.owner.assign(grid.x.size() * grid.y.size(), -1);
  for (std::size_t k = 0; k < plot.series.size(); ++k) {
    const auto& s = plot.series[k];
    for (std::size_t i = 0; s.kind == Kind::cells && i < s.x.size(); ++i) {
      if (!is_known(s, i)) continue;
      int& owner = grid.owner[place_of(grid.y, s.y[i]) * grid.x.size() + place_of(grid.x, s.x[i])];
      if (owner >= 0)
        throw InputError(fmt::format(
            "cells: \"{}\" and \"{}\" both have a row at x = {}, y = {}: take one of them, with where, or "
            "draw markers",
            plot.series[static_cast<std::size_t>(owner)].name, s.name, s.x[i], s.y[i]));
      owner = static_cast<int>(k);
    }
  }
  return grid;
}

Color cell_tint(Color series, Color ground) {
  const auto mix = [](double a, double b) { return b + tint_strength * (a - b); };
  return {mix(series.r, ground.r), mix(series.g, ground.g), mix(series.b, ground.b), 1};
}

void draw_cells(Painter& painter, const Frame& frame, const Plot& plot, const CellGrid& grid,
                const std::map<std::string, SeriesLook>& looks) {
  if (grid.empty()) return;
  const Edges edges(grid, frame);
  auto& list = painter.list;
  double largest = 0;
  for (std::size_t k = 0; k < plot.series.size(); ++k) {
    if (plot.series[k].kind != Kind::cells) continue;
    const auto& ink = looks.at(plot.series[k].name);
    largest = std::max(largest, ink.of(painter.look).marker_size);
    const std::size_t first = list.items.size();
    if (auto path = cells_of(grid, edges, static_cast<int>(k)); !path.empty())
      list.fill(std::move(path), cell_tint(ink.color, painter.look.paper));
    list.tag(Tag::Kind::area, painter.panel, plot.series[k].name, 0, first);
  }
  if (auto path = borders(grid, edges); !path.empty())
    list.stroke(std::move(path), {1.6 * painter.look.hairline, {}, Cap::square, Join::miter},
                painter.look.ink);
  // A legend over cells would hide phases: all of the grid is taken.
  painter.occupied.mark({edges.x.front(), edges.y.back(), edges.x.back(), edges.y.front()});
  const Marked marked(grid, edges, marker_spacing * largest);
  std::vector<Rect> notes;  // such as the names of the phases, which stand in place of markers
  for (const auto& note : plot.notes) notes.push_back(note_box(painter.look, frame, note).grown(1));
  for (std::size_t j = 0; j < grid.y.size(); ++j)
    for (std::size_t i = 0; i < grid.x.size(); ++i) {
      if (!marked.at(i, j)) continue;
      const auto& name = plot.series[static_cast<std::size_t>(grid.at(i, j))].name;
      const auto& ink = looks.at(name);
      const Look look = ink.of(painter.look);
      const Point at{(edges.x[i] + edges.x[i + 1]) / 2, (edges.y[j] + edges.y[j + 1]) / 2};
      const std::size_t first = list.items.size();
      const auto shape = ink.shape(look.marker_size);
      const Rect taken = shape.path.bounds().moved(at);
      if (!frame.rect.contains(taken) ||
          std::any_of(notes.begin(), notes.end(), [&](const Rect& note) { return note.overlaps(taken); }))
        continue;
      draw_marker(list, look, shape, ink.color, at);
      list.tag(Tag::Kind::marker, painter.panel, name, 1, first);
    }
}

}  // namespace chute::plot
