#include "beds/tessellation.hpp"

#include <algorithm>
#include <boost/polygon/voronoi.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

namespace chute::beds {
namespace {

using Place = std::array<double, 2>;
using Point = boost::polygon::point_data<std::int32_t>;
using Diagram = boost::polygon::voronoi_diagram<double>;

/// A place and all its images within `margin` of the first period, those of the period itself first.
struct Images {
  std::vector<Place> place;
  std::vector<std::size_t> of;

  Images(const Sheet& sheet, double margin) : place(sheet.place) {
    for (std::size_t i = 0; i < sheet.place.size(); ++i) of.push_back(i);
    const auto around_x = static_cast<int>(std::ceil(margin / sheet.length));
    const auto around_y = static_cast<int>(std::ceil(margin / sheet.width));
    for (int p = -around_x; p <= around_x; ++p)
      for (int q = -around_y; q <= around_y; ++q)
        for (std::size_t i = 0; i < sheet.place.size(); ++i) {
          if (p == 0 && q == 0) continue;
          const Place image{sheet.place[i][0] + p * sheet.length, sheet.place[i][1] + q * sheet.width};
          if (image[0] < -margin || image[0] > sheet.length + margin || image[1] < -margin ||
              image[1] > sheet.width + margin)
            continue;
          place.push_back(image), of.push_back(i);
        }
  }
};

double distance_of(const Place& a, const Place& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

/// The tessellation from images within `margin`; `farthest` becomes the largest distance of a vertex, inside or outside.
Tessellation divided(const Sheet& sheet, double margin, double& farthest) {
  const Images images(sheet, margin);
  // Whole numbers as large as Boost takes them: of 32 bits, with a reserve.
  const double unit = (std::max(sheet.length, sheet.width) + 2 * margin) / 0x1p30;
  std::vector<Point> points;
  for (const auto& p : images.place)
    points.emplace_back(static_cast<std::int32_t>(std::lround(p[0] / unit)),
                        static_cast<std::int32_t>(std::lround(p[1] / unit)));
  Diagram diagram;
  boost::polygon::construct_voronoi(points.begin(), points.end(), &diagram);

  Tessellation t;
  const std::size_t n = sheet.place.size();
  t.cell_area.assign(n, 0);
  farthest = 0;
  for (const auto& vertex : diagram.vertices()) {
    const Place at{vertex.x() * unit, vertex.y() * unit};
    if (at[0] < 0 || at[0] >= sheet.length || at[1] < 0 || at[1] >= sheet.width) continue;
    const auto* edge = vertex.incident_edge();
    Tessellation::Vertex found{at, distance_of(at, images.place[edge->cell()->source_index()]), {}};
    for (auto& of : found.of) of = images.of[edge->cell()->source_index()], edge = edge->rot_next();
    t.vertices.push_back(found);
    farthest = std::max(farthest, t.vertices.back().distance);
  }
  for (const auto& cell : diagram.cells()) {
    const std::size_t a = cell.source_index();
    if (a >= n) continue;
    const auto* edge = cell.incident_edge();
    do {
      if (!edge->is_finite()) {  // not enough images: the cell has no end
        farthest = std::numeric_limits<double>::infinity();
        return t;
      }
      const double x0 = edge->vertex0()->x() * unit, y0 = edge->vertex0()->y() * unit;
      const double x1 = edge->vertex1()->x() * unit, y1 = edge->vertex1()->y() * unit;
      t.cell_area[a] += (x0 * y1 - x1 * y0) / 2;
      const std::size_t image = edge->twin()->cell()->source_index(), b = images.of[image];
      const auto &from = images.place[a], &to = images.place[image];
      if (edge->is_primary() && a < b)
        t.edges.push_back({a, b, {to[0] - from[0], to[1] - from[1]}, distance_of(from, to)});
      edge = edge->next();
    } while (edge != cell.incident_edge());
  }
  return t;
}

}  // namespace

std::array<double, 2> Sheet::way(const Place& a, const Place& b) const {
  const double dx = b[0] - a[0], dy = b[1] - a[1];
  return {dx - length * std::round(dx / length), dy - width * std::round(dy / width)};
}

std::array<double, 2> Sheet::wrapped(Place p) const {
  p[0] -= length * std::floor(p[0] / length);
  p[1] -= width * std::floor(p[1] / width);
  return p;
}

Tessellation tessellate(const Sheet& sheet) {
  // Vertices of the first period are right if the images reach twice as far as the widest gap. What that is only the
  // result tells; usual gaps are far below this first guess of five typical distances.
  const double typical = std::sqrt(sheet.length * sheet.width / static_cast<double>(sheet.place.size()));
  for (double margin = 5 * typical;; margin *= 2) {
    double farthest = 0;
    auto t = divided(sheet, margin, farthest);
    if (2 * farthest < margin) return t;
  }
}

}  // namespace chute::beds
