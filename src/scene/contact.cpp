#include "scene/contact.hpp"

#include <array>
#include <cmath>

namespace chute::scene {
namespace {

using namespace std::string_view_literals;
constexpr std::array normal_words{"spring-dashpot"sv};
constexpr std::array shear_words{"coulomb-viscous"sv, "frictionless"sv};
constexpr std::array scaling_words{"none"sv, "damping"sv, "both"sv};

}  // namespace

// Outside the unnamed namespace: the archives find these by the type that they describe.

template <class Archive>
static void describe(Archive& a, NormalSpec& normal) {
  a.choice("law", normal.law, normal_words);
  a.required("stiffness", normal.stiffness, positive);
  a.value("restitution", normal.restitution, Range{0, 1, true, false});
  a.value("damping", normal.damping, non_negative);
  if constexpr (Archive::reading)
    a.check(normal.restitution.has_value() != normal.damping.has_value(),
            normal.damping ? "damping" : "restitution", "give either restitution or damping");
  if (normal.damping) a.choice("mass_scaling", normal.mass_scaling, scaling_words);
}

template <class Archive>
static void describe(Archive& a, ShearSpec& shear) {
  a.choice("law", shear.law, shear_words);
  if (shear.law == ShearSpec::Law::frictionless) return;
  a.required("viscosity", shear.viscosity, non_negative);
  a.required("friction", shear.friction, non_negative);
  a.choice("mass_scaling", shear.mass_scaling, scaling_words);
}

template <class Archive>
static void describe_contact(Archive& a, ContactSpec& contact) {
  a.required_section("normal", contact.normal);
  a.required_section("tangential", contact.tangential);
}

void describe(TomlReader& a, ContactSpec& contact) { describe_contact(a, contact); }
void describe(TomlWriter& a, ContactSpec& contact) { describe_contact(a, contact); }

laws::Contact ContactSpec::laws() const {
  laws::Contact made;
  made.normal = normal.restitution
                    ? laws::SpringDashpot::from_restitution(normal.stiffness, *normal.restitution)
                    : laws::SpringDashpot::from_damping(normal.stiffness, *normal.damping, normal.mass_scaling);
  if (tangential.law == ShearSpec::Law::coulomb_viscous && tangential.friction > 0)
    made.shear = laws::RegularisedCoulomb{tangential.viscosity, tangential.friction, tangential.mass_scaling};
  return made;
}

void check_contact_time(const Scene& scene, const TomlReader& reader) {
  const auto law = std::get<laws::SpringDashpot>(scene.contact.laws().normal);
  if (std::isfinite(law.contact_time(scene.reference_mass()))) return;
  reader.fail("contact", "the damping is over-critical: grains would stick together and never part");
}

}  // namespace chute::scene
