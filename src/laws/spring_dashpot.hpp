#pragma once
#include <cmath>
#include <numbers>
#include <optional>

#include "laws/mass_scaling.hpp"

namespace chute::laws {

/// A normal force and the power that its dissipative part takes. Positive forces push the grains apart.
struct NormalForce {
  double total;      ///< F_n
  double loss_rate;  ///< dissipated energy per time
};

/// Linear spring with linear damping, thesis (2.8) = (3.1), here with repulsion positive:
///
///     F_n = k_n ξ + γ_n dξ/dt
///
/// with overlap ξ > 0. Near the end of a contact the damping outweighs the spring and the force attracts; the contact
/// ends when ξ returns to 0, so that (3.2), (3.3) hold exactly. Damping is either given (γ_n, subject to
/// `mass_scaling`) or derived for each pair so that the pair has the asked restitution:
/// γ_n = −2 ln e_n √(k_n m_eff / (π² + ln² e_n)), from (3.2) and (3.3).
class SpringDashpot {
 public:
  static SpringDashpot from_restitution(double stiffness, double e_n) {
    const double log_e = std::log(e_n);
    SpringDashpot law;
    law.stiffness_ = stiffness;
    law.damping_per_root_mass_ =
        -2 * log_e * std::sqrt(stiffness / (std::numbers::pi * std::numbers::pi + log_e * log_e));
    return law;
  }
  static SpringDashpot from_damping(double stiffness, double damping, MassScaling scaling) {
    SpringDashpot law;
    (scaling == MassScaling::both ? law.stiffness_per_mass_ : law.stiffness_) = stiffness;
    (scaling == MassScaling::none ? law.damping_ : law.damping_per_mass_) = damping;
    return law;
  }

  double stiffness(double m_eff) const { return stiffness_ + stiffness_per_mass_ * m_eff; }
  double damping(double m_eff) const {
    return damping_ + damping_per_root_mass_ * std::sqrt(m_eff) + damping_per_mass_ * m_eff;
  }

  /// F_n of a contact with overlap `xi` that closes at the rate `dxi` = dξ/dt = −v_n.
  NormalForce operator()(double xi, double dxi, double m_eff) const {
    const double viscous = damping(m_eff) * dxi;
    return {stiffness(m_eff) * xi + viscous, viscous * dxi};
  }

  /// Energy stored at overlap `xi`.
  double energy(double xi, double m_eff) const { return 0.5 * stiffness(m_eff) * xi * xi; }

  /// Duration of a collision, (2.9) = (3.3). NaN if the damping is over-critical: the grains then never part.
  double contact_time(double m_eff) const {
    const double decay = damping(m_eff) / (2 * m_eff);
    return std::numbers::pi / std::sqrt(stiffness(m_eff) / m_eff - decay * decay);
  }
  /// Coefficient of normal restitution, (3.2).
  double restitution(double m_eff) const {
    return std::exp(-damping(m_eff) / (2 * m_eff) * contact_time(m_eff));
  }

 private:
  double stiffness_ = 0, stiffness_per_mass_ = 0;
  double damping_ = 0, damping_per_root_mass_ = 0, damping_per_mass_ = 0;
};

}  // namespace chute::laws
