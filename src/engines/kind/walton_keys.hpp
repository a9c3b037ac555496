#pragma once
#include "engines/kind/method.hpp"
#include "laws/walton.hpp"

namespace chute::engines {

/// Walton's collision with what [engine] says of it, and else what [contact] comes to for the reference pair. For
/// methods of hard grains.
struct WaltonKeys {
  std::optional<double> restitution, friction;
  double tangential_restitution = 0;  ///< β
  std::optional<double> steps_per_contact, time_step;

  template <class Archive>
  void describe_walton(Archive& a) {
    a.value("restitution", restitution, unit_interval, "e_n; default that of [contact]");
    a.value("friction", friction, non_negative, "μ; default that of [contact]");
    a.value("tangential_restitution", tangential_restitution, between(-1, 1), "β of collisions that stick");
  }
  /// How finely a run can be stopped; the motion does not depend on it.
  template <class Archive>
  void describe_tick(Archive& a) {
    a.value("steps_per_contact", steps_per_contact, at_least(5),
            "instants to stop at in t_n of [contact] (50)");
    a.value("time_step", time_step, positive, "time between instants to stop at, instead");
    a.check(!time_step || !steps_per_contact, "time_step", "give either time_step or steps_per_contact");
    // What only soft grains use is understood: a scene changes its method with one key.
    a.ignored("integrator");
    a.ignored("deepest_overlap");
  }
  double tick(const Setting& s) const {
    constexpr double usual_steps = 50;
    if (time_step) return *time_step;
    const double t_n = s.contact.impact(s.reference()).contact_time;
    return step_dividing(s.between_outputs, t_n / steps_per_contact.value_or(usual_steps));
  }
  double e_n(const Setting& s) const {
    return restitution.value_or(s.contact.impact(s.reference()).restitution);
  }
  laws::Walton walton(const Setting& s) const {
    auto shear = s.contact.laws(s.reference()).shear;
    const double* mu = laws::friction(shear);
    return {friction.value_or(mu ? *mu : 0), tangential_restitution};
  }
  std::vector<Fact> walton_facts(const Setting& s) const {
    const auto tangential = walton(s);
    return {{"e_n", e_n(s), "", "restitution of every collision"},
            {"mu", tangential.friction, "", "friction of collisions that slide"},
            {"beta", tangential.beta, "", "tangential restitution of collisions that stick"},
            {"tick", tick(s), s.in("s", "sqrt(d/g)"), "time between instants that a run can stop at"}};
  }
};

}  // namespace chute::engines
