#pragma once
#include "engines/hard/hard_contact.hpp"
#include "engines/kind/method.hpp"

namespace chute::hard {

/// Gives `setup` the contact that the keys of a method of hard grains (WaltonKeys, and a restitution that may depend on the
/// velocity) come to, and where contacts depend on who meets that of each two materials.
template <class Setup, class Method>
void set_contacts(Setup& setup, const Method& method, const engines::Setting& setting) {
  const auto contact = [&](double e_n, const laws::Walton& tangential) {
    HardContact made{laws::ConstantRestitution{e_n}, tangential};
    if (method.restitution_velocity)
      made.restitution =
          laws::PowerLawRestitution{1 - e_n, *method.restitution_velocity, method.restitution_exponent};
    return made;
  };
  setup.contact = contact(method.e_n(setting), method.walton(setting));
  if (setting.by_pair())
    setup.between = setting.for_pairs(setup.contact, [&](const engines::MeetingMaterials& two) {
      return contact(method.e_n(setting, two), method.walton(setting, two));
    });
}

}  // namespace chute::hard
