#pragma once
#include <memory>

#include "core/engine.hpp"
#include "engines/hard/meetings.hpp"
#include "engines/hybrid/step.hpp"
#include "search/neighbour_list.hpp"

namespace chute::hybrid {

/// Molecular dynamics of hard grains in time steps, thesis 2.1.4, after Hopkins and Louge: in each step all grains fly on;
/// those that would overlap are moved back to where they touched, collide there (laws/walton.hpp), and fly on from there.
/// One pair is exact whatever the step; of many in contact the order within a step is that of their times.
///
/// There is no collapse: a pair collides at most `collisions_per_pair` times in a step, and what is left over waits for
/// the next step; `tells` counts how often. Grains at rest on each other pass on their weight as one impulse a step, without
/// rebound (step.hpp). What they sink into each other meanwhile, ½ g Δt² in a step, is
/// taken back bit by bit by moving them apart, which changes no velocity; the potential energy that this puts in is the
/// account's `projection_work`.
///
/// A step: fly → find who may meet → collide (step.hpp) → arrive → push apart → account.
template <int D>
class HybridEngine final : public Engine {
 public:
  HybridEngine(Grains<D> grains, const HybridSetup<D>& setup);
  HybridEngine(const HybridEngine&) = delete;  // its parts refer to each other
  HybridEngine& operator=(const HybridEngine&) = delete;

  std::int64_t step() const override { return step_; }
  double time_step() const override { return setup_.time_step; }
  GrainsView grains() const override;
  EnergyAccount energy() const override;
  /// Trains of collisions that go on, with their mean forces.
  std::vector<Contact> contacts() const override;
  void collect_impacts(bool on) override { collecting_ = on; }
  std::vector<Impact> take_impacts() override { return std::exchange(impacts_, {}); }
  void collect_collisions(bool on) override { collecting_collisions_ = on; }
  std::vector<Collision> take_collisions() override { return std::exchange(collisions_, {}); }
  std::vector<std::pair<std::string, double>> tells() const override;
  void save(std::ostream& out) const override;
  void restore(std::istream& in) override;

  const Grains<D>& state() const { return grains_; }

 private:
  void advance(std::int64_t step) override;

  /// Pairs that come within a margin of each other, found by a list of grains that are larger by half of it.
  struct Nearby {
    Grains<D> grown;
    search::NeighbourList<D> list;
    Nearby(const Grains<D>& grains, const HybridSetup<D>& setup, double margin);
  };

  HybridSetup<D> setup_;
  Grains<D> grains_;                      // as of the last step, for those who look
  Vec<D> gravity_;                        // in this step
  std::vector<Vec<D>> from_;              // places at the step's begin, where the incline tilts
  std::vector<hard::Flight<D>> flights_;  // the truth
  Step<D> one_step_;
  Nearby usual_, fast_;
  hard::Meetings meetings_;
  TouchLog touches_;
  std::array<Array, D> start_place_, force_;
  EnergyAccount account_;
  std::int64_t step_ = 0;
  std::int64_t hits_ = 0, put_off_ = 0;
  double deepest_ = 0;  // overlap of the last step
  bool collecting_ = false, collecting_collisions_ = false;
  std::vector<Impact> impacts_;
  std::vector<Collision> collisions_;
  search::PairNames pairs_;
  std::vector<std::size_t> overlapping_;  // of these
  std::unique_ptr<Team> team_;

  bool is_wall(std::size_t j) const { return j >= grains_.size(); }
  const Wall<D>& wall_of(std::size_t j) const { return setup_.walls[j - grains_.size()]; }
  double fly(double end);
  void find_pairs(Nearby& nearby, double margin, double end);
  void take_step();
  void tilt(double middle);
  void note_work();
  Vec<D> unwrapped(std::size_t i) const;
  void account(const Hit<D>& hit);
  void note_touch(const Hit<D>& hit, const Vec<D>& n, const hard::Meeting* train);
  void push_apart(double end);
  void find_overlapping();
  template <class Push>
  void push_pairs_apart(const Push& push);
  template <class Push>
  void push_off_walls(double end, const Push& push);
  void move_apart(std::size_t i, const Vec<D>& way);
  Contact told(std::size_t i, std::size_t j, const Vec<D>& place, const Vec<D>& way,
               const Vec<D>& force) const;
  void show();
  template <class Archive, class Self>
  static void transfer(Archive& archive, Self& self);
};

}  // namespace chute::hybrid
