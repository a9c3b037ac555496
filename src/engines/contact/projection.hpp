#pragma once
#include <vector>

#include "engines/contact/touching.hpp"

namespace chute::contact {

/// Overlaps below this part of d are left alone.
inline constexpr double slop = 1e-4;

/// Takes a part of what overlaps at the end of a step, for normals turn within a step, and impacts overlap before they
/// are found. Places only, no velocity: the smallest displacements, weighed by the masses, after which no overlap above
/// the slop is more than (1 − relaxation) of what it was and no new one begins (the split impulses of rigid-body codes,
/// Acary & Brogliato 2008). All contacts at once: pushed pair by pair, a pile closes above what was opened below, and
/// creeps for as long.
template <int D>
class Projection {
 public:
  Projection(const ContactSetup<D>& setup, const Grains<D>& grains)
      : setup_(setup), grains_(grains), way_(grains.moving) {}

  /// How far each moving grain has to go; empty if nothing overlaps by more than the slop.
  const std::vector<Vec<D>>& find(const std::vector<Touching<D>>& touching, double end);
  /// The deepest overlap before.
  double deepest() const { return deepest_; }

 private:
  struct Pair {
    std::uint32_t i, j;
    Vec<D> normal;      ///< into i
    double room;        ///< gap, and the overlap that may stay
    double push = 0;    ///< so far, ≥ 0
    double one, other;  ///< inverse masses
  };
  const ContactSetup<D>& setup_;
  const Grains<D>& grains_;
  std::vector<Pair> pairs_;
  std::vector<Vec<D>> way_, none_;
  double deepest_ = 0;

  void add(const Touching<D>& t, double end);
  double sweep();
};

}  // namespace chute::contact
