#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/by_pair.hpp"
#include "core/fact.hpp"
#include "core/wall.hpp"
#include "engines/kind/method.hpp"
#include "laws/list.hpp"

/// The laws of soft grains of several materials, for the methods that act by [contact]: `soft` and `lammps`.
namespace chute::engines {

/// The laws of all materials that can meet; empty where all contacts have the same.
ByPair<laws::ContactLaws> laws_between(const Setting& setting);

/// The laws of contacts with a wall, with its own friction and restitution: by the material of the grain where contacts depend on
/// who meets, else one. A restitution is that of the reference pair where it depends on the pair.
std::vector<laws::ContactLaws> laws_of_wall(const Setting& setting, const WallSurface& own);

/// What of walls' and materials' own the laws of the scene cannot have.
std::optional<Refusal> refusal_of_own_laws(const Setting& setting);

/// The contact that is over first, and how long it takes: that of the smallest grains, and where contacts depend on who meets the
/// shortest of all pairs.
struct Shortest {
  double contact_time;
  std::string who;
};
Shortest shortest_contact(const Setting& setting);

/// What each two materials come to, where contacts are not all the same.
std::vector<Fact> facts_of_pairs(const Setting& setting);

}  // namespace chute::engines
