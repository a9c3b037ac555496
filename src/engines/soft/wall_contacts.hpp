#pragma once
#include <optional>
#include <vector>

#include "core/world.hpp"
#include "engines/soft/contact_stages.hpp"

namespace chute::soft {

/// Contacts of grains with walls: how they touch, with frame, overlap and relative motion as between two grains (2.3),
/// (2.4), (2.6), (2.7), the partner being infinitely heavy; what the laws make of it; and the work of walls that move. A
/// contact's j is the number of grains plus that of the wall.
///
/// Walls with friction or restitution or a material of their own have laws of their own, which may depend on the material of the
/// grain, and so a list of contacts each; all others share the first. In each list contacts are ordered by (i, j).
template <int D>
class WallContacts {
 public:
  /// What is behind the choice of laws.
  struct Kernels {
    Isa isa;
    SlipRule rule;
  };
  /// `own` has the laws of each wall that has its own.
  WallContacts(const Surroundings<D>& around, const LawTable& laws,
               const std::vector<std::optional<LawTable>>& own, Kernels kernels);

  bool any() const { return !walls_.empty(); }

  /// Finds all contacts at `time`, and adds what they do over `duration`. `deepest` is the overlap to tell of.
  void evaluate(const Grains<D>& grains, double time, double duration, double deepest, GrainSums<D>& sums);

  /// Of the latest evaluation: is an overlap deeper?
  bool deep() const;
  /// Work that moving walls did on the grains in it.
  double work() const { return work_; }
  /// What contacts that ended in it still have to account for (ContactMemory).
  double released() const;
  double elastic_energy() const;
  std::size_t count() const;

  /// How a wall is touched from a place, and the velocity of its surface there.
  struct Touch {
    Nearest<D> nearest;
    Vec<D> velocity;
  };
  Touch touch(std::size_t wall, const Vec<D>& place, double time) const;

  /// visit(contacts) for each list.
  template <class Visit>
  void for_lists(const Visit& visit) const {
    for (const auto& group : groups_) visit(group.contacts);
  }
  /// What the contacts remember, for checkpoints.
  std::vector<ContactMemory<D>> memories() const;
  void remember(const std::vector<ContactMemory<D>>& memories);
  /// As ContactMemory.
  void reorder(std::span<const std::int32_t> place) {
    for (auto& group : groups_) group.stages.memory().reorder(place);
  }
  void renumber(std::span<const std::int32_t> place, std::int32_t shift) {
    for (auto& group : groups_) group.stages.memory().renumber(place, shift);
  }
  template <class Archive>
  void serialize(Archive& archive) {
    for (auto& group : groups_) archive(group.stages.memory());
  }

 private:
  struct Group {
    std::vector<std::size_t> walls;
    ContactStages<D> stages;
    Contacts<D> contacts{};
  };
  Domain<D> domain_;
  std::vector<Wall<D>> walls_;
  std::vector<Group> groups_;
  double work_ = 0;

  bool is_far(const Wall<D>& wall, const Vec<D>& place, double R, double time) const;
  void find(const Grains<D>& grains, double time, double deepest, Group& group) const;
  double power(const Grains<D>& grains, double time, const Contacts<D>& contacts) const;
};

}  // namespace chute::soft
