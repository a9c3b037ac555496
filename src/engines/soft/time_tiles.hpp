#pragma once
#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "engines/soft/contact_stages.hpp"
#include "engines/soft/integrator.hpp"
#include "engines/soft/strips.hpp"
#include "search/neighbour_list.hpp"

namespace chute::soft {

/// What a step works on.
template <int D>
struct StepParts {
  Grains<D>& grains;
  GrainSums<D>& sums;
  search::NeighbourList<D>& list;
  ContactStages<D>& stages;
  Integrator<D>& integrator;
  Team& team;
  double time_step;
};

/// Moves many grains on by several steps at once, part by part, so that a part is read from memory once for
/// all these steps and a team waits for each other once instead of several times in each. What is computed
/// is the same to the last bit as step by step: only the order in which grains and times come by differs.
///
/// The strips are cut into tiles. What happens in a tile depends on its neighbours only through its edges,
/// and an edge moves on by one strip per step. So first every tile alone takes K steps of ever fewer strips,
///
///     time ↑     ▁▁▁▁▁▁        ▁▁▁▁▁▁
///          │   ▁▁▁▁▁▁▁▁▁▁    ▁▁▁▁▁▁▁▁▁▁
///          │ ▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁▁
///            │    tile    │ │    tile    │
///
/// and then what is left around each border takes its K steps of ever more strips. For that it needs the
/// strip on either side as it was at each step, of which the tiles have kept a copy. The tiling of stencil
/// codes by trapezoids, for neighbour lists.
///
/// It works while the near list holds and no overlap is too deep. That shows on the way; then everything is
/// put back as it was, for steps one by one, which know what to do.
template <int D>
class TimeTiles {
 public:
  /// `grains_per_tile`: so many that a tile fits into a core's own cache.
  TimeTiles(const Strips<D>& strips, std::size_t grains_per_tile)
      : strips_(strips), grains_per_tile_(grains_per_tile) {}

  /// How many steps, at most `most`, can be taken at once; 0 if it is not worth it. May renew the near list.
  std::int64_t possible(const StepParts<D>& parts, std::int64_t most);

  /// Takes `steps` steps, from predicted places to predicted places; the coarse places must be up to date.
  /// False: nothing has changed, steps must be taken one by one.
  bool advance(const StepParts<D>& parts, std::int64_t steps);

  /// The strips have been sorted anew.
  void sorted() { cut_ = false, seen_list_ = -1; }

 private:
  /// Strips [first, end); what is left of it after k steps is [begin + k, stop − k).
  struct Tile {
    std::size_t first, end, begin, stop;
  };
  /// A strip at each of the steps: fields one after the other.
  struct History {
    std::vector<double> numbers;
    std::vector<std::uint64_t> words;
    std::vector<std::size_t> at;  // first number of each step
  };
  struct Scratch {
    Contacts<D> contacts;
    typename ContactStages<D>::Touching touching;
  };
  /// Ranges of strips that take a step together: one, or two at both ends.
  struct Slab {
    std::array<Part, 2> strips;
    std::size_t count;
  };

  const Strips<D>& strips_;
  std::size_t grains_per_tile_;
  bool cut_ = false;
  std::size_t narrowest_ = 0;  // strips of a tile in its first step; one is lost on either side in each
  std::int64_t seen_list_ = -1;
  bool fits_ = false;                    // does every pair join strips next to each other?
  std::vector<std::size_t> first_pair_;  // of each strip, and the end
  std::vector<Tile> tiles_;
  std::vector<History> left_, right_;  // the first and the last strip of each tile's steps
  std::vector<int> done_;  // how many of the two tiles at a border are; 3: the gap between them is taken
  std::vector<std::size_t> next_;  // tile for each of the team
  std::vector<Scratch> scratch_;   // for each of the team
  std::vector<Array> saved_;
  std::vector<std::vector<int>> saved_words_;
  std::atomic<bool> failed_ = false;

  void prepare(const StepParts<D>& parts);
  void look_at(const search::PairList& pairs, std::size_t moving);
  void cut(std::size_t grains, std::size_t team);
  void cut_into(std::size_t count);
  void shrink(const StepParts<D>& parts, std::size_t tile, std::int64_t steps, Scratch& scratch);
  void fill(const StepParts<D>& parts, std::size_t border, std::int64_t steps, Scratch& scratch);
  void step(const StepParts<D>& parts, const Slab& slab, Scratch& scratch);
  void keep(const StepParts<D>& parts, std::size_t strip, History& history) const;
  void swap(const StepParts<D>& parts, std::size_t strip, std::int64_t step, History& history) const;
  void save(const StepParts<D>& parts, Part grains);
  void put_back(const StepParts<D>& parts);
  template <class Copy>
  void with_saved(const StepParts<D>& parts, const Copy& copy);
  template <class Each>
  static void for_state(const StepParts<D>& parts, const Each& each);
};

}  // namespace chute::soft
