#pragma once
#include "laws/hertz.hpp"
#include "laws/keys.hpp"
#include "laws/normal_impact.hpp"

namespace chute::laws {

/// Hertz's spring in a scene: k_n (N m^{-3/2}), t_n of the reference pair, or the material (1.19). Contact
/// times and restitutions hold at one impact velocity.
struct HertzKeys {
  std::optional<double> stiffness, contact_time, young, poisson, at_velocity;

  template <class Archive>
  void describe_spring(Archive& a) {
    a.value("stiffness", stiffness, positive, "k_n");
    a.value("contact_time", contact_time, positive, "t_n of the reference pair, instead of a stiffness");
    a.value("young", young, positive, "Young's modulus of the material");
    a.value("poisson", poisson, Range{-1, 0.5, true, false}, "Poisson's number of the material");
  }
  template <class Archive>
  void describe_velocity(Archive& a) {
    a.value("at_velocity", at_velocity, positive, "impact velocity that t_n and e_n hold for");
    a.check(count_given(stiffness, contact_time, young) == 1, "law",
            "give one of stiffness, contact_time, and young with poisson");
    a.check(young.has_value() == poisson.has_value(), young ? "young" : "poisson",
            "a material has both young and poisson");
    a.check(at_velocity.has_value(), "at_velocity",
            "is missing: with this law t_n and e_n depend on the "
            "impact velocity. Give the fastest that is expected");
  }

  /// The spring as given; with a given contact time, that of the stiffness `k` instead.
  Hertz spring(double k, MassScaling scaling = MassScaling::none) const {
    return young ? Hertz::from_material(*young, *poisson)
                 : Hertz::from_stiffness(stiffness.value_or(k), scaling);
  }
  /// The stiffness at which t_n is the given one, if that of the stiffness `k` is t_n: t_n ∝ k_n^{-2/5} at
  /// equal restitution, with any of these dampings.
  double stiffness_for_time(double k, double t_n) const { return k * std::pow(t_n / *contact_time, 2.5); }
};

/// Alone: no damping.
struct ElasticHertzKeys : HertzKeys {
  template <class Archive>
  void describe(Archive& a) {
    describe_spring(a);
    describe_velocity(a);
  }
  Hertz make(const Reference& reference) const {
    if (!contact_time) return spring(0);
    return spring(stiffness_for_time(1, Hertz::from_stiffness(1).contact_time(*at_velocity, reference.pair)));
  }
};

/// With a damping: as given, or such that the reference pair has the asked restitution.
struct DampedHertzKeys : HertzKeys, DampingKeys {
  template <class Archive>
  void describe(Archive& a) {
    describe_spring(a);
    DampingKeys::describe(a);
    describe_rest(a);
    check(a, contact_time);
  }
  template <class Archive>
  void describe_rest(Archive& a) {
    describe_velocity(a);
    describe_scaling(a);
    a.check(!young || mass_scaling != MassScaling::both, "mass_scaling",
            "\"both\" scales a given stiffness; a material has its own");
  }

  /// `make` makes the law of a spring and γ_n.
  template <class Make>
  auto damped(const Reference& reference, const Make& make) const {
    const double v = at_velocity.value();
    const Pair pair = reference.pair;
    const auto at = [&](const auto& law) { return impact_of(law, reference.attraction, v, pair); };
    const auto with = [&](const Hertz& elastic) {
      if (!restitution) return make(elastic, *damping);
      const double guess = 0.1 * pair.m_eff / elastic.contact_time(v, pair);
      return make(elastic, damping_for([&](double g) { return at(make(elastic, g)).restitution; },
                                       *restitution, guess));
    };
    if (!contact_time) return with(spring(0, mass_scaling));
    const double trial = pair.m_eff / (std::pow(*contact_time, 2.5) * std::sqrt(v));
    return with(spring(stiffness_for_time(trial, at(with(spring(trial))).contact_time)));
  }
};

}  // namespace chute::laws
