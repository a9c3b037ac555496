#pragma once
#include <numbers>

namespace chute {

/// Grains are solid spheres, in 2D too, where they move in a plane.
inline double sphere_mass(double density, double radius) {
  return density * 4 / 3 * std::numbers::pi * radius * radius * radius;
}
/// What a grain fills: in 2D the area of its disc in the plane, else its volume.
inline double filled_by(double radius, int dimensions) {
  const double area = std::numbers::pi * radius * radius;
  return dimensions == 2 ? area : 4.0 / 3 * area * radius;
}
/// Moment of inertia about an axis through the centre, 2/5 m R².
inline double sphere_inertia(double mass, double radius) { return 0.4 * mass * radius * radius; }

}  // namespace chute
