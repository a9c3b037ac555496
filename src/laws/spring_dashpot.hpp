#pragma once
#include <cmath>
#include <numbers>

#include "common/root.hpp"
#include "laws/keys.hpp"
#include "laws/normal_impact.hpp"

namespace chute::laws {

/// Linear spring with linear damping, thesis (2.8) = (3.1), here with repulsion positive:
///
///     F_n = k_n ξ + γ_n dξ/dt
///
/// with overlap ξ > 0. Near the end of a contact the damping outweighs the spring and the force attracts; the
/// contact ends when ξ returns to 0, so that (3.2), (3.3) hold exactly. Damping is either given (γ_n, subject
/// to `mass_scaling`) or derived for each pair so that the pair has the asked restitution: γ_n = −2 ln e_n
/// √(k_n m_eff / (π² + ln² e_n)), from (3.2) and (3.3).
///
/// Where attraction is not allowed (laws::ContactLaws::attraction), the grains part when the force vanishes and
/// drift until ξ = 0. They lose less then; `clipped_restitution` is the closed form, and `from_restitution`
/// takes the damping that gives the asked restitution in that case.
class SpringDashpot {
 public:
  static constexpr std::string_view name = "spring-dashpot";
  static constexpr UnitName stiffness_unit = linear_stiffness_unit, damping_unit{"kg/s", "m sqrt(g/d)"};
  static constexpr bool acts_at_once = true, linear_spring = true;
  struct Keys;

  static SpringDashpot from_restitution(double stiffness, double e_n, bool attraction = true) {
    const double log_e = std::log(e_n);
    SpringDashpot law;
    law.stiffness_ = stiffness;
    law.damping_per_root_mass_ =
        attraction ? -2 * log_e * std::sqrt(stiffness / (std::numbers::pi * std::numbers::pi + log_e * log_e))
                   : 2 * clipped_damping_ratio(e_n) * std::sqrt(stiffness);
    return law;
  }
  static SpringDashpot from_damping(double stiffness, double damping, MassScaling scaling) {
    SpringDashpot law;
    (scaling == MassScaling::both ? law.stiffness_per_mass_ : law.stiffness_) = stiffness;
    (scaling == MassScaling::none ? law.damping_ : law.damping_per_mass_) = damping;
    return law;
  }

  bool needs_radius() const { return false; }
  double stiffness(Pair p) const { return stiffness_ + stiffness_per_mass_ * p.m_eff; }
  PairCoefficient stiffness_coefficient() const { return {stiffness_, stiffness_per_mass_, 0, 0}; }
  double damping(Pair p) const {
    return damping_ + damping_per_root_mass_ * std::sqrt(p.m_eff) + damping_per_mass_ * p.m_eff;
  }

  /// F_n of a contact with overlap `xi` that closes at the rate `dxi` = dξ/dt = −v_n.
  NormalForce operator()(double xi, double dxi, Pair p) const {
    const double viscous = damping(p) * dxi;
    return {stiffness(p) * xi + viscous, viscous * dxi, viscous};
  }

  /// Energy stored at overlap `xi`.
  double energy(double xi, Pair p) const { return 0.5 * stiffness(p) * xi * xi; }

  /// Duration of a collision, (2.9) = (3.3). NaN if the damping is over-critical: the grains then never part.
  double contact_time(Pair p) const {
    const double decay = damping(p) / (2 * p.m_eff);
    return std::numbers::pi / std::sqrt(stiffness(p) / p.m_eff - decay * decay);
  }
  /// Coefficient of normal restitution, (3.2).
  double restitution(Pair p) const { return std::exp(-damping(p) / (2 * p.m_eff) * contact_time(p)); }

  /// A head-on impact with the given speed; the deepest overlap is ξ_0 = v √(m/k) exp(−x/√(1−x²) arccos x)
  /// with the damping ratio x, the equality in (3.4) for x = 0. With over-critical damping the grains never
  /// part.
  NormalImpact impact(double speed, Pair p) const {
    const double ratio = damping(p) / (2 * std::sqrt(stiffness(p) * p.m_eff));
    const double free = speed * std::sqrt(p.m_eff / stiffness(p));
    if (!(ratio < 1)) return {0, INFINITY, free * std::exp(-1.0)};  // at the critical damping, else a bound
    const double deepest = free * std::exp(-ratio / std::sqrt(1 - ratio * ratio) * std::acos(ratio));
    return {restitution(p), contact_time(p), deepest};
  }

  /// Restitution with the attraction clipped, for a damping ratio x = γ_n / (2 √(k_n m_eff)) below 1. The
  /// force is 0 at ω t = atan2(2 x w, 2 x² − 1), with w = √(1 − x²) the frequency in units of √(k_n/m_eff).
  static double clipped_restitution(double ratio) {
    const double w = std::sqrt(1 - ratio * ratio), phase = std::atan2(2 * ratio * w, 2 * ratio * ratio - 1);
    return std::exp(-ratio / w * phase) * (ratio / w * std::sin(phase) - std::cos(phase));
  }

 private:
  double stiffness_ = 0, stiffness_per_mass_ = 0;
  double damping_ = 0, damping_per_root_mass_ = 0, damping_per_mass_ = 0;

  /// Inverse of clipped_restitution, which falls from 1 to e^-2 at ratio 1. Restitutions below e^-2 = 0.135 need
  /// over-critical damping and give the ratio 1.
  static double clipped_damping_ratio(double e_n) {
    constexpr double last = 1 - 1e-9;  // at 1 the form is 0/0
    if (e_n >= 1) return 0;
    if (e_n <= clipped_restitution(last)) return 1;
    return root_between([&](double ratio) { return clipped_restitution(ratio) - e_n; }, 0, last);
  }
};

/// k_n (N/m) or t_n of the reference pair; e_n, of every pair, or γ_n (kg/s).
struct SpringDashpot::Keys : DampingKeys {
  std::optional<double> stiffness, contact_time;

  template <class Archive>
  void describe(Archive& a) {
    a.value("stiffness", stiffness, positive, "k_n");
    a.value("contact_time", contact_time, positive, "t_n of the reference pair, instead of a stiffness");
    DampingKeys::describe(a);
    describe_scaling(a);
    a.check(count_given(stiffness, contact_time) == 1, "law", "give either stiffness or contact_time");
    check(a, contact_time);
  }
  SpringDashpot make(const Reference& reference) const {
    if (damping) return from_damping(*stiffness, *damping, mass_scaling);
    const auto with = [&](double k) { return from_restitution(k, *restitution, reference.attraction); };
    if (stiffness) return with(*stiffness);
    const double t_n = impact_of(with(1), reference.attraction, 1, reference.pair).contact_time;
    return with(std::pow(t_n / *contact_time, 2));  // t_n ∝ k_n^{-1/2} at equal restitution
  }
};

}  // namespace chute::laws
