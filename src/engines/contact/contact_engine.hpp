#pragma once
#include <memory>

#include "core/engine.hpp"
#include "engines/contact/impacts.hpp"
#include "engines/contact/projection.hpp"
#include "engines/contact/step_problem.hpp"
#include "search/neighbour_list.hpp"

namespace chute::contact {

/// How the solver did, over all steps.
struct SolverRecord {
  std::int64_t steps = 0, iterations = 0, most_iterations = 0;
  std::int64_t unconverged = 0;  ///< steps that used up their iterations
  double worst_residual = 0;
  std::int64_t last_iterations = 0;
  double last_residual = 0;

  void add(const Convergence& step);
  template <class Archive>
  void serialize(Archive& a) {
    a(steps, iterations, most_iterations, unconverged, worst_residual, last_iterations, last_residual);
  }
};

/// Contact dynamics, thesis 2.2: rigid grains; the forces between them are those that keep them from overlapping, and
/// obey Coulomb's relation (2.32) with a static and a dynamic coefficient. Where the thesis solves for accelerations
/// between changes of the contacts, this method steps in time at the level of velocities (Moreau 1994, Jean 1999; θ = 1/2),
/// so that contacts may come and go within a step, and all impulses come out of one problem.
///
/// A step of length h: half of the way → who touches → impacts → the problem of all contacts → the other half of the
/// way → what still overlaps is moved apart, places only → account.
template <int D>
class ContactEngine final : public Engine {
 public:
  ContactEngine(Grains<D> grains, const ContactSetup<D>& setup);
  ContactEngine(const ContactEngine&) = delete;  // its parts refer to each other
  ContactEngine& operator=(const ContactEngine&) = delete;

  std::int64_t step() const override { return step_; }
  double time_step() const override { return setup_.time_step; }
  GrainsView grains() const override;
  EnergyAccount energy() const override;
  /// What pressed each other in the last step, with the forces that its impulses were on average.
  std::vector<Contact> contacts() const override;
  void collect_impacts(bool on) override { collecting_ = on; }
  std::vector<Impact> take_impacts() override { return std::exchange(impacts_, {}); }
  std::vector<std::pair<std::string, double>> tells() const override;
  void save(std::ostream& out) const override;
  void restore(std::istream& in) override;

  const Grains<D>& state() const { return grains_; }
  const SolverRecord& record() const { return record_; }
  /// All that touched or might have done so in the last step.
  const std::vector<Touching<D>>& touching() const { return touching_; }

 private:
  void advance(std::int64_t step) override;

  ContactSetup<D> setup_;
  Grains<D> grains_;
  Grains<D> grown_;  // in the middle of the step, larger by half of the margin
  search::NeighbourList<D> list_;
  search::PairNames pairs_;
  Bodies<D> bodies_;
  std::vector<Touching<D>> touching_, last_;  // ordered by i, then j; in this step and in the one before
  WaltonImpacts<D> walton_;
  StepProblem<D> problem_;
  Projection<D> projection_;
  TouchLog touches_;
  std::array<Array, D> start_place_, force_;
  EnergyAccount account_;
  SolverRecord record_;
  std::int64_t step_ = 0;
  double deepest_ = 0;             // overlap of the last step
  std::vector<Struck<D>> struck_;  // Walton's impacts in this step
  std::vector<unsigned char> struck_grains_;
  bool collecting_ = false;
  std::vector<Impact> impacts_;
  std::unique_ptr<Team> team_;

  bool moves(std::size_t j) const { return j < grains_.moving; }
  bool is_wall(std::size_t j) const { return j >= grains_.size(); }
  const Wall<D>& wall_of(std::size_t j) const { return setup_.walls[j - grains_.size()]; }
  void take_step();
  void fly_half();
  void find_touching(double middle);
  void remember(Touching<D>& t, std::size_t& at) const;
  void measure(Touching<D>& t, double middle) const;
  void bounce(double begin, const Vec<D>& gravity);
  void arrive(const Vec<D>& gravity);
  void push_apart(double end, const Vec<D>& gravity);
  void note_touches(double begin);
  void note_impact(const Touching<D>& t, double time, const Vec<D>& velocity);
  Contact told(const Touching<D>& t) const;
  void show();
  template <class Archive, class Self>
  static void transfer(Archive& archive, Self& self);
};

}  // namespace chute::contact
