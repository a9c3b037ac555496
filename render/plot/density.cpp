#include "plot/density.hpp"

#include <algorithm>
#include <cmath>

#include "plot/scale.hpp"

namespace chute::plot {
namespace {

/// Cells of a panel along x and y: about 2 points each in a single column, so that they are seen as areas.
constexpr std::size_t cells_x = 90, cells_y = 66;

struct Side {
  double low, high;
  std::size_t cells;
  bool holds(double v) const { return v >= low && v <= high; }
  std::size_t cell(double v) const {
    return std::min(cells - 1,
                    static_cast<std::size_t>(Span{low, high}.fraction(v) * static_cast<double>(cells)));
  }
  std::vector<double> middles() const {
    std::vector<double> m;
    for (std::size_t k = 0; k < cells; ++k)
      m.push_back(std::lerp(low, high, (static_cast<double>(k) + 0.5) / static_cast<double>(cells)));
    return m;
  }
};

Side side_of(Axis& axis, const std::vector<double>& values, std::size_t cells) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double v : values)
    if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
  low = axis.min.value_or(low), high = axis.max.value_or(high);
  axis.min = low, axis.max = high;  // a map fills its frame
  return {low, high, cells};
}

bool is_crowd(const Panel& panel) {
  return panel.series.size() == 1 && !panel.map && !panel.chains && !panel.right && !panel.top &&
         panel.series[0].kind == Kind::dots && panel.series[0].x.size() > most_dots &&
         panel.x.scale != Scale::log && panel.y.scale != Scale::log;
}

/// One quantity has one range, as elsewhere: here it must be known before cells are made of it.
void share_range(Figure& figure, Axis Panel::*axis, std::vector<double> Series::*values) {
  for (auto& panel : figure.panels) {
    auto& own = panel.*axis;
    if (!is_crowd(panel) || own.label.empty()) continue;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const auto& other : figure.panels) {
      if ((other.*axis).label != own.label) continue;
      for (const auto& s : other.series)
        for (const double v : s.*values)
          if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
    }
    if (!own.min) own.min = low;
    if (!own.max) own.max = high;
  }
}

}  // namespace

void draw_crowd_as_density(Panel& panel) {
  if (!is_crowd(panel)) return;
  auto& dots = panel.series[0];
  const Side x = side_of(panel.x, dots.x, cells_x), y = side_of(panel.y, dots.y, cells_y);
  if (!(x.high > x.low) || !(y.high > y.low)) return;
  Map map;
  map.x = x.middles(), map.y = y.middles();
  map.log = true, map.label = "dots per cell";
  std::vector<double> counts(cells_x * cells_y, 0);
  Series outside = dots;
  outside.x.clear(), outside.y.clear(), outside.x_err.clear(), outside.y_err.clear();
  outside.label = "";
  for (std::size_t i = 0; i < dots.x.size(); ++i) {
    if (!std::isfinite(dots.x[i]) || !std::isfinite(dots.y[i])) continue;
    if (x.holds(dots.x[i]) && y.holds(dots.y[i]))
      counts[y.cell(dots.y[i]) * cells_x + x.cell(dots.x[i])] += 1;
    else
      outside.x.push_back(dots.x[i]), outside.y.push_back(dots.y[i]);
  }
  map.low = 0;  // one dot
  for (const double n : counts) map.values.push_back(n > 0 ? std::log10(n) : unknown);
  panel.map = std::move(map);
  panel.series.clear();
  if (!outside.x.empty()) panel.series.push_back(std::move(outside));
}

void draw_crowds_as_densities(Figure& figure) {
  if (!figure.own_ranges) {
    share_range(figure, &Panel::x, &Series::x);
    share_range(figure, &Panel::y, &Series::y);
  }
  for (auto& panel : figure.panels) draw_crowd_as_density(panel);
}

}  // namespace chute::plot
