#pragma once
#include <optional>

#include "core/random.hpp"
#include "engines/restructuring/columns.hpp"

namespace chute::restructuring {

/// A circle that the grains are in, seen from the side: a drum. The grains' centres are within its radius less their own.
struct Drum {
  Vec<2> centre{};
  double radius = 0;
  double steepest = 0;  ///< slope, as a tangent, up to which the wall alone holds a grain: its friction
};

/// What bounds the room in which grains are laid.
struct Bounds {
  double floor = -std::numeric_limits<double>::infinity();  ///< height of a plane; −infinity: there is none
  std::optional<Drum> drum{};                               ///< in the plane
};

/// Where a grain came to rest.
template <int D>
struct Rest {
  Vec<D> place{};
  std::array<std::int32_t, D> supports{};  ///< ids of those that it lies on; the drum's is Placer::drum_id
  int count = 0;                           ///< how many they are
  bool on_floor = false;
  int events = 0;  ///< contacts made and lost on the way
};

/// Lays one grain on those that lie already (Visscher & Bolsterli 1972, doi:10.1038/239504a0; Jullien & Meakin 1987). It
/// falls, and then follows the path of steepest descent over them until it is stable or on the floor. The path is a chain
/// of arcs, each about one grain or, in space, about the line through two, and all are solved for: nothing is stepped.
///
/// Which grains it rolls on is the projection of "straight down" onto the directions v that its contacts allow, v·n_i ≥ 0:
/// v = −z + Σ λ_i n_i with λ_i ≥ 0, and v·n_i = 0 for those with λ_i > 0. Subsets of the contacts are tried, the
/// smallest first. None: it falls; D of them: it is stable.
template <int D>
class Placer {
 public:
  /// Lays grains over these, within the bounds. In space there are no drums.
  Placer(const Columns<D>& columns, const Bounds& bounds) : columns_(columns), bounds_(bounds) {}

  /// Stands for the drum among what a grain touches.
  static constexpr std::int32_t drum_id = -1;

  /// More events than this for one grain are an error: a path has about five.
  static constexpr int most_events = 10000;

  /// The rest of a grain that falls at this lateral place, from above all others or from this height. Empty if there is
  /// nothing to fall on, no room left in the drum, or no rest within most_events. `random` decides where the way down is not unique, as exactly on
  /// top of a grain.
  std::optional<Rest<D>> place(const Vec<D>& lateral, double radius, Random& random,
                               double from = std::numeric_limits<double>::infinity());

 private:
  /// One that the grain touches now.
  struct Touching {
    Placed<D> grain;
    Vec<D> normal{};  // from it to the moving grain
    bool rolling = false;
    bool is_drum() const { return grain.id == drum_id; }
  };
  /// A point of an arc, by the angle from its begin, in [0, π).
  struct Turn {
    double sin = 0, cos = 1;
    bool before(const Turn& other) const { return sin * other.cos < other.sin * cos; }
  };
  /// From `centre` + ρ `from` towards ρ `ahead`.
  struct Arc {
    Vec<D> centre{}, from{}, ahead{};
    double radius = 0;
    Vec<D> direction(const Turn& t) const { return t.cos * from + t.sin * ahead; }
    Vec<D> at(const Turn& t) const;
  };
  enum class Entry { free, wedged, full };
  enum class Next { fall, roll, stable };
  enum class End { equator, held, loses_first, loses_second, floor, contact };

  const Columns<D>& columns_;
  Bounds bounds_;
  // The grain on its way
  Vec<D> place_{};
  double radius_ = 0;
  std::vector<Touching> touching_;
  std::array<std::size_t, 2> on_{};  // which of them it rolls on
  int rolls_on_ = 0;
  Vec<D> down_{};  // direction of the way

  double reach(const Placed<D>& grain) const { return radius_ + grain.radius; }
  /// How far from the drum's middle the grain's centre may be.
  double room() const { return bounds_.drum->radius - radius_; }
  Placed<D> drum() const;
  bool held_by_drum(const Vec<D>& normal) const;
  bool touches(const Placed<D>& grain) const;
  bool fall(double from);
  Entry enter_drum(double& from);
  double drum_below() const;
  Next choose(const Touching* lost, Random& random);
  bool allowed(const Vec<D>& v, std::initializer_list<std::size_t> among, const Touching* lost,
               double slack) const;
  bool nudge(Random& random);
  Arc arc() const;
  std::optional<Turn> root(double a, double b, double c) const;
  std::optional<Turn> meeting(const Arc& arc, const Placed<D>& grain) const;
  static std::optional<Turn> meeting_again(double a, double b);
  std::optional<Turn> meeting_drum(const Arc& arc) const;
  Turn own_end(const Arc& arc, End& end) const;
  Rest<D> rest(bool on_floor, int events) const;
};

}  // namespace chute::restructuring
