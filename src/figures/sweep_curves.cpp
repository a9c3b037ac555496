#include "figures/sweep_curves.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <mutex>
#include <numbers>

#include "common/error.hpp"
#include "common/keys.hpp"
#include "figures/square_root_fit.hpp"
#include "scene/world.hpp"

namespace chute::figures {
namespace {

using namespace std::string_view_literals;
using Column = SweepCurve::Column;
constexpr std::array column_words{"v_x"sv, "omega"sv, "surface_speed"sv, "AB"sv, "BC"sv};

bool is_boundary(const SweepCurve& curve) { return curve.column == Column::AB || curve.column == Column::BC; }

/// One x of one curve: a job.
struct Point {
  const SweepCurve* curve;
  double x;
  std::optional<Estimate> y;  ///< empty: no such value there
  bool in_B = false;
  std::optional<Estimate> apart{};  ///< instead: the median of starts that do not share one mean velocity
  std::string dropped{};            ///< why there is none
};

/// A boundary along the inclination as an angle θ.
Estimate as_angle(const sweep::Axis& axis, const Estimate& e) {
  if (axis.key == "incline.sin") return {std::asin(e.mean), *e.error / std::sqrt(1 - e.mean * e.mean)};
  const double unit = axis.unit == "deg" ? std::numbers::pi / 180 : 1;
  return {e.mean * unit, *e.error * unit};
}

class Sweeps {
 public:
  explicit Sweeps(const SweepSetting& setting) : setting_(setting), store_(setting.points) {}

  void measure(Point& point, const Report& progress) const {
    const auto& curve = *point.curve;
    const auto base = setting_.base.with(curve.set).with({curve.x.setting(point.x)});
    if (is_boundary(curve)) {
      auto spec = *curve.boundary;
      if (setting_.quick) spec.tolerance = curve.quick_tolerance.value_or(spec.tolerance);
      const bool ab = curve.column == Column::AB;
      const auto found = sweep::boundaries_of(base, spec, ab ? sweep::Wanted::AB : sweep::Wanted::both,
                                              setting_.seeds, store_, progress);
      if (const auto& angle = ab ? found.AB : found.BC) point.y = as_angle(spec.axis, *angle);
      return;
    }
    const auto launches = sweep::launches_of(base, curve.velocities, setting_.seeds, store_, progress);
    const auto& slow = launches.front();
    if (2 * slow.together <= slow.starts) return drop(point, slow);
    point.in_B = sweep::phase_of(launches, curve.alike) == sweep::Phase::B;
    if (curve.column == Column::v_x) {
      point.y = slow.median;
      if (const auto error = over_seeds(base, curve, progress)) point.y->error = error;
    } else if (slow.count(measure::Verdict::steady) > 0) {
      const double R =
          curve.column == Column::surface_speed ? scene::setting_of(base.scene({})).mean_diameter / 2 : 1;
      point.y = slow.omega;
      point.y->mean *= R;
      if (point.y->error) *point.y->error *= R;
    }
  }

 private:
  const SweepSetting& setting_;
  sweep::PointStore store_;

  /// A place where most starts do not share one mean velocity has none; what they do instead is told, and where they go on
  /// at different velocities, at a transition, their median is shown apart.
  static void drop(Point& point, const sweep::Tally& slow) {
    using measure::Verdict;
    const auto stopped = slow.count(Verdict::stopped),
               left = slow.count(Verdict::accelerating) + slow.count(Verdict::runaway);
    point.dropped = fmt::format("{} of {} starts stopped, {} accelerate, {} share one velocity", stopped,
                                slow.starts, left, slow.together);
    const bool goes_on = 2 * stopped < slow.starts && 2 * left < slow.starts;
    if (point.curve->column == Column::v_x && goes_on && std::isfinite(slow.median.mean))
      point.apart = slow.median;
  }

