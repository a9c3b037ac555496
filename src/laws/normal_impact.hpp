#pragma once
#include <functional>

#include "laws/normal_force.hpp"

/// Head-on impacts by numerical integration, for laws without a closed form.
namespace chute::laws {

/// What a head-on impact with `speed` > 0 does to a pair of reduced mass m_eff under the force F_n(ξ, dξ/dt),
/// repulsion positive, that needs no memory. `time_scale` is roughly the contact time. m_eff ξ'' = −F_n is
/// integrated with an adaptive fifth-order Runge-Kutta method to about 1e-9; the end, ξ = 0, is met exactly.
/// Grains that creep apart ever slower, longer than 1000 time scales, count as never parting: e_n = 0.
NormalImpact integrate_impact(const std::function<double(double, double)>& force, double m_eff, double speed,
                              double time_scale);

/// The damping at which `restitution(damping)`, a function that falls from 1 at 0, takes the value e_n in (0,
/// 1]: doubling from `guess`, then halving.
double damping_for(const std::function<double(double)>& restitution, double e_n, double guess);

}  // namespace chute::laws
