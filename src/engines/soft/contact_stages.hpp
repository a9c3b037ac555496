#pragma once
#include <cstdint>
#include <limits>
#include <span>

#include "core/domain.hpp"
#include "core/grains.hpp"
#include "core/kernel.hpp"
#include "engines/soft/contact_memory.hpp"
#include "engines/soft/contacts.hpp"
#include "engines/soft/law_table.hpp"
#include "search/neighbour_list.hpp"

namespace chute::soft {

template <class Choice, int T>
struct RememberingShearKernel;

/// The stages that turn places and velocities into forces, each a vectorised loop over arrays:
/// find touching → geometry → memory → normal → shear → apply. A law is known inside its own stage only, so
/// the compiled loops add up over the laws instead of multiplying. Where no law has a memory, that stage does
/// nothing.
template <int D>
class ContactStages {
 public:
  /// Which of the pairs touch, before their grains are named; kept, so that a step allocates nothing.
  struct Touching {
    std::vector<std::int32_t> pair;
    void reserve(std::size_t pairs) {
      if (pair.size() < pairs) pair.resize(pairs);
    }
  };

  ContactStages(const Domain<D>& domain, const LawTable& laws, Isa isa = best_isa(),
                SlipRule rule = SlipRule::trapezoid);

  /// Fills `contacts` from the pairs that may touch, shared out among a team. Allocates only when the list
  /// has become longer than ever before. `duration` is the time since the previous call; with 0 nothing
  /// happens to what the contacts remember, but for limits that depend on the present normal force.
  void evaluate(const search::Candidates<D>& candidates, const Grains<D>& grains, Contacts<D>& contacts,
                double duration = 0, Team& team = Team::alone());

  /// The same by one thread and in pieces of so many pairs, each of which is applied (see below) before the next one takes its place in
  /// `piece`: what contacts come to stays in a core's own cache, but is gone in the end, but for `deep`. For laws with a memory.
  void evaluate_and_apply(const search::Candidates<D>& candidates, const Grains<D>& grains,
                          std::size_t pairs_in_piece, Contacts<D>& piece, double duration,
                          GrainSums<D>& sums);
  /// Which contacts there are and their geometry; no forces, and nothing happens to what they remember.
  void locate(const search::Candidates<D>& candidates, const Grains<D>& grains, Contacts<D>& contacts);

  /// The same for some ranges of the pairs, in ascending order, by one thread. Only for laws without a
  /// memory.
  void evaluate(const search::Candidates<D>& candidates, std::span<const Part> pairs, const Grains<D>& grains,
                Contacts<D>& contacts, Touching& touching);

  /// The same for contacts whose geometry is there already, as that of contacts with walls is (WallContacts), and of which
  /// each knows its law where there are several.
  void evaluate_found(const Grains<D>& grains, Contacts<D>& contacts, double duration);
  /// Adds what they do to the first grain of each.
  void apply_first(const Contacts<D>& contacts, const Grains<D>& grains, double duration,
                   GrainSums<D>& sums) const;

  /// Adds what the contacts do to each grain, in their order, over `duration`.
  void apply(const Contacts<D>& contacts, const Grains<D>& grains, double duration, GrainSums<D>& sums,
             Team& team) const;
  /// The same apart: forces and torques on the moving grains only, of all contacts;
  void apply_forces(const Contacts<D>& contacts, const Grains<D>& grains, GrainSums<D>& sums) const;
  /// and the losses of those contacts that begin with a grain in `range`.
  void apply_losses(const Contacts<D>& contacts, Part range, double duration, GrainSums<D>& sums) const;

  /// From now on evaluations tell whether any overlap is deeper than this (Contacts::deep).
  void watch_for(double deepest) { deepest_ = deepest; }

  /// Energy stored in the contacts, in both directions.
  double elastic_energy(const Contacts<D>& contacts) const;

  /// Pairs with a smaller gap than this count as touching (EndWeights).
  double apart() const { return laws_.ends().apart(); }
  bool several_laws() const { return laws_.several(); }
  const ContactMemory<D>& memory() const { return memory_; }
  ContactMemory<D>& memory() { return memory_; }
  double deepest() const { return deepest_; }

 private:
  Domain<D> domain_;
  LawTable laws_;
  Isa isa_;
  ContactMemory<D> memory_;
  bool needs_radius_;
  double deepest_ = std::numeric_limits<double>::infinity();
  Touching touching_;
  std::vector<std::size_t> found_;  // by each of the team

  std::size_t find(const search::Candidates<D>& candidates, const Grains<D>& grains, Part range,
                   std::int32_t* pair) const;
  std::size_t find_in(const search::Candidates<D>& candidates, const Grains<D>& grains, Part range,
                      std::int64_t* hit, std::int32_t* pair) const;
  void name(const search::PairList& pairs, const std::int32_t* touching, Part which, const Grains<D>& grains,
            Contacts<D>& contacts) const;
  void name_grains(const search::PairList& pairs, Part range, const Grains<D>& grains, Contacts<D>& contacts,
                   const Team& team) const;
  void geometry(const Grains<D>& grains, Part range, Contacts<D>& contacts) const;
  void normal_forces(Part range, Contacts<D>& contacts, double duration);
  void shear_forces(Part range, Contacts<D>& contacts, double duration);
  void remembered_forces(const Grains<D>& grains, Part range, Contacts<D>& contacts, double duration);
  template <class Choice>
  RememberingShearKernel<Choice, turns<D>> remembering(const Choice& choice, Part range,
                                                       Contacts<D>& contacts, double duration);
};

}  // namespace chute::soft
