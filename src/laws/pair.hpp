#pragma once
#include <cmath>

namespace chute::laws {

/// What a law may know of the two grains of a contact. A plain mass converts, for laws that ask for no more.
struct Pair {
  double m_eff;  ///< reduced mass m_i m_j / (m_i + m_j); a fixed grain counts as infinitely heavy
  double r_eff;  ///< R_i R_j / (R_i + R_j); 0 where it was not asked for (see `needs_radius`)
  Pair(double reduced_mass, double effective_radius = 0) : m_eff(reduced_mass), r_eff(effective_radius) {}
};

/// A stiffness or damping that may depend on the pair: by the mass conventions of thesis 3.1.1 (per_mass), by
/// an asked restitution (per_root_mass), or by Hertz's theory of a material (per_root_radius, (1.19)).
struct PairCoefficient {
  double constant = 0, per_mass = 0, per_root_mass = 0, per_root_radius = 0;
  double operator()(Pair p) const {
    return constant + per_mass * p.m_eff + per_root_mass * std::sqrt(p.m_eff) +
           per_root_radius * std::sqrt(p.r_eff);
  }
  bool needs_radius() const { return per_root_radius != 0; }
  PairCoefficient scaled(double factor) const {
    return {factor * constant, factor * per_mass, factor * per_root_mass, factor * per_root_radius};
  }
};

}  // namespace chute::laws
