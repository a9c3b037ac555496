#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/figure_table.hpp"
#include "common/side_by_side.hpp"
#include "sweep/grid.hpp"

namespace chute::figures {

/// One series made from many runs of a scene: a mean, or a phase boundary, over one parameter. [[data.sweep]]
struct SweepCurve {
  std::string panel, series;
  std::vector<std::string> set;  ///< key=value, on top of the recipe's
  sweep::Axis x;                 ///< the parameter that is x
  enum class Column {
    v_x,            ///< median of the mean velocities of the starts that still move; its error over the seeds
    omega,          ///< mean spin of the steady starts, positive when rolling downhill
    surface_speed,  ///< that times the mean radius, ωR
    AB,             ///< phase boundary as an angle, rad
    BC
  } column = Column::v_x;
  std::vector<double> velocities;               ///< launches, slowest first: the others tell where B ends
  double alike = 0.05;                          ///< how far their medians may lie apart in B
  std::optional<sweep::BoundarySpec> boundary;  ///< AB, BC: along what, of incline.sin or incline.angle
  double scale = 1;                       ///< y times this: a mean in other units, or scaled by a power of Φ
  std::optional<double> quick_tolerance;  ///< AB, BC: of a quick figure
  bool along_sine = false;                ///< AB, BC: drawn as Φ over sin θ, the thesis's way
  bool above_offset = false;              ///< v_x: (v_x − v_0)², with v_0 from a fit of (4.20) in phase B
  std::optional<std::string> offset_of;   ///< v_0 of that series instead of the own one's
};
void describe(TomlReader& a, SweepCurve& curve);
void describe(KeyLister& a, SweepCurve& curve);

/// What all sweeps of a recipe have in common.
struct SweepSetting {
  sweep::Base base;
  std::int64_t seeds = 1;
  bool quick = false;
  int jobs = 1;
  std::filesystem::path points;  ///< folder of the finished points
};

/// Rows of all curves, and comments about them. A point has a mean velocity, and a row, if most of the
/// slowest starts share it: they lie within a tenth of their median, and neither stopped nor left for good.
FigureTable sweep_curves(const std::vector<SweepCurve>& curves, const SweepSetting& setting,
                         const Report& progress);

}  // namespace chute::figures
