#pragma once
#include <array>
#include <span>

#include "core/engine.hpp"
#include "core/world.hpp"
#include "engines/restructuring/placing.hpp"

namespace chute::restructuring {

/// Where new grains come from in the first shake.
enum class Rain { none, line, point };

/// What loosens a packing before it is laid anew (Mehta & Barker, PRL 67, 394, 1991): heights are stretched, and then grains
/// move at random, sideways and down but never up, as in the Monte Carlo method without a temperature, until the packing
/// is as dense as asked or has moved so often. The random shifts sideways that the paper makes with the expansion are among
/// these moves.
struct Loosening {
  double expand = 0;         ///< ε: heights above 0 times 1 + ε
  double density = 1;        ///< the moves end at this packing fraction of the bulk …
  std::int64_t sweeps = 50;  ///< … or after so many sweeps, each of one trial a grain
  double step = 0.1;         ///< the longest trial move; a length
};

/// Whom a grain lies on when it is laid: those that lie already; or all others where they are now, so that it can rest on
/// one that goes on later (the last stage of Mehta & Barker), and what was no arch before can become one.
enum class Stabilise { sequential, cooperative };

/// What a run needs besides its grains.
template <int D>
struct RestructuringSetup : Surroundings<D> {
  std::uint64_t seed = 1;
  Rain rain = Rain::none;
  double jolt = 0;  ///< largest lateral shift of a grain in each direction before it falls; a length
  double turn =
      0;  ///< by which all grains turn about the drum's middle before every shake but the first; anticlockwise
  std::optional<Loosening> loosening{};         ///< before every shake but the first
  Stabilise stabilise = Stabilise::sequential;  ///< from the second shake on
};

/// Bottom-to-top restructuring, thesis 2.3: in every shake all grains are taken up and laid again one by one, in the order
/// of their heights. Each keeps its lateral place, up to a random jolt, and goes down the steepest way over those that lie
/// already; higher ones do not matter to it. There is no time, no force and no arch: a step is a shake.
///
/// In the plane they may lie in a drum (Baumann, Jánosi & Wolf, Phys. Rev. E 51, 1879 (1995)), which before each shake turns
/// with all that is in it. Where its wall is no steeper than its friction allows, it holds a grain as a floor does; where it
/// is steeper, grains roll down along it.
template <int D>
class RestructuringEngine final : public Engine {
 public:
  /// WorkError if there is a wall that is neither a level floor nor, alone and in the plane, a drum.
  RestructuringEngine(Grains<D> grains, const RestructuringSetup<D>& setup);

  std::int64_t step() const override { return step_; }
  double time_step() const override { return 1; }
  GrainsView grains() const override { return view_of(grains_, no_force_, setup_.domain, time()); }
  EnergyAccount energy() const override;
  /// Each grain with those that it was laid on.
  std::vector<Contact> contacts() const override;
  std::vector<std::pair<std::string, double>> tells() const override;
  void save(std::ostream& out) const override;
  void restore(std::istream& in) override;

  const Grains<D>& state() const { return grains_; }
  /// What a grain was laid on: ids, or wall_id(0) for the floor.
  std::span<const std::int64_t> supports(std::size_t grain) const {
    return {supports_[grain].id.data(), static_cast<std::size_t>(supports_[grain].count)};
  }

 private:
  void advance(std::int64_t step) override;
  void shake();
  void turn();
  void loosen();
  void lay(std::size_t i, double from);
  bool still_touch(double way, double reach) const;
  void add_drum(std::vector<std::pair<std::string, double>>& list) const;

  struct Supports {
    std::array<std::int64_t, D + 1> id{};
    int count = 0;
    template <class Archive>
    void serialize(Archive& archive) {
      archive(id, count);
    }
  };

  RestructuringSetup<D> setup_;
  Grains<D> grains_;
  std::size_t wall_ = 0;  // which of the walls bears grains
  Bounds bounds_;
  Columns<D> columns_;
  Placer<D> placer_;
  std::vector<Supports> supports_;
  std::array<Array, D> start_place_, no_force_;
  std::int64_t step_ = 0, events_ = 0;  // events of the last shake
  double loosened_ =
      std::numeric_limits<double>::quiet_NaN();  // φ before grains were laid, in the last shake
};

}  // namespace chute::restructuring
