#pragma once
#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "common/wrong_state.hpp"
#include "core/kernel.hpp"
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
/// ordered alike, and one pass from the old numbers to the new.
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

  /// Finds, in one pass by one thread, where each contact's memory is among those of the previous step.
  void match(const Contacts<D>& contacts, double duration) {
    begin();
    match_piece(contacts, duration);
    end(duration);
  }
  /// The same where a step's contacts come in pieces, in their order: what follows is of the last piece, until the next.
  void begin();
  void match_piece(const Contacts<D>& contacts, double duration);
  void end(double duration);
  /// Takes over what contacts in `range` remember, `duration` ago; new ones begin with nothing. Sets `way`: how far the
  /// surfaces of each contact slipped since, for a new contact since it began. After `match`.
  void carry(const Grains<D>& grains, const Contacts<D>& contacts, double duration, Part range, Isa isa);
  /// The grain that was k is now place[k]; fixed ones and walls stay.
  void reorder(std::span<const std::int32_t> place);
  /// The moving grain that was k is now place[k], in the same order, or is gone (−1), and with it its contacts; fixed ones and
  /// walls are numbered `shift` higher.
  void renumber(std::span<const std::int32_t> place, std::int32_t shift);

  /// Where a contact's memory was in the previous step; negative: it began in this one. As all below, of the piece.
  const std::int32_t* source() const { return source_.data(); }
  /// What contacts that ended in this step still have to account for: the energy of their springs, which is
  /// lost, and the work of the second half of their last step.
  double released() const { return released_; }

  double* normal_column(int k) { return column(k); }
  /// Vector k of the tangential law, component c.
  double* vector_column(int k, int c) { return column(first_vector() + (2 + k) * T + c); }
  double* scalar_column(int k) { return column(first_scalar() + 1 + k); }
  double* previous_slip(int c) { return column(first_vector() + c); }
  double* previous_force(int c) { return column(first_vector() + T + c); }
  double* stored_column() { return column(first_scalar()); }
  const double* way(int c) const { return way_[static_cast<std::size_t>(c)].data(); }

  template <class Archive>
  void serialize(Archive& archive) {
    const auto columns = columns_.size();
    archive(count_, i_, j_, columns_, normal_);
    const auto fits = [&](const auto& list) { return list.size() >= count_; };  // some are padded
    if (columns_.size() != columns || i_.size() != count_ || j_.size() != count_ ||
        !std::ranges::all_of(columns_, fits) ||
        !(std::ranges::all_of(normal_, fits) ||
          std::ranges::all_of(normal_, [](const auto& n) { return n.empty(); })))
      wrong_state();
  }

 private:
  SlipRule rule_;
  int normal_count_ = 0, vectors_ = 0, scalars_ = 0;
  bool shear_ = false;
  std::size_t count_ = 0;                      // contacts so far
  std::size_t first_ = 0;                      // of them, the first of the piece
  std::size_t older_count_ = 0, matched_ = 0;  // of the previous step, and those of them that went by
  std::vector<std::int32_t> i_, j_, older_i_, older_j_;
  // normal law's numbers | previous slip, previous force, the law's vectors | stored energy, the law's
  // scalars
  std::vector<Array> columns_, older_;
  std::array<Array, D> normal_, older_normal_;  // 3D: n at the previous step
  std::vector<std::int32_t> source_;
  std::array<Array, T> way_;
  double released_ = 0;

  int first_vector() const { return normal_count_; }
  int first_scalar() const { return normal_count_ + (shear_ ? (2 + vectors_) * T : 0); }
  double* column(int k) { return columns_[static_cast<std::size_t>(k)].data() + first_; }
  void release(std::size_t old, double duration);
  template <int V>
  void carry_vectors(const Grains<D>& grains, const Contacts<D>& contacts, double duration, Part range,
                     Isa isa);
};

}  // namespace chute::soft
