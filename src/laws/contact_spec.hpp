#pragma once
#include <optional>
#include <vector>

#include "common/keys.hpp"
#include "core/fact.hpp"
#include "laws/contact_between.hpp"
#include "laws/list.hpp"

namespace chute::laws {

/// [contact]: which keys a law takes, and what they mean, stands in the law's own header.
struct ContactSpec {
  bool attraction = true;                       ///< false: the normal force is clipped at 0
  NormalKeys normal;                            ///< [contact.normal]
  ShearKeys tangential = RegularisedCoulomb{};  ///< [contact.tangential]
  std::vector<ContactBetween> between{};  ///< [[contact.between]]: what is not the same for all materials

  /// The laws; `reference` is the pair that contact times and velocity-dependent restitutions are given for.
  ContactLaws laws(Pair reference) const { return make_contact(normal, tangential, {reference, attraction}); }
  /// The same of one of several pairs of materials: their laws are of the same types, even where μ = 0.
  ContactLaws laws_of_pair(Pair reference) const {
    return make_contact(normal, tangential, {reference, attraction}, KeepLaw::yes);
  }
  /// The impact velocity that contact times and restitutions are stated for; none where they do not depend on it.
  std::optional<double> at_velocity() const;
  /// A head-on impact of the pair, whose laws are made for `reference`, at that velocity, or at 1.
  NormalImpact impact(Pair reference, Pair pair) const;
  NormalImpact impact(Pair pair) const { return impact(pair, pair); }
};

/// Keys of [contact], [contact.normal] and [contact.tangential].
void describe(TomlReader& a, ContactSpec& contact);
void describe(TomlWriter& a, ContactSpec& contact);
void describe(KeyLister& a, ContactSpec& contact);

/// The keys of one law.
struct LawKeys {
  std::string table, name;  ///< contact.normal or contact.tangential; the law's word
  std::vector<KeyText> keys;
};
std::vector<LawKeys> all_law_keys();

/// Refuses over-damped contacts: they never end, so they have no contact time and no restitution.
void check_contact_time(const ContactSpec& contact, Pair pair, const TomlReader& reader);

/// A pair of grains whose impacts are of interest.
struct NamedPair {
  std::string suffix;  ///< of the facts' names: "", " bed"
  std::string name;    ///< "two mean grains"
  Pair pair;
  double reach;  ///< R_i + R_j
};

/// What the laws of a scene come to for the first of some pairs: t_n, k_n, γ_n, e_n at several speeds where it depends
/// on them; and t_n and e_n of the other pairs. `si`: units' names.
std::vector<Fact> impact_facts(const ContactSpec& contact, bool si, const std::vector<NamedPair>& pairs);
/// What the tangential law comes to at a time step, k_s, t_s/t_n; and the brake-failure velocity.
std::vector<Fact> step_facts(const ContactSpec& contact, bool si, const NamedPair& pair, double time_step);

}  // namespace chute::laws
