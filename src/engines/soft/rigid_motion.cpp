#include "engines/soft/rigid_motion.hpp"

#include <cmath>

namespace chute::soft {
namespace {

/// λ within the step that led to the predicted values.
struct MomentumInStep {
  Vec<3> now{}, first{}, second{}, third{};  // predicted, with its derivatives

  Vec<3> before(double time) const {
    return now - time * (first - (time / 2) * (second - (time / 3) * third));
  }
};

MomentumInStep momentum_in_step(Scheme scheme, const Grains<3>& bodies, const Integrator<3>& integrator,
                                std::size_t i) {
  MomentumInStep m{bodies.turning(i)};
  if (scheme != Scheme::gear5) return m;
  const auto& d = integrator.derivatives();
  for (std::size_t k = 0; k < 3; ++k) {
    const int axis = static_cast<int>(k);
    m.first[axis] = d[0][3 + k][i], m.second[axis] = d[1][3 + k][i], m.third[axis] = d[2][3 + k][i];
  }
  return m;
}

Vec<4> unit(const Vec<4>& q) { return (1 / std::sqrt(dot(q, q))) * q; }

/// dq/dt = ½ (0, ω) q = ½ q (0, Aᵀω)
Vec<4> rate(const Clump<3>& clump, const Vec<4>& q, const Vec<3>& momentum) {
  const Vec<3> own = turned_by(-q[0], {{q[1], q[2], q[3]}}, momentum, 1 / dot(q, q));
  return quaternion_product(
      q, {{0, 0.5 * clump.ease[0] * own[0], 0.5 * clump.ease[1] * own[1], 0.5 * clump.ease[2] * own[2]}});
}

Vec<4> runge_kutta(const Clump<3>& clump, const Vec<4>& q, const MomentumInStep& momentum, double dt) {
  const Vec<3> middle = momentum.before(dt / 2);
  const Vec<4> k1 = rate(clump, q, momentum.before(dt)), k2 = rate(clump, q + (dt / 2) * k1, middle),
               k3 = rate(clump, q + (dt / 2) * k2, middle), k4 = rate(clump, q + dt * k3, momentum.now);
  return unit(q + (dt / 6) * (k1 + 2.0 * k2 + 2.0 * k3 + k4));
}

/// As Integrator turns round grains.
Vec<4> cayley(const Vec<4>& q, const MomentumInStep& momentum, double dt, double back) {
  Vec<3> h;
  double square = 0;
  for (int k = 0; k < 3; ++k) {
    h[k] = dt / 4 * (momentum.now[k] - back * momentum.first[k]);
    square += h[k] * h[k];
  }
  const double scale = 1 / (1 + square), s = 2 * scale;
  return quaternion_product({{(1 - square) * scale, s * h[0], s * h[1], s * h[2]}}, q);
}

void put(Grains<3>& bodies, std::size_t i, const Vec<4>& q) {
  for (std::size_t k = 0; k < 4; ++k) bodies.orientation[k][i] = q[static_cast<int>(k)];
}

}  // namespace

void RigidMotion::turn(Grains<3>& bodies, const Clumps<3>& clumps, const Integrator<3>& integrator,
                       Part range) const {
  const double back = scheme_ == Scheme::gear5 ? dt_ / 2 : 0.0;
  for (std::size_t i = range.begin; i < range.end; ++i) {
    const auto& clump = clumps.of(i);
    const auto momentum = momentum_in_step(scheme_, bodies, integrator, i);
    const Vec<4> q = bodies.attitude(i);
    put(bodies, i,
        clump.spins_like_a_sphere() ? cayley(q, momentum, dt_, back) : runge_kutta(clump, q, momentum, dt_));
  }
}

void RigidMotion::correct(Grains<3>& bodies, const Clumps<3>& clumps, const GrainSums<3>& sums,
                          const Integrator<3>& integrator, Part range) const {
  if (scheme_ != Scheme::gear5) return;
  const double weight = 19.0 / 90 * dt_ * dt_ / 2;  // c_0 (2.14), as for places
  for (std::size_t i = range.begin; i < range.end; ++i) {
    const auto& clump = clumps.of(i);
    if (clump.spins_like_a_sphere()) continue;
    const Vec<4> q = bodies.attitude(i);
    Vec<3> off;
    for (std::size_t k = 0; k < 3; ++k)
      off[static_cast<int>(k)] =
          weight * (sums.torque[k][i] * bodies.inverse_inertia[i] - integrator.derivatives()[0][3 + k][i]);
    const Vec<3> half = 0.5 * spin_of(clump, q, off);
    put(bodies, i, unit(quaternion_product({{1, half[0], half[1], half[2]}}, q)));
  }
}

}  // namespace chute::soft
