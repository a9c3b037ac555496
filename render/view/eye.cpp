#include <algorithm>
#include <cmath>

#include "view/solid_scene.hpp"

namespace chute::view {
namespace {

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vector unit(Vector a) {
  const double length = std::sqrt(dot(a, a));
  for (double& x : a) x /= length;
  return a;
}
Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

struct Axes {
  Vector right, up, towards;
  Axes(const Vector& to_eye, const Vector& roughly_up) {
    towards = unit(to_eye);
    Vector across = cross(roughly_up, towards);
    if (dot(across, across) < 1e-12) across = cross({0, 1, 0}, towards);  // straight from above
    if (dot(across, across) < 1e-12) across = {1, 0, 0};
    right = unit(across);
    up = cross(towards, right);
  }
};

std::array<Vector, 8> corners(const std::array<double, 6>& box) {
  std::array<Vector, 8> result;
  for (std::size_t i = 0; i < 8; ++i) result[i] = {box[i & 1], box[2 + (i >> 1 & 1)], box[4 + (i >> 2 & 1)]};
  return result;
}

struct Seen {
  double left, right, low, high;
};
/// The box on a screen at distance 1.
Seen project(const std::array<double, 6>& box, const Vector& centre, const Axes& axes, double distance) {
  Seen s{1e300, -1e300, 1e300, -1e300};
  for (const Vector& corner : corners(box)) {
    const Vector p = minus(corner, centre);
    const double depth = distance - dot(p, axes.towards), u = dot(p, axes.right) / depth,
                 v = dot(p, axes.up) / depth;
    s = {std::min(s.left, u), std::max(s.right, u), std::min(s.low, v), std::max(s.high, v)};
  }
  return s;
}

Vector middle(const std::array<double, 6>& box) {
  return {(box[0] + box[1]) / 2, (box[2] + box[3]) / 2, (box[4] + box[5]) / 2};
}

/// Far enough that lines which run away from the eye still look nearly parallel.
double viewing_distance(const std::array<double, 6>& box) {
  return 2.6 * std::hypot(box[1] - box[0], box[3] - box[2], box[5] - box[4]);
}

}  // namespace

double Eye::aspect(const std::array<double, 6>& box, Vector towards, Vector up) {
  const auto s = project(box, middle(box), Axes(towards, up), viewing_distance(box));
  return (s.right - s.left) / (s.high - s.low);
}

Eye Eye::on_box(const std::array<double, 6>& box, Vector towards, Vector up, const plot::Rect& rect,
                double zoom) {
  const Axes axes(towards, up);
  Eye eye;
  eye.centre = middle(box), eye.towards = axes.towards, eye.up = axes.up;
  eye.distance = viewing_distance(box);
  const auto s = project(box, eye.centre, axes, eye.distance);
  eye.focal = zoom * std::min(rect.width() / (s.right - s.left), rect.height() / (s.high - s.low));
  eye.at = {rect.centre().x - eye.focal * (s.left + s.right) / 2,
            rect.centre().y + eye.focal * (s.low + s.high) / 2};
  return eye;
}

plot::Point Eye::seen(const Vector& point) const {
  const Axes axes(towards, up);
  const Vector p = minus(point, centre);
  const double depth = distance - dot(p, axes.towards);
  return {at.x + focal * dot(p, axes.right) / depth, at.y - focal * dot(p, axes.up) / depth};
}

plot::Point Eye::seen_direction(const Vector& direction) const {
  const Axes axes(towards, up);
  return {dot(direction, axes.right), -dot(direction, axes.up)};
}

}  // namespace chute::view
