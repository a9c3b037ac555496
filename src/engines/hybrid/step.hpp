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
  ByPair<hard::HardContact> between{};  ///< by materials; empty: `contact` for all
  double time_step = 0;
  double diameter = 1;  ///< d: what lengths are measured by
  int collisions_per_pair = 8;
  double relaxation = 0.9;  ///< part of an overlap that a step takes away
  int threads = 1;          ///< results do not depend on it
};

/// At most so many collisions of one grain in a step; what is left waits for the next. With collisions_per_pair it
/// bounds the work of a step, whatever collapses.
inline constexpr int collisions_per_grain = 64;

/// Approaches slower than this many times what gravity gives in a step are of grains that rest on each other: no bounce of
/// theirs can be resolved, so e_n = 0 and β = 0.
inline constexpr double resting = 2;

/// And grains at rest whose surfaces part or approach slower than this many times that are let be: they sink into each other
/// by as much of g Δt² in a step, or are found again in the next.
inline constexpr double settled = 0.1;

/// What a sweep changes the normal impulse of grains at rest by, over what would stop them: successive over-relaxation, which
/// needs fewer sweeps for the weight of a layer to get down than 1 does, and is stable below 2.
inline constexpr double over_relaxation = 1.3;

/// A grain may not move farther than this part of d in a step: it might pass another.
inline constexpr double farthest_move = 0.3;

/// Overlaps below this part of d are left alone.
inline constexpr double slop = 1e-4;

/// The collisions of two in one step, as they are accounted for.
template <int D>
struct Hit {
  double first, last;  ///< when they collided
  std::size_t i, j;    ///< i < j; from the number of grains on, j is a wall
  Vec<D> place;        ///< of i at the first
  Vec<D> way;          ///< then, from i to j's centre or the wall's surface
  Vec<D> velocity;     ///< of j relative to i before it, that of the surface for a wall
  Vec<D> impulse;      ///< on j, of the first
  Vec<D> further{};    ///< on j, of those after it
  int collisions = 1;
};

/// Two grains that rested on each other in a step, and the impulses of that on j.
template <int D>
struct Pressing {
  std::uint32_t i, j;
  double normal;
  Vec<D> shear;

  template <class Archive>
  void serialize(Archive& a) {
    a(i, j, normal, shear.c);
  }
};

/// All collisions of one time step. Every grain has a local time, at first the step's begin, at which its flight starts;
/// a pair collides at its first contact after both local times, which moves both on.
///
/// A first look at all pairs finds who meets within the step, and these collide in order of (time, i, j), each pair once;
/// whoever has collided since the look is looked at again then. Then sweeps look, in the order of ids, at all pairs of
/// grains that have collided since the pair's last turn, and let who meets collide at once, until nobody does. One pair is exact so, whatever the step. Where a grain
/// collides several times in a step, the order may not be that of the times, which is of first order in the step. Grains
/// that press on each other are swept over like the contacts of a Gauss-Seidel solver, each pair taking away its approach
/// as it is by then.
///
/// What grains that rest on each other exchange in a step is one impulse, J_n ≥ 0 and |J_s| ≤ μ J_n, which the sweeps find: a
/// pair that parts again gives back of it. It begins with that of the step before where the two still touch, for a layer at
/// rest carries now what it carried then; from nothing, the weight of ten grains on each other would take some hundred
/// sweeps, and what eight of them leave makes a dense flow sink into itself and lock. Grains that hit each other faster
/// collide as Walton has it, also where they rested before.
template <int D>
class Step {
 public:
  Step(const HybridSetup<D>& setup, const Grains<D>& grains) : setup_(setup), grains_(grains) {}

  struct Outcome {
    std::vector<Hit<D>> hits;
    std::vector<std::uint32_t> order;  ///< of the hits: by (first, i, j)
    std::int64_t collisions = 0;
    std::int64_t put_off = 0;  ///< times that a bound left a collision to the next step
    double normal_loss = 0, shear_loss = 0, wall_work = 0;
  };
  /// Lets the grains in `flights`, whose times are the step's begin, fly and collide until `end`. `pairs` are those that
  /// may meet.
  const Outcome& collide(std::vector<hard::Flight<D>>& flights, const search::PairNames& pairs, double end,
                         Team& team);

  /// Who rested on whom in the last step, in the order of the pairs: the next one starts from that.
  std::vector<Pressing<D>>& pressings() { return pressings_; }
  const std::vector<Pressing<D>>& pressings() const { return pressings_; }

