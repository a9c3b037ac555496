#pragma once
#include <optional>

#include "common/toml_reader.hpp"
#include "scene/contact_spec.hpp"

namespace chute::scene {

/// Keys of [contact], [contact.normal] and [contact.tangential].
void describe(TomlReader& a, ContactSpec& contact);
void describe(TomlWriter& a, ContactSpec& contact);

/// The impact velocity that contact times and restitutions are stated for; none where they do not depend on
/// it.
std::optional<double> at_velocity(const ContactSpec& contact);

/// A head-on impact of the pair at that velocity, or at 1.
laws::NormalImpact reference_impact(const ContactSpec& contact, laws::Pair pair);

/// Refuses over-damped contacts: they never end, so they have no contact time and no restitution.
void check_contact_time(const ContactSpec& contact, laws::Pair pair, const TomlReader& reader);

}  // namespace chute::scene
