#pragma once
#include <optional>

#include "core/engine.hpp"
#include "core/random.hpp"
#include "core/team.hpp"
#include "core/world.hpp"
#include "engines/monte_carlo/slots.hpp"

namespace chute::monte_carlo {

/// Trial moves are no longer than this part of a period: a place outside of the box is brought back by one period, and
/// grains that lie outside are not found by others.
inline constexpr double longest_part = 0.5;

/// What a shake is: grains are lifted, and then moved until they have come down.
struct Shaking {
  double lift = 0;              ///< all grains, by this length
  double expand = 0;            ///< heights above 0 times 1 + this
  std::int64_t sweeps = 10000;  ///< no more sweeps in a shake than these
  double settled = 0;           ///< it ends when the mean height fell by less than this in settled_sweeps
  static constexpr std::int64_t settled_sweeps = 100;
};

/// What a run needs besides its grains.
template <int D>
struct MonteCarloSetup : Surroundings<D> {
  std::uint64_t seed = 1;
  double temperature = 0;            ///< T, an energy; 0: only moves that do not go up
  double step = 0.1;                 ///< δ, the longest trial move
  std::int64_t equilibrate = 0;      ///< sweeps in which δ adapts to an acceptance of 40 %
  bool serial = false;               ///< grains drawn one by one from all; else block by block
  std::optional<Shaking> shaking{};  ///< a step is a shake; else a sweep
};

/// Hard grains moved by chance, thesis 2.3. A trial move is a displacement drawn evenly from a disc (ball) of radius δ. It
/// is rejected if the grain would overlap another, the bed or a wall, and else accepted with probability min(1, exp(m
/// g·Δr/T)). With T > 0 that is the equilibrium of hard grains under gravity; with T = 0 only moves that do not go up are
/// left, and a shaken medium settles (Rosato et al. 1986, 1987).
///
/// A sweep is one trial a grain. Serial: each of a grain drawn at random. Else by blocks of cells, coloured like a
/// checkerboard: blocks of one colour do not see each other and are worked on side by side, each as often as it has grains,
/// and no grain leaves its block, which keeps detailed balance (Anderson et al. 2013, doi:10.1016/j.jcp.2013.07.023). Where blocks begin and in
/// which order colours come is drawn anew for every sweep. Random numbers belong to sweep and block, so that the number of
/// threads changes nothing.
template <int D>
class MonteCarloEngine final : public Engine {
 public:
  /// WorkError if grains overlap at the start.
  MonteCarloEngine(Grains<D> grains, const MonteCarloSetup<D>& setup, int threads = 1);

  std::int64_t step() const override { return step_; }
  double time_step() const override { return 1; }
  GrainsView grains() const override { return view_of(grains_, no_force_, setup_.domain, time()); }
  EnergyAccount energy() const override;
  std::vector<Contact> contacts() const override { return {}; }
  std::vector<std::pair<std::string, double>> tells() const override;
  void save(std::ostream& out) const override;
  void restore(std::istream& in) override;

  const Grains<D>& state() const { return grains_; }
  double acceptance() const {
    return tried_ > 0 ? static_cast<double>(accepted_) / static_cast<double>(tried_) : 0;
  }
  double trial_length() const { return delta_; }
  /// Of all moving grains' weights, against gravity, from 0 up.
  double potential() const;

 private:
  void advance(std::int64_t step) override;
  void shake();
  void raise();
  void sweep();
  void lay_cells();
  void sweep_serially();
  void sweep_blocks();
  void adapt(double acceptance);
  void check_overlaps(bool at_start);
  double mean_height() const;

  /// A block of cells: along each direction from `first` on `many`, modulo the number of cells.
  struct Block {
    std::array<int, D> first{}, many{};
  };
  Block block_at(std::size_t number, const std::array<int, D>& shift) const;
  bool in_block(const Block& block, const typename Slots<D>::Cell& cell) const;
  bool try_move(std::size_t i, Random& random, const Block* block);
  std::int64_t work_on(const Block& block, std::uint64_t item, std::vector<std::int32_t>& ids);

  MonteCarloSetup<D> setup_;
  Grains<D> grains_;
  Team team_;
  Slots<D> slots_;
  Extent<D> extent_;  // of the grains when cells were laid: blocks follow from it, so it is part of the state
  std::array<int, D> blocks_{};  // along each direction
  double delta_;
  std::int64_t step_ = 0, sweeps_ = 0, accepted_ = 0, tried_ = 0;  // the last two: in the last step
  std::array<Array, D> start_place_, no_force_;
};

}  // namespace chute::monte_carlo
