#pragma once
#include "core/engine.hpp"
#include "core/world.hpp"
#include "theory/stochastic.hpp"

namespace chute::stochastic {

using theory::Hop;
using theory::StochasticModel;
using theory::StochasticWalk;

/// The stochastic model as a run: a ball that hops along the line by StochasticWalk. Its place along the line
/// is the model's. Away from the line the model only knows flights: each begins and ends on the beads' tops,
/// drawn at height R + r, whatever it fell in between. `gravity_work` is what gravity did in the flights, so
/// the account closes; that the model gives the ball falls without a descent of the line is what feeds it at
/// small inclinations.
///
/// The bed is for show: an impact's bead is the nearest. A trapped ball lies still.
class StochasticEngine final : public Engine {
 public:
  /// `grains`: one moving ball, then the bed; its velocity starts the first flight. WorkError if it is not
  /// one ball, or does not move downhill.
  StochasticEngine(World<2> world, const StochasticModel& model, std::uint64_t seed, double tick);

  std::int64_t step() const override { return step_; }
  double time_step() const override { return tick_; }
  GrainsView grains() const override;
  EnergyAccount energy() const override;
  std::vector<Contact> contacts() const override { return {}; }
  void collect_impacts(bool on) override { collecting_ = on; }
  std::vector<Impact> take_impacts() override;
  void save(std::ostream& out) const override;
  void restore(std::istream& in) override;

 private:
  void advance(std::int64_t step) override;

  Grains<2> grains_;
  Domain<2> domain_;
  StochasticModel model_;
  std::uint64_t seed_;
  double tick_, height_ = 0;  ///< of the ball's centre when it touches a bead's top
  StochasticWalk walk_;
  // The flight now: from `place_` (x counted on through the periods) at `begin_` with `velocity_`, until
  // `end_`
  double begin_ = 0, end_ = 0;
  Vec<2> place_{}, velocity_{};
  std::int64_t draws_ = 0, step_ = 0;
  double gravity_work_ = 0, normal_loss_ = 0, shear_loss_ = 0, start_energy_ = 0;
  bool collecting_ = false;
  std::vector<Impact> impacts_;
  TouchLog touches_{1, 0};
  std::array<Array, 2> no_force_;  // none is known between impacts; the ball does not turn either

  Vec<2> gravity() const;
  void next_flight();
  void show();
  Impact impact(const Hop& hop) const;
};

}  // namespace chute::stochastic
