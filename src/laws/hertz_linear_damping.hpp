#pragma once
#include "laws/hertz_keys.hpp"

namespace chute::laws {

/// Hertz's spring with linear damping, thesis (3.5), repulsion positive:
///
///     F_n = k_n ξ^{3/2} + γ_n dξ/dt
///
/// Impacts become more elastic with speed, 1 − e_n ∝ v^{-1/5}, against the experiments. Below a speed that
/// grows with the damping the grains never part (e_n = 0): near ξ = 0 the damping wins and they creep, ξ ∝
/// t^{-2}.
class HertzLinearDamping {
 public:
  static constexpr std::string_view name = "hertz-linear-damping";
  static constexpr UnitName stiffness_unit = hertz_stiffness_unit, damping_unit{"kg/s", "m sqrt(g/d)"};
  static constexpr bool hertz_spring = true, acts_at_once = true;
  struct Keys;

  /// γ_n in kg/s, multiplied by m_eff with the mass conventions `damping` and `both`.
  HertzLinearDamping(const Hertz& elastic, double damping, MassScaling scaling) : elastic_(elastic) {
    (scaling == MassScaling::none ? damping_.constant : damping_.per_mass) = damping;
  }

  bool needs_radius() const { return elastic_.needs_radius(); }
  double stiffness(Pair p) const { return elastic_.stiffness(p); }
  double damping(Pair p) const { return damping_(p); }
  const PairCoefficient& stiffness_coefficient() const { return elastic_.stiffness_coefficient(); }

  NormalForce operator()(double xi, double dxi, Pair p) const {
    const double viscous = damping_(p) * dxi;
    return {elastic_(xi, dxi, p).total + viscous, viscous * dxi, viscous};
  }
  double energy(double xi, Pair p) const { return elastic_.energy(xi, p); }
  NormalImpact impact(double speed, Pair p) const {
    return integrate_impact([&](double xi, double dxi) { return (*this)(xi, dxi, p).total; }, p.m_eff, speed,
                            elastic_.contact_time(speed, p));
  }

 private:
  Hertz elastic_;
  PairCoefficient damping_;
};

struct HertzLinearDamping::Keys : DampedHertzKeys {
  HertzLinearDamping make(const Reference& reference) const {
    return damped(reference, [this](const Hertz& elastic, double gamma) {
      return HertzLinearDamping(elastic, gamma, mass_scaling);
    });
  }
};

}  // namespace chute::laws
