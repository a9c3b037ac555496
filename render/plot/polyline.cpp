#include "plot/polyline.hpp"

#include <array>
#include <cmath>

namespace chute::plot {
namespace {

constexpr double around = 20;  // points; more than any line's width or a mitre

bool is_gap(Point p) { return p.hasNaN(); }

/// Infinite coordinates would make NaN of every difference.
Point tamed(Point p) { return p.cwiseMax(-1e7).cwiseMin(1e7); }

}  // namespace

bool cut_segment(Point& a, Point& b, const Rect& to) {
  const Point d = b - a;
  double from = 0, until = 1;
  const std::array<std::array<double, 2>, 4> edges{{{-d.x(), a.x() - to.left},
                                                    {d.x(), to.right - a.x()},
                                                    {-d.y(), a.y() - to.top},
                                                    {d.y(), to.bottom - a.y()}}};
  for (const auto& [p, q] : edges) {  // Liang and Barsky 1984
    if (p == 0) {
      if (q < 0) return false;
    } else if (p < 0) {
      from = std::max(from, q / p);
    } else {
      until = std::min(until, q / p);
    }
  }
  if (from > until) return false;
  const Point start = a;
  b = start + until * d;
  a = start + from * d;
  return true;
}

void add_polyline(Path& path, const std::vector<Point>& points, const Rect& frame) {
  const Rect limit = frame.grown(around);
  bool down = false;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    if (is_gap(points[i]) || is_gap(points[i + 1])) {
      down = false;
      continue;
    }
    const Point end = tamed(points[i + 1]);
    Point a = tamed(points[i]), b = end;
    const Point begin = a;
    if (!cut_segment(a, b, limit)) {
      down = false;
      continue;
    }
    if (!down || a != begin) path.move(a);
    path.line(b);
    down = b == end;
  }
}

Path polygon_inside(const std::vector<Point>& points, const Rect& frame) {
  const Rect limit = frame.grown(around);
  std::vector<Point> ring;
  for (Point p : points)
    if (!is_gap(p)) ring.push_back(tamed(p));
  // Sutherland and Hodgman 1974: against one edge after the other
  for (int edge = 0; edge < 4; ++edge) {
    const auto depth = [&](Point p) {
      return edge == 0   ? p.x() - limit.left
             : edge == 1 ? limit.right - p.x()
             : edge == 2 ? p.y() - limit.top
                         : limit.bottom - p.y();
    };
    std::vector<Point> kept;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point a = ring[i], b = ring[(i + 1) % ring.size()];
      const double da = depth(a), db = depth(b);
      if (da >= 0) kept.push_back(a);
      if ((da >= 0) != (db >= 0)) kept.push_back(a + (da / (da - db)) * (b - a));
    }
    ring = std::move(kept);
  }
  Path path;
  for (std::size_t i = 0; i < ring.size(); ++i) i ? path.line(ring[i]) : path.move(ring[i]);
  if (!path.empty()) path.close();
  return path;
}

void mark_polyline(Occupancy& occupied, const std::vector<Point>& points, const Rect& frame, double width) {
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    if (is_gap(points[i]) || is_gap(points[i + 1])) continue;
    Point a = tamed(points[i]), b = tamed(points[i + 1]);
    if (cut_segment(a, b, frame)) occupied.mark_segment(a, b, width);
  }
}

}  // namespace chute::plot
