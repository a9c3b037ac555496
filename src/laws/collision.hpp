#pragma once
#include "core/grains.hpp"
#include "core/vec.hpp"

/// Instantaneous collisions: what the event-driven, hybrid and stochastic methods act with.
namespace chute::laws {

/// A grain as a collision sees it.
template <int D>
struct Collider {
  Vec<D> velocity{};
  Vec<turns<D>> spin{};
  double radius = 0;
  double inverse_mass = 0, inverse_inertia = 0;  ///< 0 for a fixed grain
};

/// Slip of the surfaces of a contact (1.14), (2.7) in space: v_j − v_i, less its part along n, and the spins.
/// (2.7) is used with the sum of the spins; the printed difference contradicts (1.14).
template <int D>
[[gnu::always_inline]] inline Vec<D> surface_slip(const Vec<D>& n, const Collider<D>& i,
                                                  const Collider<D>& j) {
  const Vec<D> dv = j.velocity - i.velocity;
  Vec<D> slip = dv - dot(dv, n) * n;
  if constexpr (D == 2) {
    const double turning = i.radius * i.spin[0] + j.radius * j.spin[0];
    return slip + turning * Vec<2>{{n[1], -n[0]}};  // s = (n_y, −n_x)
  } else {
    return slip + cross(n, i.radius * i.spin + j.radius * j.spin);
  }
}

/// Both grains after the impulse J on j, −J on i, at the point of contact: (2.22) and (2.23), corrected: J
/// acts on j, and I/R Δω = −n × J for both grains.
template <int D>
[[gnu::always_inline]] inline void apply_impulse(const Vec<D>& n, const Vec<D>& impulse, Collider<D>& i,
                                                 Collider<D>& j) {
  i.velocity = i.velocity - i.inverse_mass * impulse;
  j.velocity = j.velocity + j.inverse_mass * impulse;
  Vec<turns<D>> turn;  // n × J
  if constexpr (D == 2)
    turn[0] = n[0] * impulse[1] - n[1] * impulse[0];
  else
    turn = cross(n, impulse);
  i.spin = i.spin - (i.radius * i.inverse_inertia) * turn;
  j.spin = j.spin - (j.radius * j.inverse_inertia) * turn;
}

/// Mass that resists a change of slip: 1/m_s = 1/m_i + 1/m_j + R_i²/I_i + R_j²/I_j. For solid spheres, I =
/// 2/5 m R², it is 2/7 m_eff: the factors 7/2 of (2.24) to (2.31).
template <int D>
double slip_mass(const Collider<D>& i, const Collider<D>& j) {
  return 1 / (i.inverse_mass + j.inverse_mass + i.radius * i.radius * i.inverse_inertia +
              j.radius * j.radius * j.inverse_inertia);
}

}  // namespace chute::laws
