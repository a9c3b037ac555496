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
  /// The same where two materials meet. What is their own comes before what [engine] says.
  double e_n(const Setting& s, const MeetingMaterials& meeting) const {
    if (!meeting.own) return e_n(s);
    if (meeting.own->restitution) return *meeting.own->restitution;
    const double own = meeting.contact.impact(meeting.reference).restitution;
    return own == s.contact.impact(meeting.reference).restitution ? e_n(s) : own;
  }
  laws::Walton walton(const Setting& s, const MeetingMaterials& meeting) const {
    laws::Walton all = walton(s);
    if (!meeting.own) return all;
    const auto& own = *meeting.own;
    if (own.tangential && own.tangential->values.contains("friction"))
      all.friction = own.tangential->values.at("friction");
    return {own.friction.value_or(all.friction), own.tangential_restitution.value_or(all.beta)};
  }
  /// Do two materials have a friction of their own?
  static bool own_friction(const MeetingMaterials& meeting) {
    return meeting.own && (meeting.own->friction ||
                           (meeting.own->tangential && meeting.own->tangential->values.contains("friction")));
  }
  /// What collisions of each two materials come to, where they are not all the same.
  std::vector<Fact> pair_facts(const Setting& s) const {
    std::vector<Fact> list;
    if (!s.by_pair()) return list;
    for (const auto& meeting : s.meetings()) {
      const auto tangential = walton(s, meeting);
      list.push_back({"e_n " + meeting.name, e_n(s, meeting), "", "restitution"});
      list.push_back({"mu " + meeting.name, tangential.friction, "", "friction"});
      list.push_back({"beta " + meeting.name, tangential.beta, "", "tangential restitution"});
    }
    return list;
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
