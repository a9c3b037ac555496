#pragma once
#include <atomic>
#include <cstdint>

#include "core/kernel.hpp"
#include "search/coarse_places.hpp"
#include "search/pairs.hpp"

namespace chute::search {

enum class Method { cells, all_pairs };

/// Pairs that may touch, and coarsely where their grains are now; without that every pair takes a full look.
template <int D>
struct Candidates {
  const PairList& pairs;
  const CoarsePlaces<D>* coarse = nullptr;
};

/// Verlet lists on two levels. The far list holds all pairs with a gap below the far skin and is found
/// through the cell grid; the near list is the part of it with a gap below the near skin, and is what every
/// step looks through. A near list is made anew from the far one when some grain has moved half the near skin
/// since, a far list from the grid when that no longer guarantees that it holds every pair of the next near
/// list. Both bounds are exact, so no contact is ever missed. Steps in between allocate and build nothing.
template <int D>
class NeighbourList {
 public:
  struct Skins {
    double near, far;  ///< gaps between surfaces, lengths; near < far
    double apart = 0;  ///< surfaces that are no farther apart count as touching
  };

  NeighbourList(const Domain<D>& domain, Skins skins, Method method = Method::cells, Isa isa = best_isa());

  /// Pairs that may touch now. NotANumber if a place is not a number.
  Candidates<D> near(const Grains<D>& grains, Team& team = Team::alone());

  /// For who calls `survey` himself, of every grain after every step, instead of `near`: the pairs hold as
  /// long as no survey of the grains in `range` says that one has moved too far. It also renews their coarse
  /// places.
  Candidates<D> latest() const { return {near_, astray_ ? nullptr : &coarse_}; }
  bool survey(const Grains<D>& grains, Part range);
  auto& coarse_words() { return coarse_.word; }
  /// How many steps the pairs will hold at the present velocities; a guess, for surveys to confirm.
  std::int64_t lasts(const Grains<D>& grains, double time_step) const;
  /// Makes the near list anew before it must be.
  void renew(const Grains<D>& grains, Team& team);
  /// The grains have another order now; nothing that was known of them holds.
  void forget() { known_ = false; }
  /// There are other grains now, maybe more or fewer.
  void start_over() { known_ = false, coarse_ = {}, astray_ = false; }

  std::int64_t near_builds() const { return near_builds_; }
  std::int64_t far_builds() const { return far_builds_; }

 private:
  Domain<D> domain_;
  Skins skins_;
  Method method_;
  Isa isa_;
  CellGrid<D> grid_;
  PairNames far_;
  PairList near_;
  std::vector<PairList> parts_;       // of the near list, while it is made
  std::array<Array, D> near_places_;  // of the moving grains, when the near list was made
  double drift_ = 0;                  // farthest that a grain can have moved since the far list, up to then
  bool known_ = false;
  CoarsePlaces<D> coarse_;
  std::atomic<bool> astray_ = false;  // has a grain ever been too far away for coarse places?
  std::int64_t near_builds_ = 0, far_builds_ = 0;

  double farthest(const Grains<D>& grains) const;
  void set_up_coarse(const Grains<D>& grains);
  void remember_places(const Grains<D>& grains);
  void build_far(const Grains<D>& grains, Team& team);
  void build_near(const Grains<D>& grains, Team& team);
};

}  // namespace chute::search
