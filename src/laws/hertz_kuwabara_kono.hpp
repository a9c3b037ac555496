#pragma once
#include "laws/hertz_keys.hpp"

namespace chute::laws {

/// Viscoelastic spheres after Kuwabara and Kono, and Brilliantov et al., thesis (3.6), repulsion positive:
///
///     F_n = k_n ξ^{3/2} + γ_n √ξ dξ/dt
///
/// Impacts become less elastic with speed, 1 − e_n ∝ v^{1/5}. γ_n (kg m^{-1/2} s^{-1}) is given, or as the
/// relaxation time A of the material, γ_n = 3/2 A k_n, which is the same for all pairs of one material.
class HertzKuwabaraKono {
 public:
  static constexpr std::string_view name = "hertz-kuwabara-kono";
  static constexpr UnitName stiffness_unit = hertz_stiffness_unit,
                            damping_unit{"kg/(m^0.5 s)", "m sqrt(g)/d"};
  static constexpr bool hertz_spring = true;
  struct Keys;

  static HertzKuwabaraKono from_damping(const Hertz& elastic, double damping, MassScaling scaling) {
    HertzKuwabaraKono law(elastic);
    (scaling == MassScaling::none ? law.damping_.constant : law.damping_.per_mass) = damping;
    return law;
  }
  static HertzKuwabaraKono from_relaxation(const Hertz& elastic, double relaxation) {
    HertzKuwabaraKono law(elastic);
    law.damping_ = elastic.stiffness_coefficient().scaled(1.5 * relaxation);
    return law;
  }

  bool needs_radius() const { return elastic_.needs_radius() || damping_.needs_radius(); }
  double stiffness(Pair p) const { return elastic_.stiffness(p); }
  double damping(Pair p) const { return damping_(p); }
  const PairCoefficient& stiffness_coefficient() const { return elastic_.stiffness_coefficient(); }

  NormalForce operator()(double xi, double dxi, Pair p) const {
    const double root = std::sqrt(xi), viscous = damping_(p) * root * dxi;
    return {elastic_.stiffness(p) * xi * root + viscous, viscous * dxi};
  }
  double energy(double xi, Pair p) const { return elastic_.energy(xi, p); }
  NormalImpact impact(double speed, Pair p) const {
    return integrate_impact([&](double xi, double dxi) { return (*this)(xi, dxi, p).total; }, p.m_eff, speed,
                            elastic_.contact_time(speed, p));
  }

 private:
  explicit HertzKuwabaraKono(const Hertz& elastic) : elastic_(elastic) {}
  Hertz elastic_;
  PairCoefficient damping_;
};

/// Besides e_n or γ_n it takes the relaxation time A. One material has one A, so that is what a restitution
/// of the reference pair fixes; a given γ_n is that of every pair.
struct HertzKuwabaraKono::Keys : DampedHertzKeys {
  std::optional<double> relaxation;

  template <class Archive>
  void describe(Archive& a) {
    describe_spring(a);
    DampingKeys::describe(a);
    a.value("relaxation", relaxation, non_negative, "relaxation time A of the material");
    describe_rest(a);
    a.check(count_given(restitution, damping, relaxation) == 1, damping ? "damping" : "restitution",
            "give one of restitution, damping and relaxation");
    check_time(a, contact_time);
  }
  HertzKuwabaraKono make(const Reference& reference) const {
    if (relaxation) return from_relaxation(spring(0), *relaxation);
    return damped(reference, [&](const Hertz& elastic, double gamma) {
      return damping ? from_damping(elastic, gamma, mass_scaling)
                     : from_relaxation(elastic, gamma / (1.5 * elastic.stiffness(reference.pair)));
    });
  }
};

}  // namespace chute::laws
