#pragma once
#include <cmath>
#include <numbers>

/// Closed forms of a gas of hard grains: n is their number per area (volume), d their diameter, φ the part of the area
/// (volume) that they fill, T their temperature, an energy.
namespace chute::dsmc {

/// Area of the unit circle's rim, or of the unit sphere: S_2 = 2π, S_3 = 4π.
template <int D>
inline constexpr double whole_sphere = D == 2 ? 2 * std::numbers::pi : 4 * std::numbers::pi;
/// ∫ Θ(v·σ̂)(v·σ̂) dσ̂ over it, for |v| = 1: 2 and π.
template <int D>
inline constexpr double facing = D == 2 ? 2 : std::numbers::pi;

/// Area (volume) of a grain.
template <int D>
double content(double radius) {
  return D == 2 ? std::numbers::pi * radius * radius : 4 * std::numbers::pi / 3 * radius * radius * radius;
}

/// χ: by how much collisions are more frequent than between points, from the equations of state of Henderson (1975) and of
/// Carnahan & Starling (1969).
template <int D>
double chi(double phi) {
  const double free = 1 - phi;
  return D == 2 ? (1 - 7 * phi / 16) / (free * free) : (1 - phi / 2) / (free * free * free);
}

/// χ'' of these.
template <int D>
double chi_bend(double phi) {
  const double free = 1 - phi, cube = free * free * free;
  return D == 2 ? (6 * (1 - 7 * phi / 16) / free - 7.0 / 4) / cube
                : (12 * (1 - phi / 2) / free - 3) / (cube * free);
}

/// Collisions of a grain per time: 2 n d χ √(πT/m) in 2D, 4 n d² χ √(πT/m) in 3D.
template <int D>
double collision_rate(double n, double d, double chi_, double T, double m) {
  return (D == 2 ? 2 : 4) * n * std::pow(d, D - 1) * chi_ * std::sqrt(std::numbers::pi * T / m);
}

/// Mean free path: 1/(2√2 n d χ) in 2D, 1/(√2 π n d² χ) in 3D.
template <int D>
double free_path(double n, double d, double chi_) {
  return 1 / (std::numbers::sqrt2 * facing<D> * n * std::pow(d, D - 1) * chi_);
}

}  // namespace chute::dsmc
