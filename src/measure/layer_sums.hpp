#pragma once
#include <array>
#include <cmath>
#include <string>

#include "core/engine.hpp"
#include "core/frame.hpp"

namespace chute::measure {

/// A symmetric tensor's components in the coordinates of files: xx, xy, xz, yy, yz, zz; the first letter is the
/// direction of momentum, the second that of its flux. In 2D xz, yz and zz are 0.
using Tensor = std::array<double, 6>;
inline constexpr std::array<std::pair<std::size_t, std::size_t>, 6> tensor_axes{
    {{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}}};
inline constexpr std::array<const char*, 6> tensor_names{"xx", "xy", "xz", "yy", "yz", "zz"};
inline constexpr std::array<const char*, 3> axis_names{"x", "y", "z"};
inline bool exists_in(int dimensions, std::size_t tensor_component) {
  return static_cast<int>(tensor_axes[tensor_component].second) < dimensions;
}

/// Masses, momenta and stresses of one layer of a flow, summed over samples. Stresses are positive in compression.
struct LayerSums {
  double mass = 0;
  std::array<double, 3> momentum{};
  Tensor flux{};     ///< Σ m v v
  Tensor contact{};  ///< Σ f l, force on the one grain times the way to it from the other

  void add_grain(double m, const std::array<double, 3>& v) {
    mass += m;
    for (std::size_t k = 0; k < 3; ++k) momentum[k] += m * v[k];
    for (std::size_t t = 0; t < 6; ++t) flux[t] += m * v[tensor_axes[t].first] * v[tensor_axes[t].second];
  }
  /// The part of a contact's branch that lies in this layer.
  void add_contact(const Contact& c, double part) {
    for (std::size_t t = 0; t < 6; ++t)
      contact[t] += part * c.force[tensor_axes[t].first] * c.branch[tensor_axes[t].second];
  }
  LayerSums& operator+=(const LayerSums& o) {
    mass += o.mass;
    for (std::size_t k = 0; k < 3; ++k) momentum[k] += o.momentum[k];
    for (std::size_t t = 0; t < 6; ++t) flux[t] += o.flux[t], contact[t] += o.contact[t];
    return *this;
  }
  /// Kinetic stress times area: what fluctuates about the mean velocity carries.
  double kinetic(std::size_t t) const {
    if (mass == 0) return 0;
    return flux[t] - momentum[tensor_axes[t].first] * momentum[tensor_axes[t].second] / mass;
  }
  template <class Archive>
  void serialize(Archive& a) {
    a(mass, momentum, flux, contact);
  }
};

/// A grain's velocity with the components of files.
inline std::array<double, 3> velocity_of(const GrainsView& grains, std::size_t i) {
  return {grains.velocity[0][i], grains.velocity[1][i], grains.dimensions == 3 ? grains.velocity[2][i] : 0};
}

/// Height at which a contact's branch begins.
inline double begin_of(const Contact& contact, const GrainsView& grains, std::size_t normal) {
  return grains.position[normal][static_cast<std::size_t>(contact.a)];
}

/// One grain thrown far up must not take all memory: layers above this many are not kept. What lies there is counted.
inline constexpr std::size_t most_layers = 4096;

}  // namespace chute::measure
