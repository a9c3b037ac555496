#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/toml_reader.hpp"

namespace chute {
class KeyLister;
}
namespace chute::sweep {

/// One parameter of the grid: a key of the scene and its values.
struct Axis {
  std::string key;             ///< dotted: incline.sin
  std::vector<double> values;  ///< given, or `count` of them evenly from `from` to `to`
  double from = 0, to = 0;
  std::int64_t count = 0;
  std::optional<std::int64_t> quick_count;  ///< `count` of a quick figure
  std::string unit;  ///< put after each value: incline.angle has "deg". Empty: plain numbers

  std::vector<double> points(bool quick = false) const;
  /// What the scene is set to at one of them: key=value.
  std::string setting(double value) const;
};
void describe(TomlReader& a, Axis& axis);
void describe(TomlWriter& a, Axis& axis);
void describe(KeyLister& a, Axis& axis);

/// Which angles of the incline bound the phases: A, where grains stop; B, where they reach a steady velocity;
/// C, where they do not (thesis 4.1).
struct BoundarySpec {
  Axis axis;             ///< the parameter that is bisected: its range; `count` values are looked at first
  double tolerance = 0;  ///< boundaries are found to plus or minus half of this
  std::vector<double> velocities;  ///< grains.start.velocity, slowest first; B needs them to end alike
  double alike = 0.05;             ///< relative difference of median velocities that counts as alike
};
void describe(TomlReader& a, BoundarySpec& spec);
void describe(TomlWriter& a, BoundarySpec& spec);
void describe(KeyLister& a, BoundarySpec& spec);

/// [sweep] of a scene: a grid of its keys, repeated seeds, and perhaps phase boundaries along one more key.
struct SweepSpec {
  std::vector<Axis> axes;
  std::int64_t seeds = 1;  ///< 1, 2, …
  std::optional<BoundarySpec> boundary;
};
void describe(TomlReader& a, SweepSpec& spec);
void describe(TomlWriter& a, SweepSpec& spec);

}  // namespace chute::sweep
