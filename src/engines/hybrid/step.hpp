#pragma once
#include <cstdint>
#include <vector>

#include "core/team.hpp"
#include "core/world.hpp"
#include "engines/hard/flight.hpp"
#include "engines/hard/hard_contact.hpp"
#include "search/pairs.hpp"

namespace chute::hybrid {

/// What a hybrid run needs besides its grains.
template <int D>
struct HybridSetup : Surroundings<D> {
  hard::HardContact contact{};
  double time_step = 0;
  double diameter = 1;  ///< d: what lengths are measured by
  int collisions_per_pair = 8;
  double relaxation = 0.2;  ///< part of an overlap that a step takes away
  int threads = 1;          ///< results do not depend on it
};

/// At most so many collisions of one grain in a step; what is left waits for the next. With collisions_per_pair it
/// bounds the work of a step, whatever collapses.
inline constexpr int collisions_per_grain = 64;

/// Approaches slower than this many times what gravity gives in a step cannot bounce: e_n = 0 and β = 0.
inline constexpr double resting = 2;

/// A grain may not move farther than this part of d in a step: it might pass another.
inline constexpr double farthest_move = 0.3;

/// Overlaps below this part of d are left alone.
inline constexpr double slop = 1e-4;

/// A collision, as it is accounted for.
template <int D>
struct Hit {
  double time;
  std::size_t i, j;  ///< i < j; from the number of grains on, j is a wall
  Vec<D> place;      ///< of i
  Vec<D> way;        ///< from i to j's centre or the wall's surface
  Vec<D> velocity;   ///< of j relative to i before, that of the surface for a wall
  laws::Collision<D> done;
  double wall_work;
};

/// All collisions of one time step. Every grain has a local time, at first the step's begin, at which its flight starts;
/// a pair collides at its first contact after both local times, which moves both on.
///
/// Grains that hit each other directly or in a chain are an island, and islands do not know of each other: each does its
/// collisions in order of (time, i, j), in parallel. Where a grain then runs into one of another island, or into one that
/// nobody had hit, the next round finds it. So what comes out depends on nobody but the grains.
template <int D>
class Step {
 public:
  Step(const HybridSetup<D>& setup, const Grains<D>& grains) : setup_(setup), grains_(grains) {}

  struct Outcome {
    std::vector<Hit<D>> hits;  ///< ordered by (time, i, j)
    std::int64_t put_off = 0;  ///< times that a bound left a collision to the next step
  };
  /// Lets the grains in `flights`, whose times are the step's begin, collide until `end`. `pairs` are those that may
  /// meet.
  const Outcome& collide(std::vector<hard::Flight<D>>& flights, const search::PairNames& pairs, double end,
                         Team& team);

 private:
  /// What two partners have in common: a pair of grains, or a grain and a wall.
  struct Partners {
    std::uint32_t i, j;
    int collisions = 0;  ///< in this step
  };
  struct Event {
    double time;
    std::uint32_t partners;
    std::int64_t version;  ///< sum of both grains' collisions, to tell that it is out of date
  };
  struct Island {
    std::vector<Event> events;
    std::vector<Hit<D>> hits;
    std::int64_t put_off = 0;
  };

  const HybridSetup<D>& setup_;
  const Grains<D>& grains_;
  std::vector<hard::Flight<D>>* flights_ = nullptr;
  double end_ = 0;
  std::vector<Partners> partners_;
  std::vector<std::uint32_t> first_, of_;  // partners of each moving grain: of_[first_[i]] …
  std::vector<std::uint32_t> root_;        // union-find over moving grains
  std::vector<std::uint8_t> moved_, done_;
  std::vector<int> grain_collisions_;
  std::vector<Island> islands_;
  Outcome outcome_;

  bool is_wall(std::size_t j) const { return j >= grains_.size(); }
  bool moves(std::size_t j) const { return j < grains_.moving; }
  hard::Flight<D>& flight(std::size_t i) { return (*flights_)[i]; }
  void list_partners(const search::PairNames& pairs, double begin);
  std::int64_t version(const Partners& p);
  double contact(const Partners& p);
  std::uint32_t root(std::uint32_t i);
  std::size_t gather(const std::vector<std::uint32_t>& to_check);
  void collide(Island& island);
  bool collide(Island& island, Partners& p, double time);
  void push(Island& island, std::uint32_t partners);
};

}  // namespace chute::hybrid
