#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "core/by_pair.hpp"
#include "core/kernel.hpp"
#include "core/world.hpp"
#include "engines/soft/contact_memory.hpp"
#include "engines/soft/contacts.hpp"
#include "engines/soft/integrator.hpp"
#include "engines/soft/law_table.hpp"
#include "search/neighbour_list.hpp"

namespace chute::soft {

/// How the engine goes about many grains. `sort_from` and `sort_every` are part of what makes the bytes; the
/// others only cost or save time.
struct ManyGrains {
  std::size_t sort_from = 2000;        ///< so many moving grains are kept in an order of places
  std::int64_t sort_every = 4096;      ///< steps
  std::size_t grains_per_tile = 4096;  ///< see TimeTiles
  bool tiles = true;
  /// Of contacts that remember (ContactStages::evaluate_and_apply): a third of the pairs touch, with several hundred bytes each.
  std::size_t pairs_in_piece = 2048;
};

/// What a soft-sphere run needs besides its grains.
template <int D>
struct SoftSetup : Surroundings<D> {
  laws::ContactLaws laws{};
  ByPair<laws::ContactLaws> between{};  ///< by materials; empty: `laws` for all
  std::vector<std::optional<LawTable>>
      wall_laws{};  ///< of the walls that have their own; if `between` is not empty, of all
  Scheme scheme = Scheme::gear5;
  ContactEnds ends = ContactEnds::sampled;
  double time_step = 0;
  typename search::NeighbourList<D>::Skins skins{};
  double deepest_overlap = 0.25;  ///< of the smallest radius; beyond it the run has left physics
  double contact_time = 0;        ///< t_n of a usual impact: what impacts call rolling (core/impact.hpp)
  search::Method search = search::Method::cells;
  Isa isa = best_isa();
  int threads = 1;  ///< results do not depend on it
  ManyGrains many{};
};

/// What an overlap that is too deep comes from: a contact that a step passes over is not one that is too soft.
template <int D>
std::string why_so_deep(const SoftSetup<D>& setup);

/// How far apart surfaces can be and still have a force in a step with weighted ends of contacts: the way of half a step of those
/// whose impacts overlap by a twentieth of the smallest radius. 0 with other ends.
template <int D>
double reach_of_ends(const SoftSetup<D>& setup, double smallest_radius);

/// The laws between grains, and those of walls that have their own, which know how long a step is, and how far `apart` they are
/// asked for forces too. Empty: as between grains.
template <int D>
LawTable laws_of_grains(const SoftSetup<D>& setup, double apart = 0);
template <int D>
std::vector<std::optional<LawTable>> laws_of_walls(const SoftSetup<D>& setup, double apart = 0);

/// How slips follow from velocities in the setup's scheme.
inline SlipRule slip_rule(Scheme scheme) {
  return scheme == Scheme::gear5 ? SlipRule::trapezoid : SlipRule::midpoint;
}

/// What is wrong with contact c, if it is deeper than the setup allows: `other()` names whom the grain touches. Contacts of
/// grains with these radii; others than grains are walls.
template <int D, class Name>
std::optional<std::string> too_deep(const SoftSetup<D>& setup, const Array& radius,
                                    const Contacts<D>& contacts, std::size_t c, const Name& other) {
  const auto i = static_cast<std::size_t>(contacts.i[c]), j = static_cast<std::size_t>(contacts.j[c]);
  const double smaller = j >= radius.size() ? radius[i] : std::min(radius[i], radius[j]);
  const double depth = contacts.overlap[c] / smaller;
  if (!(depth > setup.deepest_overlap)) return {};
  return fmt::format("it overlaps {} by {:.3g} of the smaller radius (limit {}): {}",
                     j >= radius.size() ? "a wall" : "grain " + std::to_string(other(j)), depth,
                     setup.deepest_overlap, why_so_deep(setup));
}

/// The skins that make steps cheapest for grains of about the given diameter; results do not depend on them.
template <int D>
typename search::NeighbourList<D>::Skins usual_skins(double diameter) {
  return {0.04 * diameter, 0.3 * diameter};
}

}  // namespace chute::soft
