#pragma once
#include <limits>
#include <string>

#include "core/engine.hpp"
#include "core/world.hpp"
#include "engines/event/event_queue.hpp"
#include "engines/event/near_grains.hpp"
#include "engines/hard/hard_contact.hpp"
#include "engines/hard/meetings.hpp"

namespace chute::event {

using hard::HardContact;
using hard::Meeting;
using hard::Meetings;

/// What an event-driven run needs besides its grains.
template <int D>
struct EventSetup : Surroundings<D> {
  HardContact contact{};
  ByPair<HardContact> between{};  ///< by materials; empty: `contact` for all
  /// t_c of the cut-off against inelastic collapse, 0: none. See EventEngine. A real contact lasts t_n of
  /// (3.3); results must not depend on t_c as long as g t_c is far below the velocities that matter.
  double contact_time = 0;
  std::uint64_t seed = 1;  ///< of what leaves walls that heat
  double tick = 0;  ///< time between the instants that a caller can stop at; the motion does not depend on it
};

/// Event-driven molecular dynamics of hard spheres, thesis 2.1.3: grains fly freely from collision to
/// collision, whose times are solved for (first_contact.hpp), and a collision changes velocities at once
/// (laws/walton.hpp).
///
/// Every grain remembers its flight since its last collision and its earliest event: a collision, or the end of
/// what its list of near grains holds for, where it looks for new partners (NearGrains). A calendar holds these
/// (EventQueue); a grain whose partner was hit by somebody else finds out when its event comes up and looks again. The
/// work per collision does not grow with the number of grains.
///
/// Inelastic collapse. Without a cut-off, a grain that comes to rest collides infinitely often in a finite
/// time; the run then stops with a WorkError that names it. With t_c > 0, a collision less than t_c after the
/// last one *of the same pair* is elastic, after Luding (thesis 2.1.3): a lasting contact is then a train of
/// tiny bounces whose mean force is the true contact force, within Coulomb's limit. The time counts per pair,
/// not per grain: a ball that rolls from one bead onto the next hits that one with its full loss. Friction
/// goes on taking energy in such a train (a ball wedged between two beads would still collapse, even with e_n
/// = 1), so the rebound is kept at |g| t_c/4 or more, half the fall in t_c; what that puts in counts as
/// negative normal loss. Only the collision that begins a train (meetings.hpp) is an impact; trains are
/// contacts().
///
/// A velocity-dependent e_n alone does not prevent collapse under gravity: bounces then shrink like k^(−1/δ),
/// and their times still add up to a finite one for δ < 1.
template <int D>
class EventEngine final : public Engine {
 public:
  /// WorkError if grains overlap at the start, or the domain is shorter than two contacts.
  EventEngine(Grains<D> grains, const EventSetup<D>& setup);

  std::int64_t step() const override { return step_; }
  double time_step() const override { return setup_.tick; }
  GrainsView grains() const override;
  EnergyAccount energy() const override;
  std::vector<Contact> contacts() const override;
  void collect_impacts(bool on) override { collecting_ = on; }
  std::vector<Impact> take_impacts() override;
  std::vector<Parting> take_partings() override { return std::exchange(partings_, {}); }
  void collect_collisions(bool on) override { collecting_collisions_ = on; }
  std::vector<Collision> take_collisions() override { return std::exchange(collisions_, {}); }
  void save(std::ostream& out) const override;
  void restore(std::istream& in) override;

  const Grains<D>& state() const { return grains_; }

  /// What was done so far, to see what a run costs.
  struct Work {
    std::int64_t collisions = 0;   ///< all of them
    std::int64_t elastic = 0;      ///< those made elastic by t_c
    std::int64_t moves = 0;        ///< ends of what a list holds for
    std::int64_t outdated = 0;     ///< predictions that came up after the partner was hit
    std::int64_t candidates = 0;   ///< pairs looked at: the unit of cost
    std::int64_t predictions = 0;  ///< those whose time was solved for
    std::int64_t layouts = 0;      ///< times all lists were made
  };
  const Work& work() const { return work_; }

 private:
  /// The earliest collision that a grain will have. `other` is a grain, or from their number on a wall.
  struct Prospect {
    double time = std::numeric_limits<double>::infinity();
    std::size_t other = 0;
    std::int64_t other_collisions = 0;
  };

  double now() const override { return now_; }
  void advance(std::int64_t step) override;

  EventSetup<D> setup_;
  Grains<D> grains_;                // as of the last tick: for those who look
  std::vector<Flight<D>> flights_;  // the truth
  /// What is ahead of a moving grain.
  struct alignas(64) Outlook {
    Prospect first{};        // the earliest
    double moves = 0;        // when its list must be looked after
    double burst_begin = 0;  // to notice a collapse
    std::int64_t burst_collisions = 0;
  };
  std::vector<Outlook, CacheAligned<Outlook>> outlook_;
  /// What predictions ask of a flight, in one cache line.
  struct alignas(64) Course {
    Vec<D> place{}, velocity{};
    double time = 0, radius = 0;
  };
  std::vector<Course, CacheAligned<Course>> courses_;
  NearGrains<D> near_;
  EventQueue queue_;
  Meetings meetings_;
  TouchLog touches_;
  std::array<Array, D> start_place_, force_;
  EnergyAccount account_;
  double now_ = 0, reach_ = 0, still_ = 0;
  std::int64_t step_ = 0, next_look_ = 0;
  bool collecting_ = false, collecting_collisions_ = false;
  std::vector<Impact> impacts_;
  std::vector<Parting> partings_;
  std::vector<Collision> collisions_;
  Work work_;

  using Near = typename NearGrains<D>::Near;
  double contact_with(std::size_t i, const Near& near, double limit);
  double contact_with_wall(std::size_t i, std::size_t wall, double limit) const;
  bool is_wall(std::size_t partner) const { return partner >= grains_.size(); }
  const Wall<D>& wall_of(std::size_t partner) const { return setup_.walls[partner - grains_.size()]; }
  Vec<D> way_to(std::size_t partner, const Vec<D>& from, const Vec<D>& to, double t) const;
  Contact told(std::size_t i, std::size_t partner, const Vec<D>& place, const Vec<D>& way,
               const Vec<D>& force) const;
  void look(std::size_t i, std::size_t likely);
  void look_at(std::size_t i, const Near& near);
  double plan(std::size_t i);
  void set_course(std::size_t i);
  void lay_out();
  void collide(std::size_t i, std::size_t j);
  void note_touch(std::size_t i, std::size_t j, const Vec<D>& n, const Meeting* train);
  void check_collapse(std::size_t i);
  void show();
  laws::Collider<D> collider(std::size_t i, const Vec<D>& n) const;
  laws::Collision<D> exchange(const Vec<D>& n, const HardContact& contact, const Meeting* train,
                              laws::Collider<D>& a, laws::Collider<D>& b);
  laws::Collision<D> warm(std::size_t i, const Vec<D>& n, double T, const Vec<D>& surface,
                          laws::Collider<D>& a);
  template <class Archive, class Self>
  static void transfer(Archive& archive, Self& self);
};

}  // namespace chute::event
