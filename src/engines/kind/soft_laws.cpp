#include "engines/kind/soft_laws.hpp"

#include <fmt/format.h>

#include <limits>

namespace chute::engines {
namespace {

laws::ContactLaws with_own(laws::ContactSpec contact, laws::Pair reference, const WallSurface& own,
                           laws::KeepLaw keep) {
  if (own.restitution) laws::set_restitution(contact.normal, *own.restitution);
  auto laws = keep == laws::KeepLaw::yes ? contact.laws_of_pair(reference) : contact.laws(reference);
  if (own.friction)
    if (double* mu = laws::friction(laws.shear)) *mu = *own.friction;
  return laws;
}

}  // namespace

ByPair<laws::ContactLaws> laws_between(const Setting& setting) {
  if (!setting.by_pair()) return {};
  return setting.for_pairs(
      setting.contact.laws_of_pair(setting.reference()),
      [](const MeetingMaterials& two) { return two.contact.laws_of_pair(two.reference); });
}

std::vector<laws::ContactLaws> laws_of_wall(const Setting& setting, const WallSurface& own) {
  if (!setting.by_pair()) return {with_own(setting.contact, setting.reference(), own, laws::KeepLaw::no)};
  std::vector<laws::ContactLaws> by_grain(setting.materials.size(),
                                          setting.contact.laws_of_pair(setting.reference()));
  for (const auto& two : setting.meetings())
    for (const auto& [wall, grain] : {std::pair(two.a, two.b), std::pair(two.b, two.a)})
      if (wall == own.material)
        by_grain[static_cast<std::size_t>(grain)] =
            with_own(two.contact, two.reference, own, laws::KeepLaw::yes);
  return by_grain;
}

std::optional<Refusal> refusal_of_own_laws(const Setting& setting) {
  const auto shear_of_all = [&] {
    return setting.by_pair() ? setting.contact.laws_of_pair(setting.reference()).shear
                             : setting.contact.laws(setting.reference()).shear;
  };
  // `own` may be a wall's or two materials'.
  const auto misfit = [&](const std::string& whose, const auto& own) -> std::optional<Refusal> {
    auto shear = shear_of_all();
    auto normal = setting.contact.normal;
    if (own.friction && !laws::friction(shear))
      return Refusal{whose + ".friction", "the law of [contact.tangential] has no friction"};
    if (own.restitution && *own.restitution == 0)
      return Refusal{whose + ".restitution", "0 is not allowed for soft grains, must be > 0"};
    if (own.restitution && !laws::set_restitution(normal, *own.restitution))
      return Refusal{whose + ".restitution", "the law of [contact.normal] takes no restitution"};
    return {};
  };
  for (std::size_t w = 0; w < setting.wall_surfaces.size(); ++w)
    if (auto wrong = misfit(fmt::format("wall[{}]", w), setting.wall_surfaces[w])) return wrong;
  for (std::size_t k = 0; k < setting.contact.between.size(); ++k) {
    const auto whose = fmt::format("contact.between[{}]", k);
    if (auto wrong = misfit(whose, setting.contact.between[k])) return wrong;
    auto contact = setting.contact;
    if (const auto wrong = laws::put_in(contact, setting.contact.between[k]))
      return Refusal{whose + "." + wrong->key, wrong->message};
  }
  return {};
}

Shortest shortest_contact(const Setting& s) {
  Shortest least{s.contact.impact(s.reference(), s.shortest().pair).contact_time, s.shortest().name};
  if (!s.by_pair()) return least;
  least.contact_time = std::numeric_limits<double>::infinity();
  for (const auto& two : s.meetings()) {
    const double t_n = two.contact.impact(two.reference, two.stiffest).contact_time;
    if (t_n < least.contact_time) least = {t_n, "the smallest grains of " + two.name};
  }
  return least;
}

std::vector<Fact> facts_of_pairs(const Setting& s) {
  std::vector<Fact> list;
  if (!s.by_pair()) return list;
  for (const auto& two : s.meetings()) {
    const double v = two.contact.at_velocity().value_or(1);
    auto laws = two.contact.laws_of_pair(two.reference);
    const auto impact = laws::normal_impact(laws, v, two.mean);
    list.push_back(
        {"t_n " + two.name, impact.contact_time, s.in("s", "sqrt(d/g)"), "contact time of mean grains"});
    list.push_back({"e_n " + two.name, impact.restitution, "", "restitution of mean grains"});
    if (const double* mu = laws::friction(laws.shear))
      list.push_back({"mu " + two.name, *mu, "", "friction"});
  }
  return list;
}

}  // namespace chute::engines
