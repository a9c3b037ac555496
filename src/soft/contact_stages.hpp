#pragma once
#include <cstdint>

#include "core/domain.hpp"
#include "core/grains.hpp"
#include "core/kernel.hpp"
#include "laws/list.hpp"
#include "search/pairs.hpp"
#include "soft/contact_memory.hpp"
#include "soft/contacts.hpp"

namespace chute::soft {

/// The stages that turn places and velocities into forces, each a vectorised loop over arrays:
/// find_touching → geometry → memory → normal → shear → apply. Each is split among a team by ranges of pairs,
/// contacts or grains. A law is known inside its own stage only, so the compiled loops add up over the laws
/// instead of multiplying. Where no law has a memory, that stage does nothing.
template <int D>
class ContactStages {
 public:
  ContactStages(const Domain<D>& domain, const laws::Contact& laws, Isa isa = best_isa(),
                SlipRule rule = SlipRule::trapezoid);

  /// Fills `contacts` from the pairs that may touch. Allocates only when the list has become longer than ever
  /// before. `duration` is the time since the previous call; with 0 nothing happens to what the contacts
  /// remember, but for limits that depend on the present normal force.
  void evaluate(const search::PairList& pairs, const Grains<D>& grains, Contacts<D>& contacts,
                double duration = 0, Team& team = Team::alone());

  /// Sums the forces and torques of the contacts, in their order, on each grain.
  void apply(const Contacts<D>& contacts, const Grains<D>& grains, std::array<Array, D>& force,
             std::array<Array, turns<D>>& torque, Team& team) const;

  /// Energy stored in the contacts, in both directions.
  double elastic_energy(const Contacts<D>& contacts) const;

  const ContactMemory<D>& memory() const { return memory_; }
  ContactMemory<D>& memory() { return memory_; }

 private:
  Domain<D> domain_;
  laws::Contact laws_;
  Isa isa_;
  ContactMemory<D> memory_;
  bool needs_radius_;
  std::vector<std::int64_t>
      hit_;  // 1 where a pair touches; as wide as a double, to stay in the same vector lanes
  std::vector<std::int32_t> touching_;

  std::vector<std::size_t> found_;  // by each of the team

  void find_touching(const search::PairList& pairs, const Grains<D>& grains, Contacts<D>& contacts,
                     Team& team);
  void name_grains(const search::PairList& pairs, Part range, Contacts<D>& contacts, const Team& team) const;
  void geometry(const Grains<D>& grains, Part range, Contacts<D>& contacts) const;
  void normal_forces(Part range, Contacts<D>& contacts, double duration);
  void shear_forces(Part range, Contacts<D>& contacts, double duration);
  void apply_to(Part own, const Contacts<D>& contacts, const Grains<D>& grains, std::array<Array, D>& force,
                std::array<Array, turns<D>>& torque) const;
};

}  // namespace chute::soft
