#include "plot/extents.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/error.hpp"
#include "plot/cells.hpp"
#include "plot/map.hpp"

namespace chute::plot {

std::vector<double> bin_edges(const std::vector<double>& x) {
  std::vector<double> edges;
  const std::size_t n = x.size();
  if (n == 0) return {};
  if (n == 1) return {x[0] - 0.5, x[0] + 0.5};
  for (std::size_t i = 0; i + 1 < n; ++i) {
    if (i == 0) edges.push_back(1.5 * x[0] - 0.5 * x[1]);
    edges.push_back((x[i] + x[i + 1]) / 2);
  }
  if (n > 1) edges.push_back(1.5 * x[n - 1] - 0.5 * x[n - 2]);
  return edges;
}

namespace {

void check_lengths(const Series& s) {
  const auto wrong = [&](const char* column) {
    throw InputError(fmt::format("series \"{}\": {} has another length than x", s.name, column));
  };
  if (s.y.size() != s.x.size()) wrong("y");
  if (!s.x_err.empty() && s.x_err.size() != s.x.size()) wrong("x_err");
  if (!s.y_err.empty() && s.y_err.size() != s.x.size()) wrong("y_err");
}

const Axis& x_axis_of(const Plot& plot, const Series& s) { return s.top && plot.top ? *plot.top : plot.x; }
const Axis& y_axis_of(const Plot& plot, const Series& s) {
  return s.right && plot.right ? *plot.right : plot.y;
}

/// What the series asks of the axes; what a given range of either axis hides asks for nothing.
void include_series(Extents& e, const Plot& plot, const Series& s) {
  const bool bins = has_bins(s.kind);
  const Axis &along_x = x_axis_of(plot, s), &along_y = y_axis_of(plot, s);
  Extent &ex = s.top && plot.top ? e.top : e.x, &ey = s.right && plot.right ? e.right : e.y;
  const auto mark = has_markers(s.kind)    ? Extent::Mark::marker
                    : s.kind == Kind::dots ? Extent::Mark::dot
                                           : Extent::Mark::none;
  const auto shown = [](const Axis& axis, double v) {
    return std::isfinite(v) && (axis.scale == Scale::linear || v > 0) && !(axis.min && v < *axis.min) &&
           !(axis.max && v > *axis.max);
  };
  const auto include_error = [](Extent& extent, const Axis& axis, double v, double error) {
    if (!(error > 0)) return;
    extent.include(v - error, axis.scale);
    extent.include(v + error, axis.scale);
  };
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    if (!shown(along_x, s.x[i]) || !shown(along_y, s.y[i])) continue;
    ex.include(s.x[i], along_x.scale, mark);
    ey.include(s.y[i], along_y.scale, mark);
    if (s.kind == Kind::line || s.kind == Kind::dots || s.kind == Kind::cells) continue;
    include_error(ey, along_y, s.y[i], error_at(s.y_err, i));
    if (!bins) include_error(ex, along_x, s.x[i], error_at(s.x_err, i));
  }
  if (bins) {
    ey.from_zero = along_y.scale == Scale::linear;
    for (double edge : bin_edges(s.x)) ex.include(edge, along_x.scale);
  }
}

/// Points that are not vouched for stretch an axis by so much of its length at most; those farther off become arrows at the frame.
constexpr double doubtful_reach = 0.3;

bool is_near(const Extent& extent, const Axis& axis, double value) {
  if (extent.low > extent.high) return true;
  if (axis.scale == Scale::log && value <= 0) return false;
  if (extent.low == extent.high) return value == extent.low;
  const double at = Span{extent.low, extent.high, axis.scale}.fraction(value);
  return at >= -doubtful_reach && at <= 1 + doubtful_reach;
}

}  // namespace

Extents extents_of(const Plot& plot) {
  Extents e;
  e.y.keep_off = e.right.keep_off = true;
  const bool all_doubtful = std::all_of(plot.series.begin(), plot.series.end(),
                                        [](const Series& s) { return is_doubtful(s.name) || s.x.empty(); });
  for (const auto& s : plot.series) {
    check_lengths(s);
    if (all_doubtful || !is_doubtful(s.name)) include_series(e, plot, s);
  }
  if (!all_doubtful) {
    const Extents sure = e;
    for (const auto& s : plot.series) {
      if (!is_doubtful(s.name)) continue;
      Series near = s;  // its points alone: errors of what is in doubt stretch nothing
      near.x.clear(), near.y.clear(), near.x_err.clear(), near.y_err.clear();
      for (std::size_t i = 0; i < s.x.size(); ++i)
        if (is_near(s.top && plot.top ? sure.top : sure.x, x_axis_of(plot, s), s.x[i]) &&
            is_near(s.right && plot.right ? sure.right : sure.y, y_axis_of(plot, s), s.y[i]))
          near.x.push_back(s.x[i]), near.y.push_back(s.y[i]);
      include_series(e, plot, near);
    }
  }
  // a line that runs along the lower edge for long would not be seen there: it asks for room as markers do
  for (const auto& s : plot.series) {
    if (s.kind != Kind::line) continue;
    Extent& ey = s.right && plot.right ? e.right : e.y;
    const double edge = std::lerp(ey.low, ey.high, 0.01);
    const auto there = std::count_if(s.y.begin(), s.y.end(), [&](double y) { return y < edge; });
    if (there > 2 && 5 * static_cast<std::size_t>(there) > s.y.size())
      ey.dot_low = std::min(ey.dot_low, ey.low);
  }
  if (plot.map) {
    for (const double x : cell_edges(plot.map->x, plot.x.scale)) e.x.include(x, plot.x.scale);
    for (const double y : cell_edges(plot.map->y, plot.y.scale)) e.y.include(y, plot.y.scale);
  }
  if (const auto grid = cell_grid(plot); !grid.empty()) {
    for (const double x : cell_edges(grid.x, plot.x.scale)) e.x.include(x, plot.x.scale);
    for (const double y : cell_edges(grid.y, plot.y.scale)) e.y.include(y, plot.y.scale);
  }
  if (plot.chains) {
    for (const double x : plot.chains->x) e.x.include(x, plot.x.scale);
    for (const double y : plot.chains->y) e.y.include(y, plot.y.scale);
  }
  for (const auto& r : plot.references) {
    if (r.kind == Reference::Kind::horizontal) e.y.include(r.at, plot.y.scale);
    if (r.kind == Reference::Kind::vertical) e.x.include(r.at, plot.x.scale);
  }
  return e;
}

}  // namespace chute::plot
