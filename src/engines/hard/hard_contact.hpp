#pragma once
#include <vector>

#include "core/by_pair.hpp"
#include "core/grains.hpp"
#include "core/wall.hpp"
#include "laws/walton.hpp"

namespace chute::hard {

/// What happens when two hard grains collide.
struct HardContact {
  laws::Restitution restitution;  ///< e_n
  laws::Walton tangential;        ///< μ and β

  /// The same with what is a wall's own.
  HardContact with(const WallSurface& own) const {
    HardContact contact = *this;
    if (own.restitution) contact.restitution = laws::ConstantRestitution{*own.restitution};
    if (own.friction) contact.tangential.friction = *own.friction;
    if (own.tangential_restitution) contact.tangential.beta = *own.tangential_restitution;
    return contact;
  }
};

/// The material of a grain, or from their number on of a wall.
template <int D>
int material_of(const Grains<D>& grains, const std::vector<Wall<D>>& walls, std::size_t k) {
  return k < grains.size() ? grains.material[k] : walls[k - grains.size()].surface.material;
}

/// The contact of two: `setup.contact`, or where contacts depend on the materials that of theirs. `j` may be a wall.
template <int D, class Setup>
const HardContact& contact_between(const Setup& setup, const Grains<D>& grains, std::size_t i,
                                   std::size_t j) {
  if (setup.between.empty()) return setup.contact;
  return setup.between(material_of(grains, setup.walls, i), material_of(grains, setup.walls, j));
}

/// A wall as a collision sees it, that is touched like that: infinitely heavy, and it moves on as it does.
template <int D>
laws::Collider<D> collider_of(const Wall<D>& wall, const Nearest<D>& touch, double t) {
  laws::Collider<D> collider;
  collider.velocity = wall.surface_velocity(touch, t);
  return collider;
}

}  // namespace chute::hard
