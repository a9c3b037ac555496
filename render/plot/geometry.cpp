#include "plot/geometry.hpp"

namespace chute::plot {

Path& Path::rectangle(const Rect& r) {
  return move({r.left, r.top})
      .line({r.right, r.top})
      .line({r.right, r.bottom})
      .line({r.left, r.bottom})
      .close();
}

Path& Path::circle(Point c, double radius) {
  const double k = 0.5522847498307936 * radius;  // four cubic arcs: off by at most 0.03 % of the radius
  move({c.x() + radius, c.y()});
  cubic({c.x() + radius, c.y() + k}, {c.x() + k, c.y() + radius}, {c.x(), c.y() + radius});
  cubic({c.x() - k, c.y() + radius}, {c.x() - radius, c.y() + k}, {c.x() - radius, c.y()});
  cubic({c.x() - radius, c.y() - k}, {c.x() - k, c.y() - radius}, {c.x(), c.y() - radius});
  cubic({c.x() + k, c.y() - radius}, {c.x() + radius, c.y() - k}, {c.x() + radius, c.y()});
  return close();
}

Path& Path::append(const Path& other, Point offset, double scale) {
  verbs.insert(verbs.end(), other.verbs.begin(), other.verbs.end());
  points.reserve(points.size() + other.points.size());
  for (Point p : other.points) points.push_back(offset + scale * p);
  return *this;
}

Rect Path::bounds() const {
  Rect box = Rect::nothing();
  for (Point p : points) box.include(p);
  return box;
}

}  // namespace chute::plot
