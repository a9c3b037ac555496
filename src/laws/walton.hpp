#pragma once
#include <algorithm>
#include <cmath>

#include "laws/collision.hpp"
#include "laws/restitution.hpp"

namespace chute::laws {

/// What a collision did.
template <int D>
struct Collision {
  Vec<D> impulse{};  ///< on j
  bool sliding = false;
  double normal_loss = 0, shear_loss = 0;  ///< energies dissipated; neither is ever negative
};

/// Walton's three-parameter model of a collision, thesis 2.1.3: restitution e_n, friction μ for collisions
/// that slide, and tangential restitution e_s = −β for those that stick. With v_n < 0 on approach:
///
///     J_n = −m_eff (1 + e_n) v_n                                     (2.25)
///     J_s = −m_s (1 + β) v_s         if that is no more than μ J_n,  (2.29), printed with β − 1
///     J_s = −μ J_n v_s / |v_s|       else                            (2.26)
///
/// m_s = 2/7 m_eff for solid spheres. So ψ_f = −β ψ_i up to ψ_0 = 7/2 μ (1 + e_n)/(1 + β) (2.31), printed
/// with 1 − β, and ψ_f = ψ_i − 7/2 μ (1 + e_n) beyond (2.28), where the sign is that of ψ. J acts on j
/// (2.22).
struct Walton {
  double friction = 0;  ///< μ ≥ 0
  double beta = 0;      ///< β in [−1, 1]: 1 is perfectly rough, 0 stops the slip, −1 is smooth

  /// Lets i and j, whose line of centres is n from i to j, collide with the restitution e_n in [0, 1]. Grains
  /// that do not approach are left alone.
  template <int D>
  Collision<D> operator()(const Vec<D>& n, double e_n, Collider<D>& i, Collider<D>& j) const {
    Collision<D> collision;
    const double v_n = dot(j.velocity - i.velocity, n);
    if (v_n >= 0) return collision;
    const double m_eff = 1 / (i.inverse_mass + j.inverse_mass), m_s = slip_mass(i, j);
    const double J_n = -m_eff * (1 + e_n) * v_n;
    const Vec<D> slip = surface_slip(n, i, j);
    const double v_s = norm(slip), sticking = m_s * (1 + beta) * v_s;
    collision.sliding = sticking > friction * J_n;
    const double J_s = std::min(sticking, friction * J_n);
    collision.impulse = J_n * n;
    if (v_s > 0) collision.impulse = collision.impulse - (J_s / v_s) * slip;
    collision.normal_loss = 0.5 * m_eff * (1 - e_n * e_n) * v_n * v_n;
    collision.shear_loss = J_s * (v_s - 0.5 * J_s / m_s);
    apply_impulse(n, collision.impulse, i, j);
    return collision;
  }
  template <int D>
  Collision<D> operator()(const Vec<D>& n, const Restitution& e_n, Collider<D>& i, Collider<D>& j) const {
    return (*this)(n, restitution_at(e_n, dot(j.velocity - i.velocity, n)), i, j);
  }
};

}  // namespace chute::laws
