#pragma once
#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

/// Plane geometry of the page. Unit: typographic point (1/72 inch); origin at the top left, y downwards.
namespace chute::plot {

inline constexpr double points_per_mm = 72 / 25.4;

using Point = Eigen::Vector2d;  // starts undefined, as all of Eigen's: members say {0, 0}

struct Rect {
  double left = 0, top = 0, right = 0, bottom = 0;

  double width() const { return right - left; }
  double height() const { return bottom - top; }
  Point centre() const { return {(left + right) / 2, (top + bottom) / 2}; }
  bool contains(Point p, double margin = 0) const {
    return p.x() >= left - margin && p.x() <= right + margin && p.y() >= top - margin &&
           p.y() <= bottom + margin;
  }
  bool contains(const Rect& r) const {
    return r.left >= left && r.right <= right && r.top >= top && r.bottom <= bottom;
  }
  bool overlaps(const Rect& r) const {
    return left < r.right && r.left < right && top < r.bottom && r.top < bottom;
  }
  Rect grown(double by) const { return {left - by, top - by, right + by, bottom + by}; }
  Rect moved(Point by) const { return {left + by.x(), top + by.y(), right + by.x(), bottom + by.y()}; }

  static Rect nothing() {
    constexpr double inf = std::numeric_limits<double>::infinity();
    return {inf, inf, -inf, -inf};
  }
  void include(Point p) {
    left = std::min(left, p.x()), right = std::max(right, p.x());
    top = std::min(top, p.y()), bottom = std::max(bottom, p.y());
  }
  void include(const Rect& r) { include(Point{r.left, r.top}), include(Point{r.right, r.bottom}); }
};

/// sRGB, straight alpha, all from 0 to 1.
struct Color {
  double r = 0, g = 0, b = 0, a = 1;

  static constexpr Color hex(std::uint32_t rgb, double alpha = 1) {
    return {((rgb >> 16) & 255) / 255.0, ((rgb >> 8) & 255) / 255.0, (rgb & 255) / 255.0, alpha};
  }
  Color with_alpha(double alpha) const { return {r, g, b, alpha}; }
};

/// Straight lines and cubic curves. `verbs` says how many of `points` each step takes: move 1, line 1, cubic
/// 3, close 0.
struct Path {
  enum class Verb : std::uint8_t { move, line, cubic, close };
  std::vector<Verb> verbs;
  std::vector<Point> points;

  bool empty() const { return verbs.empty(); }
  Path& move(const Point& p) { return add(Verb::move, p); }
  Path& line(const Point& p) { return add(Verb::line, p); }
  Path& cubic(const Point& a, const Point& b, const Point& c) {
    verbs.push_back(Verb::cubic);
    points.insert(points.end(), {a, b, c});
    return *this;
  }
  Path& close() {
    verbs.push_back(Verb::close);
    return *this;
  }
  Path& rectangle(const Rect& r);
  Path& circle(Point centre, double radius);
  Path& append(const Path& other, Point offset = {0, 0}, double scale = 1);
  Rect bounds() const;  ///< of all points, control points included

 private:
  Path& add(Verb verb, const Point& p) {
    verbs.push_back(verb);
    points.push_back(p);
    return *this;
  }
};

}  // namespace chute::plot
