#pragma once
#include "core/clump.hpp"
#include "core/kernel.hpp"
#include "engines/soft/integrator.hpp"

namespace chute::soft {

/// How rigid bodies turn. Their place, velocity, and in 2D their angle and spin are integrated as those of round grains are.
/// In 3D the tensor of inertia turns with the body, so that it is not the spin ω that torques change at a steady rate, but
/// the angular momentum L:
///
///   dL/dt = M,   ω = A I⁻¹ Aᵀ L,   dq/dt = ½ (0, ω) q,
///
/// with I the principal moments, A the matrix of the orientation q. So the integrator's columns of spins hold λ = L/Ī, with
/// Ī the mean principal moment, which is what `inertia` of the bodies is: a sphere's λ is its ω, and what is computed for
/// it is what Integrator computes for round grains, to the last bit. L of a body that nothing pushes stays the same to the
/// last bit, whatever the step.
///
/// The orientation goes on by a step of the classical Runge-Kutta method of fourth order, with L(t) as the integrator has it
/// in that step: a polynomial with gear5, constant with verlet, whose kicks come between. With gear5 a correction follows, as
/// for places: c_0 dt²/2 times what the angular acceleration was off by.
class RigidMotion {
 public:
  RigidMotion(Scheme scheme, double time_step, const Clumps<3>& clumps, Isa isa);

  /// Turns the bodies by a step, after a prediction.
  void turn(Grains<3>& bodies, const Integrator<3>& integrator, Part range) const;
  /// Corrects it, before the correction of all else.
  void correct(Grains<3>& bodies, const GrainSums<3>& sums, const Integrator<3>& integrator,
               Part range) const;

 private:
  Scheme scheme_;
  double dt_;
  Isa isa_;
  std::array<Array, 3> ease_;  // of each body, see Clump
  Array round_;                // 1 for those that spin like a sphere, else 0
};

/// The vector v turned by q, which need not be a unit quaternion: over its square, 1 / `per_square`.
[[gnu::always_inline]] inline Vec<3> turned_by(double w, const Vec<3>& u, const Vec<3>& v,
                                               double per_square = 1) {
  const Vec<3> t = 2 * per_square * cross(u, v);
  return v + w * t + cross(u, t);
}
/// The vector v of the body's frame as it lies in space.
inline Vec<3> in_space(const Orientation<3>& q, const Vec<3>& v) {
  return turned_by(q[0], {{q[1], q[2], q[3]}}, v);
}
inline Vec<2> in_space(const Orientation<2>& angle, const Vec<2>& v) {
  const double c = std::cos(angle[0]), s = std::sin(angle[0]);
  return {{c * v[0] - s * v[1], s * v[0] + c * v[1]}};
}
/// And back.
inline Vec<3> in_body(const Orientation<3>& q, const Vec<3>& v) {
  return turned_by(-q[0], {{q[1], q[2], q[3]}}, v);
}

/// Velocity of a point at `arm` from the centre of mass, but for the centre's own.
inline Vec<2> swing(const Vec<1>& spin, const Vec<2>& arm) { return {{-spin[0] * arm[1], spin[0] * arm[0]}}; }
inline Vec<3> swing(const Vec<3>& spin, const Vec<3>& arm) { return cross(spin, arm); }
/// Torque of a force that acts at `arm`.
inline Vec<1> leverage(const Vec<2>& arm, const Vec<2>& force) {
  return {{arm[0] * force[1] - arm[1] * force[0]}};
}
inline Vec<3> leverage(const Vec<3>& arm, const Vec<3>& force) { return cross(arm, force); }

/// The spin ω of a body whose integrator holds `momentum`, λ = L/Ī.
inline Vec<1> spin_of(const Clump<2>&, const Orientation<2>&, const Vec<1>& momentum) { return momentum; }
inline Vec<3> spin_of(const Clump<3>& clump, const Orientation<3>& q, const Vec<3>& momentum) {
  if (clump.spins_like_a_sphere()) return momentum;
  Vec<3> along = in_body(q, momentum);
  for (int k = 0; k < 3; ++k) along[k] *= clump.ease[k];
  return in_space(q, along);
}
/// λ of a body that spins so.
inline Vec<1> momentum_of(const Clump<2>&, const Orientation<2>&, const Vec<1>& spin) { return spin; }
inline Vec<3> momentum_of(const Clump<3>& clump, const Orientation<3>& q, const Vec<3>& spin) {
  if (clump.spins_like_a_sphere()) return spin;
  Vec<3> along = in_body(q, spin);
  for (int k = 0; k < 3; ++k) along[k] /= clump.ease[k];
  return in_space(q, along);
}

}  // namespace chute::soft
