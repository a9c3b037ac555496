#pragma once
#include <vector>

#include "core/engine.hpp"
#include "core/grains.hpp"
#include "engines/contact/touching.hpp"

namespace chute::contact {

/// At most so many rounds of impacts in a step, in each of which a grain is hit at most once: what still approaches
/// then stops without rebound. A cradle of as many grains passes its impulse on within a step.
inline constexpr int most_rounds = 10;

/// An impact in this step, as it was before.
template <int D>
struct Struck {
  double time;
  std::size_t touching;  ///< which of the contacts
  Vec<D> velocity;       ///< of i relative to the partner
};

/// Walton's collisions in a step of contact dynamics: of those that overlap in its middle and approach faster than
/// `impact_velocity`. Each happens where and when the two touched: in free flight from the step's begin, on parabolas,
/// and what they have moved too far since is taken back, so that a ball in flight keeps exactly to its way.
template <int D>
class WaltonImpacts {
 public:
  WaltonImpacts(const ContactSetup<D>& setup, const Grains<D>& grains)
      : setup_(setup), grains_(grains), struck_round_(grains.moving, -1) {}

  /// When the step begins, at which time the velocities hold, and gravity in it.
  struct Begin {
    double time = 0;
    Vec<D> gravity{};
  };
  /// Leaves velocities, spins and middles after the impacts, impulses in `touching`, losses in the account; adds to
  /// `struck`.
  void collide(Bodies<D>& bodies, std::vector<Touching<D>>& touching, const Begin& begin,
               EnergyAccount& account, std::vector<Struck<D>>& struck);

 private:
  struct Event {
    double after;  ///< the step's begin
    std::size_t touching;
  };
  const ContactSetup<D>& setup_;
  const Grains<D>& grains_;
  std::vector<int> struck_round_;
  std::vector<Event> events_;
  Bodies<D>* bodies_ = nullptr;
  Begin begin_;

  bool moves(std::size_t j) const { return j < grains_.moving; }
  bool is_wall(std::size_t j) const { return j >= grains_.size(); }
  const Wall<D>& wall_of(std::size_t j) const { return setup_.walls[j - grains_.size()]; }
  /// Where a grain is in free flight so long after the step's begin.
  Vec<D> place(std::size_t i, double after) const;
  Vec<D> velocity(std::size_t i, double after) const;
  /// The way from the partner's surface point or centre to i, how far apart the surfaces are, and how fast that changes.
  struct Standing {
    Vec<D> normal;
    double gap, rate;
  };
  Standing standing(const Touching<D>& t, double after) const;
  bool approaches(const Touching<D>& t) const;
  double touch_time(const Touching<D>& t) const;
  Struck<D> collide(Touching<D>& t, const Event& event, EnergyAccount& account);
};

}  // namespace chute::contact