 private:
  /// A grain's flight since its last collision, as if it had begun with the step, and without the ½ g s² that is common
  /// to all: two grains of which each is so stand to each other at s as place + s velocity, whenever they collided last.
  struct Body {
    Vec<D> place{}, velocity{};
    double time = 0;  ///< of the last collision, since the step's begin
    double radius = 0;
    Vec<turns<D>> spin{};
    double inverse_mass = 0, inverse_inertia = 0;
    std::int32_t collisions = 0;  ///< in this step; tells an event that it is out of date, too
  };
  /// What two partners have in common: a pair of grains, or a grain and a wall.
  struct Partners {
    std::uint32_t i, j;
    int collisions = 0;     ///< in this step
    std::uint32_t hit = 0;  ///< which of the step's, if they collided
    bool presses = false;   ///< they rest on each other in this step
    double pressed = 0;     ///< normal impulse on j of that, ≥ 0
    Vec<D> sheared{};       ///< tangential one
    double normal_mass = 0, shear_mass = 0,
           friction = 0;  ///< that resist an approach and a slip; 0 until it presses
    Vec<D> image{};       ///< what makes j − i the nearest image's way
  };
  struct Event {
    double time;
    std::uint32_t partners;
    std::int32_t version;  ///< sum of both grains' collisions
  };
  /// Two at a moment: from i to j.
  struct Relative {
    Vec<D> way, velocity;
  };
  /// How their surfaces move against each other there.
  struct Touch {
    Vec<D> n, slip;
    double v_n;
  };

  const HybridSetup<D>& setup_;
  const Grains<D>& grains_;
  std::vector<hard::Flight<D>>* flights_ = nullptr;
  Vec<D> gravity_{};
  double begin_ = 0, end_ = 0, length_ = 0;
  double given_ = 0;       // velocity that gravity gives in a step
  double negligible_ = 0;  // an approach as slow as this is none
  std::vector<Body> bodies_;
  std::vector<Partners> partners_;
  std::vector<std::uint32_t> first_, of_;              // partners of each moving grain: of_[first_[i]] …
  std::vector<std::uint8_t> moved_;                    // by grain and wall: has it collided in this sweep?
  std::vector<std::uint8_t> moved_before_;             // … in the one before
  std::vector<std::uint32_t> movers_, movers_before_;  // those
  std::vector<std::uint32_t> to_check_;                // partners, in their order
  std::vector<double> times_;                          // when these meet
  std::vector<Event> events_;
  std::vector<Pressing<D>> pressings_;
  Outcome outcome_;

  bool is_wall(std::size_t j) const { return j >= grains_.size(); }
  bool moves(std::size_t j) const { return j < grains_.moving; }
  const Wall<D>& wall_of(std::size_t j) const { return setup_.walls[j - grains_.size()]; }
  void take_off();
  void arrive();
  void list_partners(const search::PairNames& pairs);
  hard::Flight<D> flight(std::size_t i) const;
  /// How two grains stand to each other, s after the begin of the step. Called in the innermost loop.
  [[gnu::always_inline]] Relative relative(const Partners& p, double s) const {
    const auto &a = bodies_[p.i], &b = bodies_[p.j];
    Relative r{b.place - a.place + p.image, b.velocity - a.velocity};
    if (moves(p.j)) {
      r.way = r.way + s * r.velocity;
    } else {
      r.way = r.way + s * (r.velocity - (0.5 * s) * gravity_);
      r.velocity = r.velocity - s * gravity_;
    }
    return r;
  }
  std::int32_t version(const Partners& p) const;
  double contact(const Partners& p) const;
  bool spent(const Partners& p) const;
  void find_events(Team& team);
  void do_events();
  bool sweep();
  [[gnu::always_inline]] inline void look_again(Partners& p);
  [[gnu::always_inline]] inline bool unsettled(const Partners& p, double closing) const;
  [[gnu::always_inline]] inline void note_moved(const Partners& p);
  void meet(Partners& p, double s);
  void list_to_check();
  bool collide(Partners& p, double s);
  void lean();
  void remember();
  [[gnu::always_inline]] inline std::pair<laws::Collider<D>, laws::Collider<D>> colliders(
      const Partners& p, const Relative& before) const;
  void press(Partners& p, double s, const Relative& before, double distance);
  [[gnu::always_inline]] inline void press_to(Partners& p, double s, const Relative& before,
                                              const Touch& touch, double pressed, const Vec<D>& sheared,
                                              laws::Collider<D>& i, laws::Collider<D>& j);
  [[gnu::always_inline]] inline void pass(Partners& p, double s, const Relative& before,
                                          const Vec<D>& impulse, const Vec<turns<D>>& spin_i,
                                          const Vec<turns<D>>& spin_j);
  [[gnu::always_inline]] inline void note(Partners& p, double s, const Relative& before,
                                          const Vec<D>& impulse);
};

}  // namespace chute::hybrid
