#pragma once
#include <cstdint>

#include "core/domain.hpp"
#include "core/engine.hpp"
#include "core/grains.hpp"
#include "core/kernel.hpp"
#include "laws/list.hpp"
#include "search/pairs.hpp"

namespace chute::soft {

/// Everything about the contacts of one instant, one array per field, ordered as the pair list (so by i, then j).
template <int D>
struct Contacts {
  std::size_t count = 0;
  std::vector<std::int32_t> i, j;
  std::array<Array, D> normal;       ///< n, from i to j (2.4)
  Array overlap;                     ///< ξ (2.3)
  Array closing;                     ///< dξ/dt = −v_n (2.6)
  std::array<Array, turns<D>> slip;  ///< v_s: along s = (n_y, −n_x) in 2D (1.14), a vector in 3D (2.7)
  Array m_eff;                       ///< reduced mass; fixed grains count as infinitely heavy
  Array normal_force;                ///< F_n, repulsion positive
  std::array<Array, turns<D>> shear_force;  ///< F_s on j, in the components of `slip`
  Array normal_loss, shear_loss;            ///< dissipated power

  void reserve(std::size_t most);
};

/// The stages that turn places and velocities into forces, each a vectorised loop over arrays:
/// find_touching → geometry → normal → shear → apply.
template <int D>
class ContactStages {
 public:
  ContactStages(const Domain<D>& domain, const laws::Contact& laws, Isa isa = best_isa());

  /// Fills `contacts` from the pairs that may touch. Allocates only when the list has become longer than ever before.
  void evaluate(const search::PairList& pairs, const Grains<D>& grains, Contacts<D>& contacts);

  /// Adds the forces and torques of the contacts, in their order, to those of the grains.
  void apply(const Contacts<D>& contacts, const Grains<D>& grains, std::array<Array, D>& force,
             std::array<Array, turns<D>>& torque) const;

  /// Energy stored in the contacts.
  double elastic_energy(const Contacts<D>& contacts) const;

 private:
  Domain<D> domain_;
  laws::Contact laws_;
  Isa isa_;
  std::vector<std::int64_t> hit_;  // 1 where a pair touches; as wide as a double, to stay in the same vector lanes
  std::vector<std::int32_t> touching_;

  void find_touching(const search::PairList& pairs, const Grains<D>& grains, Contacts<D>& contacts);
  void geometry(const Grains<D>& grains, Contacts<D>& contacts) const;
};

}  // namespace chute::soft
