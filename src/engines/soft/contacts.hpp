#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/grains.hpp"
#include "core/team.hpp"

namespace chute::soft {

/// The end of the contacts, rounded up so that vector loops need no rest of single ones.
inline std::size_t padded(std::size_t count) { return (count + 7) / 8 * 8; }

/// Everything about the contacts of one instant, one array per field, ordered as the pair list (so by i, then
/// j).
template <int D>
struct Contacts {
  std::size_t count = 0;
  std::vector<std::int32_t> i, j;
  std::vector<std::int32_t> law;     ///< which of the laws, where there are several (LawTable)
  std::array<Array, D> normal;       ///< n, from i to j (2.4)
  Array overlap;                     ///< ξ (2.3)
  Array closing;                     ///< dξ/dt = −v_n (2.6)
  std::array<Array, turns<D>> slip;  ///< v_s: along s = (n_y, −n_x) in 2D (1.14), a vector in 3D (2.7)
  Array m_eff;                       ///< reduced mass, as in the pair list
  Array r_eff;                       ///< R_i R_j / (R_i + R_j) if a law needs it, else 0
  Array normal_force;                ///< F_n, repulsion positive
  std::array<Array, turns<D>> shear_force;  ///< F_s on j, in the components of `slip`
  Array normal_loss, shear_loss;            ///< dissipated power
  Array weight;   ///< of what is there at once, where contacts begin and end (EndWeights)
  Array stored;   ///< energy stored by laws with a memory, if there are any
  char deep = 0;  ///< is any overlap deeper than the stages watch for?

  /// Makes room for `most` contacts, and as many more as fill up a vector (see `padded`).
  void reserve(std::size_t most);
};

/// The force of a contact on its second grain.
template <int D>
Vec<D> force_on_second(const Contacts<D>& contacts, std::size_t c) {
  Vec<D> n;
  for (int k = 0; k < D; ++k) n[k] = contacts.normal[k][c];
  Vec<D> force = contacts.normal_force[c] * n;
  if constexpr (D == 2) {
    force[0] += contacts.shear_force[0][c] * n[1];
    force[1] -= contacts.shear_force[0][c] * n[0];
  } else {
    for (int k = 0; k < 3; ++k) force[k] += contacts.shear_force[k][c];
  }
  return force;
}

/// What contacts come to for each grain: force and torque on it now, and the energy that was taken since the
/// start by the contacts in which it comes first. Losses are kept by grain so that their sums depend neither
/// on who summed them nor in which order grains came by.
template <int D>
struct GrainSums {
  std::array<Array, D> force;
  std::array<Array, turns<D>> torque;
  Array normal_loss, shear_loss;

  void resize(std::size_t grains) {
    for (auto& f : force) f.resize(grains);
    for (auto& t : torque) t.resize(grains);
    normal_loss.resize(grains);
    shear_loss.resize(grains);
  }
  /// Forces and torques only.
  void clear(Part range) {
    const auto zero = [&](Array& a) { std::fill(a.data() + range.begin, a.data() + range.end, 0.0); };
    for (auto& f : force) zero(f);
    for (auto& t : torque) zero(t);
  }
  /// The same of the fixed grains, which lie behind the `moving` ones. Only the last contacts have put something on them, and
  /// a few grains on a plane of thousands touch few of them: clearing them all took half of the time of a ball's step.
  void clear_fixed(const Contacts<D>& last, std::size_t moving) {
    const std::size_t all = normal_loss.size();
    if (last.count >= all - moving) return clear({moving, all});
    for (std::size_t c = 0; c < last.count; ++c)
      if (const auto j = static_cast<std::size_t>(last.j[c]); j >= moving) clear({j, j + 1});
  }
};

}  // namespace chute::soft
