#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "laws/keys.hpp"
#include "laws/normal_force.hpp"

namespace chute::laws {

/// Plastic deformation after Walton and Braun, thesis (3.7), repulsion positive:
///
///     F_n = k_1 ξ            while the contact is loaded further than ever before,
///     F_n = k_2 (ξ − ξ_0)    while it is unloaded and loaded again, and 0 for ξ < ξ_0,
///
/// with ξ_0 = (1 − k_1/k_2) ξ_max, where the second line leaves the first. k_2 is constant, e_n = √(k_1/k_2),
/// or grows with the largest force, k_2 = k_1 + s k_1 ξ_max; then (3.8) holds. As printed, (3.7) has the sign
/// of an attraction, would attract for ξ < ξ_0, and would jump back to the first line, out of nothing, when
/// an unloading turns round.
///
/// Remembers ξ_max. The contact forgets its deformation when ξ returns to 0.
class WaltonBraun {
 public:
  static constexpr std::string_view name = "walton-braun";
  static constexpr UnitName stiffness_unit = linear_stiffness_unit;
  static constexpr int memory = 1;
  struct Keys;

  /// k_1, k_2 in N/m, k_2 ≥ k_1.
  static WaltonBraun from_stiffnesses(double loading, double unloading) { return {loading, unloading, 0}; }
  /// k_1 in N/m and the constant restitution.
  static WaltonBraun from_restitution(double loading, double e_n) {
    return {loading, loading / (e_n * e_n), 0};
  }
  /// k_1 in N/m and s in 1/m: the load-dependent k_2.
  static WaltonBraun from_hardening(double loading, double s) { return {loading, loading, s}; }

  bool needs_radius() const { return false; }
  double stiffness(Pair) const { return k_1_; }
  double damping(Pair) const { return 0; }
  PairCoefficient stiffness_coefficient() const { return {k_1_, 0, 0, 0}; }
  double unloading_stiffness(double xi_max) const { return k_2_ + s_ * k_1_ * xi_max; }

  RememberedForce operator()(double xi, double, Pair, std::array<double, memory>& remembered) const {
    double& xi_max = remembered[0];
    const double before = lost(xi_max);
    xi_max = std::max(xi_max, xi);
    const double k_2 = unloading_stiffness(xi_max);
    // On the first line this is k_2 ξ − (k_2 − k_1) ξ = k_1 ξ.
    return {std::max(0.0, k_2 * xi - (k_2 - k_1_) * xi_max), lost(xi_max) - before};
  }

  /// What unloading would give back: ½ k_2 (ξ − ξ_0)².
  double energy(double xi, Pair, const std::array<double, memory>& remembered) const {
    const double k_2 = unloading_stiffness(remembered[0]);
    const double force = std::max(0.0, k_2 * xi - (k_2 - k_1_) * remembered[0]);
    return 0.5 * force * force / k_2;
  }

  /// A quarter of a period with k_1, one with k_2, and the free way from ξ_0 to 0. e_n = √(k_1/k_2), with
  /// (3.8) where k_2 depends on the load.
  NormalImpact impact(double speed, Pair p) const {
    const double loading = std::sqrt(p.m_eff / k_1_), deepest = speed * loading;
    const double k_2 = unloading_stiffness(deepest), e_n = std::sqrt(k_1_ / k_2);
    const double drift = deepest * (1 - k_1_ / k_2) / (e_n * speed);
    return {e_n, std::numbers::pi / 2 * (loading + std::sqrt(p.m_eff / k_2)) + drift, deepest};
  }

 private:
  WaltonBraun(double k_1, double k_2, double s) : k_1_(k_1), k_2_(k_2), s_(s) {}
  double k_1_, k_2_, s_;

  /// Energy that a loading up to ξ_max has cost for good: the area between the two lines.
  double lost(double xi_max) const {
    return 0.5 * k_1_ * xi_max * xi_max * (1 - k_1_ / unloading_stiffness(xi_max));
  }
};

/// k_1, and one of e_n, k_2 and s.
struct WaltonBraun::Keys {
  double stiffness = 0;
  std::optional<double> restitution, unloading_stiffness, hardening, at_velocity;

  template <class Archive>
  void describe(Archive& a) {
    a.required("stiffness", stiffness, positive, "k_1, of the loading");
    a.value("restitution", restitution, restitution_range, "e_n, of every pair");
    a.value("unloading_stiffness", unloading_stiffness, positive, "k_2");
    a.value("hardening", hardening, non_negative, "s: k_2 grows with the largest force");
    if (hardening)
      a.required("at_velocity", at_velocity, positive, "impact velocity that t_n and e_n hold for");
    a.check(count_given(restitution, unloading_stiffness, hardening) == 1, "law",
            "give one of restitution, unloading_stiffness and hardening");
    a.check(!unloading_stiffness || *unloading_stiffness >= stiffness, "unloading_stiffness",
            "must not be less than the stiffness of the loading");
  }
  WaltonBraun make(const Reference&) const {
    return restitution ? from_restitution(stiffness, *restitution)
           : hardening ? from_hardening(stiffness, *hardening)
                       : from_stiffnesses(stiffness, *unloading_stiffness);
  }
};

}  // namespace chute::laws
