#pragma once
#include <array>
#include <cmath>

#include "core/domain.hpp"
#include "core/engine.hpp"

namespace chute::measure {

/// Masses, momenta and stresses of one layer of a 2D flow, summed over samples. Stresses are positive in
/// compression; [0], [1], [2] are xx, xy, yy, the first letter the direction of momentum, the second that of
/// its flux.
struct LayerSums {
  double mass = 0, momentum_x = 0, momentum_y = 0;
  std::array<double, 3> flux{};     ///< Σ m v v
  std::array<double, 3> contact{};  ///< Σ f l, force on the one grain times the way to it from the other

  void add_grain(double m, double v_x, double v_y) {
    mass += m;
    momentum_x += m * v_x, momentum_y += m * v_y;
    flux[0] += m * v_x * v_x, flux[1] += m * v_x * v_y, flux[2] += m * v_y * v_y;
  }
  LayerSums& operator+=(const LayerSums& o) {
    mass += o.mass, momentum_x += o.momentum_x, momentum_y += o.momentum_y;
    for (std::size_t k = 0; k < 3; ++k) flux[k] += o.flux[k], contact[k] += o.contact[k];
    return *this;
  }
  /// Kinetic stress times area: what fluctuates about the mean velocity carries.
  std::array<double, 3> kinetic() const {
    if (mass == 0) return {};
    return {flux[0] - momentum_x * momentum_x / mass, flux[1] - momentum_x * momentum_y / mass,
            flux[2] - momentum_y * momentum_y / mass};
  }
  template <class Archive>
  void serialize(Archive& a) {
    a(mass, momentum_x, momentum_y, flux, contact);
  }
};

/// A contact of a 2D flow, as stresses need it: from the centre of grain i at height h_i by `way` to that of
/// grain j, with the force on j.
struct Branch {
  double h_i;
  Vec<2> way, force;
  /// The stress, times area, of the part of the branch that lies in a layer.
  std::array<double, 3> stress(double part) const {
    return {part * force[0] * way[0], part * force[0] * way[1], part * force[1] * way[1]};
  }
};

inline Branch branch_of(const ContactRecord& contact, const GrainsView& grains) {
  const auto i = static_cast<std::size_t>(contact.i), j = static_cast<std::size_t>(contact.j);
  const auto between = [&](std::size_t k) {
    const double d = grains.position[k][j] - grains.position[k][i], period = grains.period[k];
    return period > 0 ? Domain<2>::nearest_image(d, period, period / 2) : d;
  };
  const Vec<2> way{{between(0), between(1)}};
  const Vec<2> n = 1 / norm(way) * way;
  const Vec<2> s{{n[1], -n[0]}};
  return {grains.position[1][i], way, contact.normal_force * n + contact.shear_force * s};
}

}  // namespace chute::measure
