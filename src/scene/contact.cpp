#include "scene/contact.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace chute::scene {
namespace {

using namespace std::string_view_literals;
constexpr std::array normal_words{"spring-dashpot"sv, "hertz"sv, "hertz-linear-damping"sv,
                                  "hertz-kuwabara-kono"sv, "walton-braun"sv};
constexpr std::array shear_words{
    "coulomb-viscous"sv, "frictionless"sv,         "coulomb"sv,  "viscous"sv, "cundall-strack"sv,
    "mindlin"sv,         "walton-braun-mindlin"sv, "saw-tooth"sv};
constexpr std::array scaling_words{"none"sv, "damping"sv, "both"sv};
constexpr Range restitution_range{0, 1, true, false};

using Law = NormalSpec::Law;

bool is_damped(const NormalSpec& n) { return n.law != Law::hertz && n.law != Law::walton_braun; }
/// Do contact time and restitution depend on the impact velocity?
bool depends_on_velocity(const NormalSpec& n) { return has_hertz_spring(n) || n.hardening.has_value(); }

int given(const std::optional<double>& a, const std::optional<double>& b,
          const std::optional<double>& c = {}) {
  return a.has_value() + b.has_value() + c.has_value();
}

}  // namespace

// Outside the unnamed namespace: the archives find these by the type that they describe.

template <class Archive>
static void describe(Archive& a, NormalSpec& n) {
  a.choice("law", n.law, normal_words);
  a.value("stiffness", n.stiffness, positive);
  if (n.law != Law::walton_braun) a.value("contact_time", n.contact_time, positive);
  if (has_hertz_spring(n)) {
    a.value("young", n.young, positive);
    a.value("poisson", n.poisson, Range{-1, 0.5, true, false});
  }
  if (n.law != Law::hertz) a.value("restitution", n.restitution, restitution_range);
  if (is_damped(n)) a.value("damping", n.damping, non_negative);
  if (n.law == Law::hertz_kuwabara_kono) a.value("relaxation", n.relaxation, non_negative);
  if (n.law == Law::walton_braun) {
    a.value("unloading_stiffness", n.unloading_stiffness, positive);
    a.value("hardening", n.hardening, non_negative);
  }
  if (depends_on_velocity(n)) a.value("at_velocity", n.at_velocity, positive);
  if (n.damping) a.choice("mass_scaling", n.mass_scaling, scaling_words);

  if constexpr (Archive::reading) {
    if (n.law == Law::walton_braun) {
      a.check(n.stiffness.has_value(), "stiffness", "is missing: k_1 of the loading");
      a.check(given(n.restitution, n.unloading_stiffness, n.hardening) == 1, "law",
              "give one of restitution, unloading_stiffness and hardening");
      a.check(!n.unloading_stiffness || *n.unloading_stiffness >= *n.stiffness, "unloading_stiffness",
              "must not be less than the stiffness of the loading");
    } else {
      a.check(given(n.stiffness, n.contact_time, n.young) == 1, "law",
              has_hertz_spring(n) ? "give one of stiffness, contact_time, and young with poisson"
                                  : "give either stiffness or contact_time");
      a.check(n.young.has_value() == n.poisson.has_value(), n.young ? "young" : "poisson",
              "a material has both young and poisson");
    }
    if (is_damped(n))
      a.check(given(n.restitution, n.damping, n.relaxation) == 1, n.damping ? "damping" : "restitution",
              n.law == Law::hertz_kuwabara_kono ? "give one of restitution, damping and relaxation"
                                                : "give either restitution or damping");
    a.check(!n.contact_time || n.law == Law::hertz || n.restitution, "contact_time",
            "goes with restitution; with damping give the stiffness");
    a.check(!n.young || n.mass_scaling != laws::MassScaling::both, "mass_scaling",
            "\"both\" scales a given stiffness; a material has its own");
    a.check(!depends_on_velocity(n) || n.at_velocity, "at_velocity",
            "is missing: with this law t_n and e_n depend on the impact velocity. Give the fastest that is "
            "expected");
  }
}

template <class Archive>
static void describe(Archive& a, ShearSpec& shear) {
  using Shear = ShearSpec::Law;
  a.choice("law", shear.law, shear_words);
  if (shear.law == Shear::frictionless) return;
  if (shear.law == Shear::coulomb_viscous || shear.law == Shear::viscous)
    a.required("viscosity", shear.viscosity, non_negative);
  if (shear.law != Shear::viscous) a.required("friction", shear.friction, non_negative);
  if (shear.law == Shear::coulomb_viscous || shear.law == Shear::viscous)
    a.choice("mass_scaling", shear.mass_scaling, scaling_words);
  if (shear.law == Shear::saw_tooth) a.required("tooth", shear.tooth, positive);
  if (shear.law == Shear::cundall_strack || shear.law == Shear::mindlin ||
      shear.law == Shear::walton_braun_mindlin) {
    a.value("stiffness", shear.stiffness, positive);
    a.value("stiffness_ratio", shear.stiffness_ratio, positive);
    if (shear.law != Shear::walton_braun_mindlin) a.value("cap", shear.cap);
    if constexpr (Archive::reading)
      a.check(given(shear.stiffness, shear.stiffness_ratio) == 1,
              shear.stiffness ? "stiffness_ratio" : "stiffness",
              "give either stiffness, k_s, or stiffness_ratio, k_s/k_n");
  }
}

template <class Archive>
static void describe_contact(Archive& a, ContactSpec& contact) {
  a.value("attraction", contact.attraction);
  a.required_section("normal", contact.normal);
  a.required_section("tangential", contact.tangential);
  if constexpr (Archive::reading) {
    const bool mindlin = contact.tangential.law == ShearSpec::Law::mindlin;
    a.check(!contact.tangential.stiffness_ratio || mindlin == has_hertz_spring(contact.normal), "tangential",
            mindlin
                ? "k_s/k_n of \"mindlin\" is a number with Hertz's spring only; give its stiffness (N m^-3/2)"
                : "k_s/k_n is a number with a linear normal spring only; give the stiffness (N/m)");
  }
}

void describe(TomlReader& a, ContactSpec& contact) { describe_contact(a, contact); }
void describe(TomlWriter& a, ContactSpec& contact) { describe_contact(a, contact); }

void check_contact_time(const Scene& scene, const TomlReader& reader) {
  const auto pair = scene.reference_pair();
  const auto impact = laws::normal_impact(scene.contact.laws(pair), impact_velocity(scene.contact), pair);
  if (!(impact.restitution > 0 && std::isfinite(impact.contact_time)))
    reader.fail("contact", depends_on_velocity(scene.contact.normal)
                               ? "the damping is too strong: grains that meet at_velocity would never part"
                               : "the damping is over-critical: grains would stick together and never part");
  // 2^53 is where times of steps would no longer be told apart; no machine gets there.
  constexpr double most = 1e15;
  const double step = scene.engine.time_step.value_or(impact.contact_time / scene.engine.steps_per_contact);
  if (scene.duration / step > most)
    reader.fail("run.duration",
                fmt::format("{:.6g} takes {:.2g} steps of {:.3g}, more than {:.0e} that can be counted",
                            scene.duration, scene.duration / step, step, most));
}

bool has_hertz_spring(const NormalSpec& n) {
  return n.law != Law::spring_dashpot && n.law != Law::walton_braun;
}

double impact_velocity(const ContactSpec& contact) { return contact.normal.at_velocity.value_or(1); }

}  // namespace chute::scene
