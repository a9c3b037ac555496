#pragma once
#include <vector>

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

/// A wall as a collision sees it, that is touched like that: infinitely heavy, and it moves on as it does.
template <int D>
laws::Collider<D> collider_of(const Wall<D>& wall, const Nearest<D>& touch, double t) {
  laws::Collider<D> collider;
  collider.velocity = wall.surface_velocity(touch, t);
  return collider;
}

}  // namespace chute::hard
