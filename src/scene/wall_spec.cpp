#include "scene/wall_spec.hpp"

#include <fmt/format.h>

#include <cmath>

namespace chute::scene {
namespace {

using Place = WallSpec::Place;

double length(const Place& v) {
  double sum = 0;
  for (const double x : v) sum += x * x;
  return std::sqrt(sum);
}
template <int D>
Vec<D> vec(const Place& place) {
  Vec<D> v;
  for (int k = 0; k < D; ++k) v[k] = place[static_cast<std::size_t>(k)];
  return v;
}
template <int D>
Vec<D> vec(const std::optional<Place>& place) {
  return place ? vec<D>(*place) : Vec<D>{};
}
template <int D>
Vec<D> unit(const Place& place) {
  return (1 / length(place)) * vec<D>(place);
}
Vec<3> middle(const std::vector<Place>& corners) {
  Vec<3> sum{};
  for (const auto& c : corners) sum = sum + (1 / static_cast<double>(corners.size())) * vec<3>(c);
  return sum;
}

/// Corners may be off their plane by this part of the polygon's size: rounding of what was meant to be flat.
constexpr double flat = 1e-9;

bool is_flat_and_convex(const std::vector<Place>& corners) {
  const auto at = [&](std::size_t k) { return vec<3>(corners[k % corners.size()]); };
  const Vec<3> n = cross(at(1) - at(0), at(2) - at(1));
  const double size = norm(n);
  bool good = size > 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec<3> bend = cross(at(k + 1) - at(k), at(k + 2) - at(k + 1));
    good = good && dot(bend, n) > 0 && std::abs(dot(at(k) - at(0), n)) <= flat * std::pow(size, 1.5);
  }
  return good;
}

}  // namespace

std::optional<Refusal> misfit(const WallSpec& w, const std::string& path, int dimensions) {
  const auto refuse = [&](const char* key, const std::string& what) {
    return Refusal{*key ? path + "." + key : path, what};
  };
  const auto n = static_cast<std::size_t>(dimensions);
  const int shapes = w.is_plane() + w.is_segment() + w.corners.has_value() + w.radius.has_value();
  if (shapes != 1)
    return refuse(
        "",
        std::string(shapes ? "is several things at once" : "lacks its shape") +
            ", give one: a plane (point, normal), a segment (from, to), a polygon (corners) or a cylinder "
            "(radius, with point and axis)");
  struct Named {
    const char* key;
    const std::optional<Place>& place;
  };
  for (const auto& [key, place] : {Named{"point", w.point}, Named{"normal", w.normal}, Named{"from", w.from},
                                   Named{"to", w.to}, Named{"axis", w.axis}, Named{"velocity", w.velocity}})
    if (place && place->size() != n)
      return refuse(key, fmt::format("has {} numbers, needed {}", place->size(), n));
  if (w.is_plane() && !w.point) return refuse("point", "missing: where is the plane?");
  if (w.is_plane() && !(length(*w.normal) > 0)) return refuse("normal", "has no direction, must not be 0");
  if (w.point && !w.is_plane() && !w.radius) return refuse("point", "belongs to planes and cylinders");
  if (w.is_segment() && dimensions == 3)
    return refuse("from", "a segment is a wall in 2D; in 3D give corners");
  if (w.is_segment() && !(w.from && w.to))
    return refuse(w.from ? "to" : "from", "missing: a segment has two ends");
  if (w.is_segment() && *w.from == *w.to) return refuse("to", "is the same place as from");
  if (w.corners) {
    if (dimensions == 2) return refuse("corners", "a polygon is a wall in 3D; in 2D give from and to");
    if (w.corners->size() < 3) return refuse("corners", "at least three are needed");
    for (const auto& c : *w.corners)
      if (c.size() != n)
        return refuse("corners", fmt::format("a corner has {} numbers, needed {}", c.size(), n));
    if (!is_flat_and_convex(*w.corners)) return refuse("corners", "must go round a flat convex polygon");
  }
  if (w.axis && (!w.radius || dimensions == 2)) return refuse("axis", "belongs to cylinders in 3D");
  if (w.radius && dimensions == 3 && !(w.axis && length(*w.axis) > 0))
    return refuse("axis", "a cylinder in 3D needs the direction of its axis");
  if (w.spin && !w.radius) return refuse("spin", "only a cylinder can turn in its place");
  if (w.oscillation && w.radius) return refuse("oscillation", "a cylinder has no normal to oscillate along");
  return {};
}

template <int D>
Wall<D> make_wall(const WallSpec& spec) {
  Wall<D> wall;
  wall.point = vec<D>(spec.point);
  wall.surface = spec.surface;
  if (spec.normal) wall.normal = unit<D>(*spec.normal);
  if (spec.radius)
    wall.outline =
        Cylinder<D>{spec.axis ? unit<D>(*spec.axis) : Vec<D>{}, *spec.radius, spec.spin.value_or(0)};
  if constexpr (D == 2) {
    if (spec.is_segment()) {
      const Vec<2> from = vec<2>(*spec.from), to = vec<2>(*spec.to), half = 0.5 * (to - from);
      wall.point = from + half;
      wall.normal = (1 / norm(half)) * Vec<2>{{-half[1], half[0]}};
      wall.outline = Segment{half};
    }
  } else if (spec.corners) {
    Polygon polygon;
    wall.point = middle(*spec.corners);
    for (const auto& c : *spec.corners) polygon.corners.push_back(vec<3>(c) - wall.point);
    wall.normal = polygon.upright();
    wall.outline = polygon;
  }
  wall.motion.velocity = vec<D>(spec.velocity);
  if (spec.oscillation)
    wall.motion.amplitude = spec.oscillation->amplitude, wall.motion.frequency = spec.oscillation->frequency;
  return wall;
}

template Wall<2> make_wall(const WallSpec&);
template Wall<3> make_wall(const WallSpec&);

}  // namespace chute::scene
