#pragma once
#include <algorithm>
#include <cmath>

#include "core/grains.hpp"

namespace chute::event {

/// What a collision knows of a grain and changes of it. A fixed grain has no inverse mass nor inertia.
template <int D>
struct Partner {
  Vec<D> velocity{};
  Vec<turns<D>> spin{};
  double radius = 0, inverse_mass = 0, inverse_inertia = 0;
};

/// Walton's hard-sphere collision, thesis 2.1.3: three parameters.
struct HardContact {
  double restitution = 1;         ///< e_n, at `velocity` if that is given
  double velocity = 0;            ///< v_n^0 > 0: e_n(v) = 1 − (1 − e_n)(v/v_n^0)^δ, not below 0; 0: e_n is constant
  double exponent = 0.2;          ///< δ; 1/5 is that of viscoelastic spheres, (3.6)
  double friction = 0;            ///< μ
  double tangential = 0;          ///< β = −e_s of a sticking collision, −1 to 1

  double restitution_at(double speed) const {
    if (velocity <= 0) return restitution;
    return std::max(0.0, 1 - (1 - restitution) * std::pow(speed / velocity, exponent));
  }
};

/// What a collision exchanged, and what became heat.
struct Exchange {
  double normal_impulse, shear_impulse;
  double normal_loss, shear_loss;
};

/// Velocity of i's surface against j's in the contact, within its plane, (1.12) and (1.14); n from j to i.
template <int D>
Vec<D> slip(const Vec<D>& n, const Partner<D>& i, const Partner<D>& j) {
  const Vec<D> v = i.velocity - j.velocity;
  Vec<D> s = v - dot(v, n) * n;
  if constexpr (D == 2) {
    const double turn = i.radius * i.spin[0] + j.radius * j.spin[0];  // anticlockwise: carries the contact along (n_y, −n_x)
    return s + turn * Vec<2>{{n[1], -n[0]}};
  } else {
    return s - cross(i.radius * i.spin + j.radius * j.spin, n);
  }
}

/// Changes the velocities and spins of two grains that meet, such that they part at `rebound` = v_n^f. n from j to i.
/// The normal impulse is (2.25) with v_n^f for −e_n v_n^i; the tangential one stops or turns the slip, v_s^f = −β v_s^i (2.30),
/// but is at most μ |J_n| (2.26): the two meet at (2.31). With general moments of inertia 2/7 m_eff of (2.29)
/// becomes m_s, 1/m_s = 1/m_i + 1/m_j + R_i²/I_i + R_j²/I_j.
template <int D>
Exchange collide(const HardContact& law, double rebound, const Vec<D>& n, Partner<D>& i, Partner<D>& j) {
  const double v_n = dot(i.velocity - j.velocity, n);
  const double light = i.inverse_mass + j.inverse_mass;  // 1/m_eff
  const double J_n = (rebound - v_n) / light;
  Exchange exchange{J_n, 0, 0.5 / light * (v_n * v_n - rebound * rebound), 0};

  const Vec<D> v_s = slip(n, i, j);
  const double speed = norm(v_s);
  Vec<D> J = J_n * n;
  if (law.friction > 0 && speed > 0) {
    const double light_s = light + i.radius * i.radius * i.inverse_inertia + j.radius * j.radius * j.inverse_inertia;
    const double J_s = std::min((1 + law.tangential) * speed / light_s, law.friction * J_n);
    const Vec<D> along = (1 / speed) * v_s;
    J = J - J_s * along;
    exchange.shear_impulse = J_s;
    exchange.shear_loss = J_s * (speed - 0.5 * light_s * J_s);
    // The torque of −J_s along on i, acting at −R_i n; on j the force and the lever both turn round.
    if constexpr (D == 2) {
      const double lever = J_s * (along[0] * n[1] - along[1] * n[0]);
      i.spin[0] -= i.radius * i.inverse_inertia * lever;
      j.spin[0] -= j.radius * j.inverse_inertia * lever;
    } else {
      const Vec<3> lever = J_s * cross(n, along);
      i.spin = i.spin + (i.radius * i.inverse_inertia) * lever;
      j.spin = j.spin + (j.radius * j.inverse_inertia) * lever;
    }
  }
  i.velocity = i.velocity + i.inverse_mass * J;
  j.velocity = j.velocity - j.inverse_mass * J;
  return exchange;
}

}  // namespace chute::event
