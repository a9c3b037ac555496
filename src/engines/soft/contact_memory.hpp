#pragma once
#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "common/wrong_state.hpp"
#include "engines/soft/contacts.hpp"
#include "laws/list.hpp"

namespace chute::soft {

/// How the way that surfaces slip in one step follows from the velocities that the forces see.
enum class SlipRule {
  trapezoid,  ///< velocities at the ends of the step (gear5): the mean of both
  midpoint    ///< velocities of the half step (verlet): the present one
};

/// What laws with a memory keep of each contact, from the step in which it begins to the one in which ξ
/// returns to 0. It belongs to the pair (i, j), whatever the neighbour list does, however often the pair
/// crosses a periodic border, and is part of a checkpoint. Carrying it on is a merge of two lists that are
/// ordered alike.
///
/// Vectors in the contact plane turn with it in 3D: as n turns, by the smallest rotation from the old n to
/// the new, and about n by the mean of the two grains' spins, so that a pair that turns as one body keeps its
/// spring. In 2D they are components along s, which turns with n by itself.
template <int D>
class ContactMemory {
 public:
  static constexpr int T = turns<D>;

  ContactMemory(const laws::ContactLaws& laws, SlipRule rule);

  /// Does any law of this contact have a memory? Without one nothing else here is called.
  bool needed() const { return normal_count_ > 0 || shear_; }

  /// Takes over what the contacts of the previous step remember, `duration` ago; new ones begin with nothing.
  /// Sets `way`: how far the surfaces of each contact slipped since, for a new contact since it began.
  void carry(const Grains<D>& grains, const Contacts<D>& contacts, double duration);

  /// Did this contact begin in this step?
  bool fresh(std::size_t contact) const { return source_[contact] < 0; }
  /// What contacts that ended in this step still have to account for: the energy of their springs, which is
  /// lost, and the work of the second half of their last step.
  double released() const { return released_; }

  double* normal_column(int k) { return columns_[static_cast<std::size_t>(k)].data(); }
  /// Vector k of the tangential law, component c.
  double* vector_column(int k, int c) { return column(first_vector() + (2 + k) * T + c); }
  double* scalar_column(int k) { return column(first_scalar() + 1 + k); }
  double* previous_slip(int c) { return column(first_vector() + c); }
  double* previous_force(int c) { return column(first_vector() + T + c); }
  double* stored_column() { return column(first_scalar()); }
  const std::array<Array, T>& way() const { return way_; }

  template <class Archive>
  void serialize(Archive& archive) {
    const auto columns = columns_.size();
    archive(count_, i_, j_, columns_, normal_);
    const auto fits = [&](const auto& list) { return list.size() == count_; };
    if (columns_.size() != columns || !fits(i_) || !fits(j_) || !std::ranges::all_of(columns_, fits) ||
        !(std::ranges::all_of(normal_, fits) ||
          std::ranges::all_of(normal_, [](const auto& n) { return n.empty(); })))
      wrong_state();
  }

 private:
  SlipRule rule_;
  int normal_count_ = 0, vectors_ = 0, scalars_ = 0;
  bool shear_ = false;
  std::size_t count_ = 0;
  std::vector<std::int32_t> i_, j_;
  // normal law's numbers | previous slip, previous force, the law's vectors | stored energy, the law's
  // scalars
  std::vector<Array> columns_, older_;
  std::array<Array, D> normal_;  // 3D: n at the previous step
  std::vector<std::int32_t> source_;
  std::array<Array, T> way_;
  double released_ = 0;

  int first_vector() const { return normal_count_; }
  int first_scalar() const { return normal_count_ + (shear_ ? (2 + vectors_) * T : 0); }
  double* column(int k) { return columns_[static_cast<std::size_t>(k)].data(); }
  void match(const Contacts<D>& contacts, double duration);
  void turn(const Grains<D>& grains, const Contacts<D>& contacts, double duration);
  void find_ways(const Contacts<D>& contacts, double duration);
};

}  // namespace chute::soft
