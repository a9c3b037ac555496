#pragma once
#include <cstdint>
#include <vector>

#include "core/grains.hpp"

namespace chute::soft {

/// Everything about the contacts of one instant, one array per field, ordered as the pair list (so by i, then
/// j).
template <int D>
struct Contacts {
  std::size_t count = 0;
  std::vector<std::int32_t> i, j;
  std::array<Array, D> normal;       ///< n, from i to j (2.4)
  Array overlap;                     ///< ξ (2.3)
  Array closing;                     ///< dξ/dt = −v_n (2.6)
  std::array<Array, turns<D>> slip;  ///< v_s: along s = (n_y, −n_x) in 2D (1.14), a vector in 3D (2.7)
  Array m_eff;                       ///< reduced mass; fixed grains count as infinitely heavy
  Array r_eff;                       ///< R_i R_j / (R_i + R_j) if a law needs it, else 0
  Array normal_force;                ///< F_n, repulsion positive
  std::array<Array, turns<D>> shear_force;  ///< F_s on j, in the components of `slip`
  Array normal_loss, shear_loss;            ///< dissipated power
  Array stored;                             ///< energy stored by laws with a memory, if there are any

  void reserve(std::size_t most);
};

}  // namespace chute::soft
