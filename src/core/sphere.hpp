#pragma once
#include <numbers>

namespace chute {

/// Grains are solid spheres, in 2D too, where they move in a plane.
inline double sphere_mass(double density, double radius) {
  return density * 4 / 3 * std::numbers::pi * radius * radius * radius;
}
/// Moment of inertia about an axis through the centre, 2/5 m R².
inline double sphere_inertia(double mass, double radius) { return 0.4 * mass * radius * radius; }

}  // namespace chute
