#pragma once
#include <cmath>
#include <numbers>

#include "laws/keys.hpp"
#include "laws/normal_force.hpp"

namespace chute::laws {

/// E_eff of two bodies, below (1.19): 1/E_eff = (1 − ν_i²)/E_i + (1 − ν_j²)/E_j. Pa.
inline double effective_modulus(double young_i, double poisson_i, double young_j, double poisson_j) {
  return 1 / ((1 - poisson_i * poisson_i) / young_i + (1 - poisson_j * poisson_j) / young_j);
}

/// Elastic contact of two spheres after Hertz, thesis (1.18), repulsion positive:
///
///     F_n = k_n ξ^{3/2}
///
/// k_n (N m^{-3/2}) is given, or follows for each pair from the material, k_n = 4/3 √R_eff E_eff (1.19). It
/// is the elastic part of (3.5) and (3.6) too.
class Hertz {
 public:
  static constexpr std::string_view name = "hertz";
  static constexpr UnitName stiffness_unit = hertz_stiffness_unit;
  static constexpr bool hertz_spring = true;
  using Keys = struct ElasticHertzKeys;

  static Hertz from_stiffness(double stiffness, MassScaling scaling = MassScaling::none) {
    Hertz law;
    (scaling == MassScaling::both ? law.stiffness_.per_mass : law.stiffness_.constant) = stiffness;
    return law;
  }
  /// Both grains of the same material: Young's modulus in Pa, Poisson's ratio.
  static Hertz from_material(double young, double poisson) {
    Hertz law;
    law.stiffness_.per_root_radius = 4.0 / 3 * effective_modulus(young, poisson, young, poisson);
    return law;
  }

  bool needs_radius() const { return stiffness_.needs_radius(); }
  double stiffness(Pair p) const { return stiffness_(p); }
  double damping(Pair) const { return 0; }
  const PairCoefficient& stiffness_coefficient() const { return stiffness_; }

  NormalForce operator()(double xi, double, Pair p) const { return {stiffness_(p) * xi * std::sqrt(xi), 0}; }
  double energy(double xi, Pair p) const { return 0.4 * stiffness_(p) * xi * xi * std::sqrt(xi); }  // (1.25)

  /// Largest overlap (1.26).
  double deepest(double speed, Pair p) const {
    return std::pow(1.25 * p.m_eff / stiffness_(p) * speed * speed, 0.4);
  }
  /// t_n = 3.218 (m_eff/k_n)^{2/5} v^{-1/5}, (1.28) with the factor (5/4)^{2/5} that follows from (1.26) and
  /// (1.27) in place of the printed (4/5)^{2/5}. It is 4√π Γ(2/5) / (5 Γ(9/10)) ξ_0 / v.
  double contact_time(double speed, Pair p) const {
    const double factor = 0.8 * std::sqrt(std::numbers::pi) * std::tgamma(0.4) / std::tgamma(0.9);
    return factor * deepest(speed, p) / speed;
  }
  NormalImpact impact(double speed, Pair p) const { return {1, contact_time(speed, p), deepest(speed, p)}; }

 private:
  PairCoefficient stiffness_;
};

}  // namespace chute::laws
