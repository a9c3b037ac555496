#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "laws/contact_spec.hpp"

namespace chute::laws {
namespace {

/// Collects the facts about one contact.
class ContactFacts {
 public:
  ContactFacts(const ContactSpec& spec, bool si, const NamedPair& first)
      : spec_(spec),
        pair_(first.pair),
        contact_(spec.laws(first.pair)),
        impact_(spec.impact(first.pair)),
        si_(si) {
    if (const auto v = spec.at_velocity()) at_ = fmt::format(" at {:.4g} {}", *v, speed());
  }

  std::vector<Fact> take() { return std::move(list_); }

  void impact_of(const NamedPair& who) {
    const auto impact = normal_impact(contact_, spec_.at_velocity().value_or(1), who.pair);
    add("t_n" + who.suffix, impact.contact_time, si_ ? "s" : "sqrt(d/g)",
        "contact time of " + who.name + at_);
    add("e_n" + who.suffix, impact.restitution, "", "restitution of " + who.name + at_);
  }

  /// Stiffness, damping, and how the restitution depends on the velocity.
  void normal() {
    std::visit(
        [&]<class Law>(const Law& law) {
          add("k_n", law.stiffness(pair_), in(Law::stiffness_unit), "normal stiffness of that pair");
          if constexpr (requires { Law::damping_unit; })
            add("gamma_n", law.damping(pair_), in(Law::damping_unit), "normal damping of that pair");
        },
        contact_.normal);
    if (const auto v = spec_.at_velocity())
      for (const double part : {0.1, 0.01})
        add(fmt::format("e_n {:.3g}", part * *v), normal_impact(contact_, part * *v, pair_).restitution, "",
            fmt::format("restitution of that pair at {:.4g} {}", part * *v, speed()));
  }

  void time_step(double dt) {
    add("dt", dt, si_ ? "s" : "sqrt(d/g)", "time step");
    add("t_n/dt", impact_.contact_time / dt, "", "steps per contact; 50 is usual, under 20 is rough");
  }

  /// What the tangential law comes to, for that impact and that time step.
  void shear(double dt) {
    ContactLaws contact = contact_;
    know_time_step(contact, dt);
    std::visit(
        [&]<class Law>(const Law& law) {
          if constexpr (requires { law.effective_viscosity(pair_); })
            // Slip decays at γ_s (1/m_eff + R²/I for each grain): 7/2 for solid spheres
            add("gamma_s dt 7/2m", law.effective_viscosity(pair_) * 3.5 / pair_.m_eff * dt, "",
                "decay of slip in one step; keep it below 0.1");
          else if constexpr (requires { law.stiffness_at(impact_.deepest, pair_); })
            half_period(
                law.stiffness_at(impact_.deepest, pair_), requires { Law::hertz_spring; });
        },
        contact.shear);
    if (const auto* saw = std::get_if<SawTooth>(&contact_.shear))
      add("zeta_0/dt", saw->length / dt, speed(),
          "slip that crosses a tooth in one step; slips have to be much slower");
  }

  void brake_failure(double reach) {
    const double half_period = std::visit(
        [&]<class Law>(const Law& law) {
          return requires { Law::hertz_spring; }
          ? impact_.contact_time : std::numbers::pi* std::sqrt(pair_.m_eff / law.stiffness(pair_));
        },
        contact_.normal);
    add("v_bf", 2 * reach * std::cos(std::asin(0.999)) / half_period, speed(),
        "brake failure above this velocity at sin(vartheta) = 0.999 (2.16, corrected)");
  }

 private:
  const ContactSpec& spec_;
  Pair pair_;
  ContactLaws contact_;
  NormalImpact impact_;
  bool si_;
  std::string at_;
  std::vector<Fact> list_;

  std::string in(UnitName unit) const { return std::string(si_ ? unit.si : unit.reduced); }
  std::string speed() const { return si_ ? "m/s" : "sqrt(gd)"; }
  void add(std::string name, double value, std::string unit, std::string meaning) {
    list_.push_back({std::move(name), value, std::move(unit), std::move(meaning)});
  }
  /// (3.15) with m_eff and solid spheres
  void half_period(double stiffness, bool with_depth) {
    const double t_s = std::numbers::pi / std::sqrt(3.5 * stiffness / pair_.m_eff);
    add("k_s", stiffness, in(linear_stiffness_unit),
        with_depth ? "tangential stiffness at the deepest overlap of that impact"
                   : "tangential stiffness of that pair");
    add("t_s/t_n", t_s / impact_.contact_time, "", "tangential half period (3.15) over the contact time");
  }
};

}  // namespace

std::vector<Fact> impact_facts(const ContactSpec& contact, bool si, const std::vector<NamedPair>& pairs) {
  ContactFacts facts(contact, si, pairs.front());
  for (const auto& pair : pairs) facts.impact_of(pair);
  facts.normal();
  return facts.take();
}

std::vector<Fact> step_facts(const ContactSpec& contact, bool si, const NamedPair& pair, double time_step) {
  ContactFacts facts(contact, si, pair);
  facts.time_step(time_step);
  facts.shear(time_step);
  facts.brake_failure(pair.reach);
  return facts.take();
}

}  // namespace chute::laws
