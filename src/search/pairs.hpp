#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "core/domain.hpp"
#include "core/grains.hpp"
#include "core/team.hpp"

namespace chute::search {

/// Pairs of grains, i < j, ordered by i and then by j. Everything that sums over contacts does so in this
/// order, so results depend only on who touches whom, not on when or how a list was built: a resumed run,
/// another skin, or the all-pairs twin give the same bytes. Pairs of two fixed grains are left out.
struct PairNames {
  std::vector<std::int32_t> i, j;

  std::size_t size() const { return i.size(); }
  void clear() {
    i.clear();
    j.clear();
  }
  void reserve(std::size_t count) {
    i.reserve(count);
    j.reserve(count);
  }
  void append(const PairNames& other) {
    i.insert(i.end(), other.i.begin(), other.i.end());
    j.insert(j.end(), other.j.begin(), other.j.end());
  }
  void add(std::size_t first, std::size_t second) {
    i.push_back(static_cast<std::int32_t>(first));
    j.push_back(static_cast<std::int32_t>(second));
  }
};

/// Pairs that may touch, with what a step asks of them.
struct PairList : PairNames {
  Array
      reach_squared;  ///< (R_i + R_j)², with what may lie between them: the pair touches when its distance squared is less
  Array m_eff;  ///< reduced mass; fixed grains count as infinitely heavy

  void clear() {
    PairNames::clear();
    reach_squared.clear();
    m_eff.clear();
  }
  void reserve(std::size_t count) {
    PairNames::reserve(count);
    reach_squared.reserve(count);
    m_eff.reserve(count);
  }
  void append(const PairList& other) {
    PairNames::append(other);
    reach_squared.insert(reach_squared.end(), other.reach_squared.begin(), other.reach_squared.end());
    m_eff.insert(m_eff.end(), other.m_eff.begin(), other.m_eff.end());
  }
  template <int D>
  void add(const Grains<D>& grains, std::size_t first, std::size_t second, double apart = 0) {
    PairNames::add(first, second);
    const double reach = grains.radius[first] + grains.radius[second] + apart;
    reach_squared.push_back(reach * reach);
    m_eff.push_back(1 / (grains.inverse_mass[first] + grains.inverse_mass[second]));
  }
};

/// keep(p) for every p of the range of which test(p) holds, in their order. The tests run ahead by a block, for a branch
/// at each would be guessed wrong every other time.
template <class Test, class Keep>
void for_those(Part range, const Test& test, const Keep& keep) {
  constexpr std::size_t block = 256;
  std::array<std::uint32_t, block> held;
  for (std::size_t begin = range.begin; begin < range.end; begin += block) {
    const auto size = std::min(block, range.end - begin);
    std::size_t count = 0;
    for (std::size_t k = 0; k < size; ++k) {
      held[count] = static_cast<std::uint32_t>(k);
      count += test(begin + k) ? 1 : 0;
    }
    for (std::size_t k = 0; k < count; ++k) keep(begin + held[k]);
  }
}

/// All pairs with a gap of less than `skin` between their surfaces, found through a grid of cells: O(N).
template <int D>
class CellGrid {
 public:
  void find(const Grains<D>& grains, const Domain<D>& domain, double skin, PairNames& pairs,
            Team& team = Team::alone());

 private:
  /// What a look at a neighbour needs, side by side in memory.
  struct Member {
    Vec<D> place;
    double radius;
    std::int32_t id;
  };
  // kept, so that a rebuild allocates nothing new
  std::vector<std::int32_t> start_;
  std::vector<Member> member_;                  // by cell, and by id within a cell
  std::vector<std::vector<std::int32_t>> row_;  // for each of the team
  std::vector<PairNames> parts_;
};

/// The slow exact twin of CellGrid: looks at every pair, O(N²).
template <int D>
void all_pairs(const Grains<D>& grains, const Domain<D>& domain, double skin, PairNames& pairs);

}  // namespace chute::search
