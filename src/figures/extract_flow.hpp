#pragma once
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "common/figure_table.hpp"
#include "figures/data_recipe.hpp"

/// What figures of dense flows take from runs: numbers that each run is known by, one against the other, and maps over height
/// and time.
namespace chute::figures {

/// What several runs tell at x. Their times are steps times the step, which is each run's own: what all tell at t = 3 stands at
/// 2.9999999999999996 in one of them.
template <class Values>
Values& at_same(std::map<double, Values>& at, double x) {
  constexpr double same = 1e-9;
  const double slack = same * std::max(1.0, std::abs(x));
  const auto known = at.lower_bound(x - slack);
  return known != at.end() && known->first <= x + slack ? known->second : at[x];
}

/// One number of a run: of its bulk, which is what lies between `bulk[0]` and `bulk[1]` of the height of the flow, the mean over
/// the layers of profiles.csv of
///   `phi`         η_exact, the part of the space that grains fill,
///   `mu`          |σ_xz|/σ_zz (in the plane |σ_xy|/σ_yy), kinetic and contact stress together,
///   `shear_rate`  |dv_x/dh|,
///   `inertial_number`  I = γ̇ d/√(P/ρ_s) in space (Jop, Forterre & Pouliquen 2006), γ̇ √(m/P) in the plane (da Cruz et al. 2005)
///                 with d, m and ρ_s of a mean grain and P = σ_zz (σ_yy);
/// of the whole flow
///   `height`      above the centres of the bed, where η falls below half of its largest value,
///   `surface_speed`  v_x of the highest layer below that,
///   `start_angle`, `stop_angle`  degrees, of an incline that was tilted (run.json),
///   `discharge`   grains per time that run out: the slope of discharge.csv between a fifth and four fifths of what had run out in
///                 the end (least squares),
///   `acceleration`  of mean v_x, the slope of series.csv (least squares),
///   `speed`       mean v_x over the series' second half,
///   `seconds`     of the clock that a unit of time took,
///   `tan_theta`   of the incline;
/// or else the number at a key of its scene, such as `grains.count`, or the difference of two, `wall[2].from[0] - wall[1].to[0]`. NaN where the run does not tell.
double number_of_run(const std::string& what, const Curve& curve, const std::filesystem::path& run);

/// One point: `column` against `against`, each the mean over the runs, with the error over them.
std::vector<FigureRow> state(const Curve& curve, std::span<const std::filesystem::path> runs);

/// A column of history.csv against time, one series a height: `NAME h=H`, averaged over the runs.
std::vector<FigureRow> history(const Curve& curve, std::span<const std::filesystem::path> runs);

}  // namespace chute::figures
