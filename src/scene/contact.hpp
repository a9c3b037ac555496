#pragma once
#include "common/toml_reader.hpp"
#include "scene/scene.hpp"

namespace chute::scene {

/// Keys of [contact.normal] and [contact.tangential]. A new law gets its word and its keys here.
void describe(TomlReader& a, ContactSpec& contact);
void describe(TomlWriter& a, ContactSpec& contact);

/// Is the spring Hertz's, k_n ξ^{3/2}, and not linear?
bool has_hertz_spring(const NormalSpec& normal);

/// The impact velocity that contact times and restitutions are stated for. 1 where they do not depend on it.
double impact_velocity(const ContactSpec& contact);

/// Refuses over-damped contacts: they never end, so they have no contact time and no restitution. And runs of more
/// steps than can be counted.
void check_contact_time(const Scene& scene, const TomlReader& reader);

}  // namespace chute::scene