  /// The error of the median from one seed, such as one bed, to the next; empty if there is only one.
  std::optional<double> over_seeds(const sweep::Base& base, const SweepCurve& curve,
                                   const Report& progress) const {
    if (setting_.seeds < 2 || !curve.velocities.empty()) return {};
    std::vector<double> medians;
    for (std::int64_t seed = 1; seed <= setting_.seeds; ++seed) {
      const auto followed = store_.get(base.scene({fmt::format("seed={}", seed)}), progress);
      if (const double v = sweep::tally(followed.starts).median.mean; std::isfinite(v)) medians.push_back(v);
    }
    return estimate_of(medians).error;
  }
};

/// v_0 of (4.20) for the named series of a panel. WorkError if fewer than three of its points lie in B.
SquareRootFit offset_fit(const std::vector<Point>& points, const std::string& panel,
                         const std::string& series) {
  std::vector<double> s, v;
  for (const auto& p : points)
    if (p.curve->series == series && p.curve->panel == panel && p.in_B && p.y)
      s.push_back(p.x), v.push_back(p.y->mean);
  if (s.size() < 3)
    throw WorkError(
        fmt::format("series {}: {} points in phase B are too few for the offset v_0", series, s.size()));
  return fit_square_root(s, v);
}

}  // namespace

template <class Archive>
static void describe_keys(Archive& a, SweepCurve& curve) {
  a.value("panel", curve.panel, "of the series");
  a.required("series", curve.series, "its name");
  a.value("set", curve.set, "key=value for its scene, on top of the recipe's");
  a.required_section("x", curve.x);
  a.choice("column", curve.column, column_words, "means over starts, or boundaries of phases");
  a.value("velocities", curve.velocities, "launches, slowest first");
  a.value("alike", curve.alike, Range{0, 1, true, true}, "how far their medians may lie apart in B");
  a.section("boundary", curve.boundary);
  a.value("scale", curve.scale, positive, "y times this");
  a.value("along_sine", curve.along_sine, "AB, BC: drawn over sin θ");
  a.value("quick_tolerance", curve.quick_tolerance, positive, "AB, BC: of a quick figure");
  a.value("above_offset", curve.above_offset, "v_x: (v_x − v_0)², with v_0 from a fit of (4.20) in phase B");
  a.value("offset_of", curve.offset_of, "v_0 of that series instead of the own one's");
}
void describe(KeyLister& a, SweepCurve& curve) { describe_keys(a, curve); }
void describe(TomlReader& a, SweepCurve& curve) {
  describe_keys(a, curve);
  a.check(!curve.along_sine || is_boundary(curve), "along_sine", "is of boundaries: AB, BC");
  a.check(!curve.quick_tolerance || is_boundary(curve), "quick_tolerance", "is of boundaries: AB, BC");
  a.check(is_boundary(curve) == curve.boundary.has_value(), "boundary",
          "AB and BC, and only they, say along which parameter: boundary = { axis = …, tolerance = … }");
  a.check(!curve.boundary || curve.boundary->axis.key == "incline.sin" ||
              curve.boundary->axis.key == "incline.angle",
          "boundary", "figures show boundaries along incline.sin or incline.angle");
  a.check(!curve.above_offset || curve.column == Column::v_x, "above_offset", "needs column = \"v_x\"");
}

FigureTable sweep_curves(const std::vector<SweepCurve>& curves, const SweepSetting& setting,
                         const Report& progress) {
  std::vector<Point> points;
  for (const auto& curve : curves)
    for (const double x : curve.x.points(setting.quick)) {
      points.push_back({&curve, x, {}});
      setting.base.with(curve.set)
          .with({curve.x.setting(x)})
          .scene({});  // refused before anything is simulated
    }
  const Sweeps sweeps(setting);
  side_by_side(points.size(), setting.jobs, progress,
               [&](std::size_t k, const Report& report) { sweeps.measure(points[k], report); });

  FigureTable table;
  for (const auto& curve : curves) {
    double v_0 = 0;
    if (curve.above_offset) {
      const auto fit = offset_fit(points, curve.panel, curve.offset_of.value_or(curve.series));
      v_0 = fit.v_0;
      table.comments.push_back(fmt::format(
          "{} {}: v_0 = {:.5g} from a fit of (4.20) to {} in phase B, f = {:.4g}, sin theta_AB = {:.4g}",
          curve.panel, curve.series, v_0, curve.offset_of.value_or(curve.series), fit.f, fit.s_AB));
    }
    for (const auto& p : points) {
      if (p.curve != &curve) continue;
      if (!p.y && !is_boundary(curve))
        table.comments.push_back(fmt::format(
            "{}{} at {}: {}{}", curve.panel.empty() ? "" : curve.panel + " ", curve.series, p.x,
            p.dropped.empty() ? "no steady start" : p.dropped,
            p.apart ? fmt::format("; their median stands as {} apart", curve.series) : "; no row"));
      if (!p.y && is_boundary(curve))
        table.comments.push_back(fmt::format("{}{} at {}: no boundary within the range, no row",
                                             curve.panel.empty() ? "" : curve.panel + " ", curve.series,
                                             p.x));
      if (!p.y && !p.apart) continue;
      auto y = p.y ? *p.y : *p.apart;
      const std::string series = curve.series + (p.y ? "" : " apart");
      if (curve.above_offset) {
        const double above = y.mean - v_0;
        y = {above * above, y.error ? std::optional(2 * std::abs(above) * *y.error) : std::nullopt};
      }
      y.mean *= curve.scale;
      if (y.error) *y.error *= curve.scale;
      if (curve.along_sine) {
        const auto error = y.error ? std::optional(*y.error * std::cos(y.mean)) : std::nullopt;
        table.rows.push_back({curve.panel, series, std::sin(y.mean), p.x, error, {}});
      } else {
        table.rows.push_back({curve.panel, series, p.x, y.mean, {}, y.error});
      }
    }
  }
  return table;
}

}  // namespace chute::figures
