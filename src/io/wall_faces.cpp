#include "io/wall_faces.hpp"

#include <cmath>
#include <numbers>

#include "core/contact.hpp"

namespace chute::io {
namespace {

using Corner = std::array<double, 3>;

/// A circle is drawn with so many corners: smooth to the eye at the size of a page.
constexpr int round_corners = 96;

/// What of a polygon (or, of two corners, a line) lies on the side where (r − at)[axis] · side ≤ 0.
std::vector<Corner> cut(const std::vector<Corner>& polygon, std::size_t axis, double at, double side) {
  std::vector<Corner> inside;
  const std::size_t n = polygon.size(), edges = n == 2 ? 1 : n;
  const auto beyond = [&](const Corner& c) { return side * (c[axis] - at); };
  for (std::size_t e = 0; e < edges; ++e) {
    const Corner &a = polygon[e], &b = polygon[(e + 1) % n];
    const double da = beyond(a), db = beyond(b);
    if (da <= 0) inside.push_back(a);
    if ((da < 0 && db > 0) || (da > 0 && db < 0)) {
      Corner& c = inside.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) c[k] = a[k] + da / (da - db) * (b[k] - a[k]);
    }
    if (n == 2 && db <= 0) inside.push_back(b);
  }
  return inside;
}

Vec<3> in_space(const std::array<double, 3>& v) { return {v}; }

struct Box {
  Vec<3> middle{};
  double size = 1;  ///< at least the way from the middle to a corner
  explicit Box(const Room& room) {
    for (int k = 0; k < 3; ++k) {
      const double low = room[static_cast<std::size_t>(2 * k)],
                   high = room[static_cast<std::size_t>(2 * k + 1)];
      size += high - low;
      middle[k] = (low + high) / 2;
    }
  }
};

/// A unit vector across n: in 2D within the plane, in 3D the one that is farthest from an axis.
Vec<3> across(const Vec<3>& n, int dimensions) {
  int axis = dimensions == 2 ? 2 : 0;
  for (int k = 1; k < 3 && dimensions == 3; ++k)
    if (std::abs(n[k]) < std::abs(n[axis])) axis = k;
  Vec<3> out{};
  out[axis] = 1;
  const Vec<3> u = cross(n, out);
  return (1 / norm(u)) * u;
}

/// An endless plane within the room.
std::vector<Corner> plane(const Vec<3>& point, const Vec<3>& n, int dimensions, const Room& room) {
  const Box box(room);
  const Vec<3> foot = box.middle - dot(box.middle - point, n) * n;
  const Vec<3> u = box.size * across(n, dimensions), v = cross(n, u);
  std::vector<Corner> corners{(foot - u).c, (foot + u).c};
  if (dimensions == 3) corners = {(foot - u - v).c, (foot + u - v).c, (foot + u + v).c, (foot - u + v).c};
  for (std::size_t k = 0; k < static_cast<std::size_t>(dimensions); ++k)
    for (const double side : {-1.0, 1.0}) {
      if (corners.size() < 2) return {};
      corners = cut(corners, k, room[2 * k + (side > 0)], side);
    }
  return corners;
}

/// A circle as lines; in 3D a pipe, as long as the room, as staves.
template <int D>
std::vector<std::vector<Corner>> pipe(const Cylinder<D>& cylinder, const Vec<3>& point, const Room& room) {
  Vec<3> u{{1, 0, 0}}, v{{0, 1, 0}}, half{};
  Vec<3> middle = point;
  if constexpr (D == 3) {
    const Box box(room);
    u = across(cylinder.axis, 3), v = cross(cylinder.axis, u);
    middle = point + dot(box.middle - point, cylinder.axis) * cylinder.axis;
    // As long as the room is along the axis: a period's pipe is neither shorter nor longer than the period.
    double length = 0;
    for (int k = 0; k < 3; ++k) {
      const auto low = room[static_cast<std::size_t>(2 * k)],
                 high = room[static_cast<std::size_t>(2 * k + 1)];
      length += std::abs(cylinder.axis[k]) * (high - low);
    }
    half = length / 2 * cylinder.axis;
  }
  const auto rim = [&](int k) {
    const double angle = 2 * std::numbers::pi * (k % round_corners) / round_corners;
    return middle + cylinder.radius * (std::cos(angle) * u + std::sin(angle) * v);
  };
  std::vector<std::vector<Corner>> faces;
  for (int k = 0; k < round_corners; ++k) {
    const Vec<3> a = rim(k), b = rim(k + 1);
    if (D == 2)
      faces.push_back({a.c, b.c});
    else
      faces.push_back({(a - half).c, (b - half).c, (b + half).c, (a + half).c});
  }
  return faces;
}

}  // namespace

template <int D>
std::vector<WallFace> faces_of(const Wall<D>& wall, int number, const Room& room) {
  const Vec<3> point = in_space(as_file_vector(wall.point));
  std::vector<WallFace> faces;
  if (const auto* round = wall.cylinder()) {
    for (auto& corners : pipe(*round, point, room)) faces.push_back({number, std::move(corners)});
    return faces;
  }
  WallFace& face = faces.emplace_back(WallFace{number, {}});
  if (!wall.bounded())
    face.corners = plane(point, in_space(as_file_vector(wall.normal)), D, room);
  else if constexpr (D == 2)
    face.corners = {as_file_vector(wall.point - wall.bounded()->half),
                    as_file_vector(wall.point + wall.bounded()->half)};
  else
    for (const auto& c : wall.bounded()->corners) face.corners.push_back((wall.point + c).c);
  if (face.corners.size() < 2) faces.clear();
  return faces;
}

template std::vector<WallFace> faces_of(const Wall<2>&, int, const Room&);
template std::vector<WallFace> faces_of(const Wall<3>&, int, const Room&);

}  // namespace chute::io
