#pragma once
#include <vector>

#include "core/domain.hpp"
#include "core/wall.hpp"
#include "engines/soft/contacts.hpp"

namespace chute::soft {

/// Finds which grains touch the walls, and how: frame, overlap and relative motion as between two grains (2.3), (2.4),
/// (2.6), (2.7), with a partner that is infinitely large and heavy. A contact's j is the number of grains plus that of
/// the wall, so that contacts stay ordered by (i, j).
template <int D>
class WallContacts {
 public:
  explicit WallContacts(const std::vector<Wall<D>>& walls) : walls_(walls) {}
  bool any() const { return !walls_.empty(); }
  std::size_t count() const { return walls_.size(); }

  /// Fills all that laws need to know of the contacts, i by i.
  void find(const Grains<D>& grains, double deepest, Contacts<D>& contacts) const;

 private:
  std::vector<Wall<D>> walls_;
};

}  // namespace chute::soft
