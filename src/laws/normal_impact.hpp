#pragma once
#include <algorithm>
#include <functional>

#include "laws/normal_force.hpp"
#include "laws/pair.hpp"

/// Head-on impacts by numerical integration, for laws without a closed form.
namespace chute::laws {

/// What a head-on impact with `speed` > 0 does to a pair of reduced mass m_eff under the force F_n(ξ, dξ/dt),
/// repulsion positive, that needs no memory. `time_scale` is roughly the contact time. m_eff ξ'' = −F_n is
/// integrated with an adaptive fifth-order Runge-Kutta method to about 1e-9; the end, ξ = 0, is met exactly.
/// Grains that creep apart ever slower, longer than 1000 time scales, count as never parting: e_n = 0.
NormalImpact integrate_impact(const std::function<double(double, double)>& force, double m_eff, double speed,
                              double time_scale);

/// A head-on impact under a law without a memory; without attraction its force is clipped at 0.
template <class Law>
NormalImpact impact_of(const Law& law, bool attraction, double speed, Pair p) {
  const NormalImpact free = law.impact(speed, p);
  if (attraction || law.damping(p) == 0) return free;
  const auto clipped = [&](double xi, double dxi) { return std::max(0.0, law(xi, dxi, p).total); };
  return integrate_impact(clipped, p.m_eff, speed, free.deepest / speed * 3);
}

/// The damping at which `restitution(damping)`, a function that falls from 1 at 0, takes the value e_n in (0,
/// 1]: doubling from `guess`, then halving.
double damping_for(const std::function<double(double)>& restitution, double e_n, double guess);

}  // namespace chute::laws
