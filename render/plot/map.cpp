#include "plot/map.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plot/axes.hpp"
#include "plot/level_lines.hpp"
#include "plot/scale.hpp"

namespace chute::plot {
namespace {

// clang-format off
/// Matplotlib's viridis (CC0) at tenths.
constexpr std::array<std::uint32_t, 11> viridis{0x440154, 0x482475, 0x414487, 0x355f8d, 0x2a788e, 0x21918c,
                                                0x22a884, 0x44bf70, 0x7ad151, 0xbddf26, 0xfde725};
/// ColorBrewer's RdBu in eleven classes, from blue to red.
constexpr std::array<std::uint32_t, 11> rdbu{0x053061, 0x2166ac, 0x4393c3, 0x92c5de, 0xd1e5f0, 0xf7f7f7,
                                             0xfddbc7, 0xf4a582, 0xd6604d, 0xb2182b, 0x67001f};
// clang-format on

/// Colours that a map has: more than the eye tells apart, and few enough that all cells of one are one item.
constexpr int levels = 96;

/// Cells overlap by this much, in points, so that no seam shows between them.
constexpr double overlap = 0.25;

/// The bar, in heights of its numbers: away from the frame, and wide.
constexpr double bar_gap = 0.8, bar_thickness = 1.0;

double level_of(double value, const MapRange& range) {
  return std::clamp(Span{range.low, range.high}.fraction(value), 0.0, 1.0);
}

/// What the bar's ends mean: of logarithms, what they are of.
Span span_of_bar(const Map& map) {
  const auto range = range_of(map);
  if (map.log) return {std::pow(10, range.low), std::pow(10, range.high), Scale::log};
  return {range.low, range.high, Scale::linear};
}

struct Bar {
  Ticks ticks;
  std::vector<TextBox> texts;
  TextBox label, factor;
  double numbers = 0;  // their width
  Bar(const Look& look, const Map& map, double height) {
    ticks = ticks_for(span_of_bar(map), height, look.tick_size, false);
    for (const auto& tick : ticks.major) {
      texts.push_back(set_text(tick.label, look.tick_size));
      numbers = std::max(numbers, texts.back().width);
    }
    if (!ticks.factor.empty()) factor = set_text(ticks.factor, look.tick_size);
    if (!map.label.empty()) label = set_to_fit(map.label, look.label_size, height);
  }
};

}  // namespace

Color map_color(double t, bool diverging) {
  const auto& stops = diverging ? rdbu : viridis;
  const double at = std::clamp(t, 0.0, 1.0) * (stops.size() - 1);
  const auto k = std::min(stops.size() - 2, static_cast<std::size_t>(at));
  const Color a = Color::hex(stops[k]), b = Color::hex(stops[k + 1]);
  const double f = at - static_cast<double>(k);
  return {a.r + f * (b.r - a.r), a.g + f * (b.g - a.g), a.b + f * (b.b - a.b), 1};
}

MapRange range_of(const Map& map) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double v : map.values)
    if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
  if (!(high >= low)) low = 0, high = 1;
  if (map.diverging) high = std::max(std::abs(low), std::abs(high)), low = -high;
  low = map.low.value_or(low), high = map.high.value_or(high);
  if (!(high > low)) high = low + (low == 0 ? 1 : std::abs(low));
  return {low, high};
}

std::vector<double> cell_edges(const std::vector<double>& middles, Scale scale) {
  std::vector<double> edges;
  if (scale == Scale::log) {
    for (const double m : middles) edges.push_back(std::log10(m));
    edges = cell_edges(edges);
    for (double& e : edges) e = std::pow(10, e);
    return edges;
  }
  const std::size_t n = middles.size();
  if (n == 1) return {middles[0] - 0.5, middles[0] + 0.5};
  edges.push_back(1.5 * middles[0] - 0.5 * middles[1]);
  for (std::size_t i = 0; i + 1 < n; ++i) edges.push_back(0.5 * (middles[i] + middles[i + 1]));
  edges.push_back(1.5 * middles[n - 1] - 0.5 * middles[n - 2]);
  return edges;
}

void draw_map(DisplayList& list, const Frame& frame, const Map& map) {
  if (map.filled > 0) return draw_bands(list, frame, map);
  const auto range = range_of(map);
  const auto ex = cell_edges(map.x, frame.x.scale), ey = cell_edges(map.y, frame.y.scale);
  // Cells of one colour are one path: rectangles along a row that have it are joined.
  std::vector<Path> of_level(levels);
  for (std::size_t j = 0; j < map.y.size(); ++j)
    for (std::size_t i = 0; i < map.x.size();) {
      const auto level = [&](std::size_t at) {
        const double v = map.values[j * map.x.size() + at];
        return std::isfinite(v) ? std::min(levels - 1, static_cast<int>(level_of(v, range) * levels)) : -1;
      };
      const int own = level(i);
      std::size_t end = i + 1;
      while (end < map.x.size() && level(end) == own) ++end;
      if (own >= 0) {
        const Point a = frame.at(ex[i], ey[j]), b = frame.at(ex[end], ey[j + 1]);
        of_level[static_cast<std::size_t>(own)].rectangle(
            {std::min(a.x(), b.x()) - overlap / 2, std::min(a.y(), b.y()) - overlap / 2,
             std::max(a.x(), b.x()) + overlap / 2, std::max(a.y(), b.y()) + overlap / 2});
      }
      i = end;
    }
  for (int l = 0; l < levels; ++l)
    if (auto& path = of_level[static_cast<std::size_t>(l)]; !path.empty())
      list.fill(std::move(path), map_color((l + 0.5) / levels, map.diverging));
}

void draw_bands(DisplayList& list, const Frame& frame, const Map& map) {
  const auto range = range_of(map);
  // Each band lies on those below it, so that no seam shows between them.
  for (int k = 0; k < map.filled; ++k) {
    const double level = k == 0 ? -std::numeric_limits<double>::infinity()
                                : std::lerp(range.low, range.high, static_cast<double>(k) / map.filled);
    if (auto path = area_above(map, frame, level); !path.empty())
      list.fill(std::move(path), map_color((k + 0.5) / map.filled, map.diverging));
  }
}

double bar_width(const Look& look, const Map& map, double height) {
  const Bar bar(look, map, height);
  const double gap = gap_of(look);
  return (bar_gap + bar_thickness) * look.tick_size + gap +
         std::max(bar.numbers, bar.factor.width - bar_thickness * look.tick_size) +
         (bar.label.empty() ? 0 : gap + bar.label.ascent + bar.label.descent) + look.margin;
}

double bar_above(const Look& look, const Map& map, double height) {
  const Bar bar(look, map, height);
  const auto span = span_of_bar(map);
  double above = bar.factor.empty() ? 0 : gap_of(look) + bar.factor.ascent + bar.factor.descent;
  for (std::size_t t = 0; t < bar.texts.size(); ++t)
    above = std::max(above, (bar.texts[t].ascent + bar.texts[t].descent) / 2 -
                                (1 - span.fraction(bar.ticks.major[t].value)) * height);
  return above;
}

void draw_bar(DisplayList& list, const Look& look, const Rect& frame, const Map& map, int panel,
              std::vector<Box>& boxes) {
  const Bar bar(look, map, frame.height());
  const auto span = span_of_bar(map);
  const double left = frame.right + bar_gap * look.tick_size, right = left + bar_thickness * look.tick_size,
               gap = gap_of(look);
  const int steps = map.filled > 0 ? map.filled : levels;
  for (int l = 0; l < steps; ++l) {
    Path step;
    const double low = frame.bottom - frame.height() * l / steps,
                 high = frame.bottom - frame.height() * (l + 1) / steps;
    step.rectangle({left, std::max(frame.top, high - overlap), right, low});
    list.fill(std::move(step), map_color((l + 0.5) / steps, map.diverging));
  }
  Path outline;
  outline.rectangle({left, frame.top, right, frame.bottom});
  list.stroke(std::move(outline), {look.hairline, {}, Cap::butt, Join::miter}, look.ink);
  for (std::size_t t = 0; t < bar.texts.size(); ++t) {
    const double y = frame.bottom - frame.height() * span.fraction(bar.ticks.major[t].value);
    Path tick;
    tick.move({right - 0.6 * look.major_tick, y}).line({right, y});
    list.stroke(std::move(tick), {look.hairline, {}, Cap::butt, Join::miter}, look.ink);
    const auto& text = bar.texts[t];
    const Point at{right + gap, y + (text.ascent - text.descent) / 2};
    draw_text(list, text, at, look.ink);
    boxes.push_back({Box::Kind::tick_label, text.box_at(at), panel, bar.ticks.major[t].label});
  }
  if (!bar.factor.empty()) {
    const Point at{left, frame.top - gap - bar.factor.descent};
    draw_text(list, bar.factor, at, look.ink);
    boxes.push_back({Box::Kind::factor, bar.factor.box_at(at), panel, bar.ticks.factor});
  }
  if (bar.label.empty()) return;
  const Point at{right + 2 * gap + bar.numbers + bar.label.ascent, frame.centre().y() + bar.label.width / 2};
  draw_text(list, bar.label, at, look.ink, std::numbers::pi / 2);
  boxes.push_back({Box::Kind::axis_label, bar.label.box_at(at, 1), panel, map.label});
}

void draw_chains(Painter& painter, const Frame& frame, const Chains& chains) {
  constexpr double thickest = 0.6, thinnest = 0.04;  // of a typical length; points
  std::vector<Point> begin, end;
  double length = 0, heaviest = 0;
  for (std::size_t k = 0; k < chains.x.size(); ++k) {
    begin.push_back(frame.at(chains.x[k] - chains.dx[k] / 2, chains.y[k] - chains.dy[k] / 2));
    end.push_back(frame.at(chains.x[k] + chains.dx[k] / 2, chains.y[k] + chains.dy[k] / 2));
    length += std::hypot(end[k].x() - begin[k].x(), end[k].y() - begin[k].y()) /
              static_cast<double>(chains.x.size());
    heaviest = std::max(heaviest, chains.weight[k]);
  }
  for (std::size_t k = 0; k < begin.size(); ++k) {
    Stroke stroke;
    stroke.width = heaviest > 0 ? thickest * length * chains.weight[k] / heaviest : 0;
    stroke.cap = Cap::round;
    if (stroke.width < thinnest) continue;
    Path path;
    path.move(begin[k]).line(end[k]);
    painter.list.stroke(std::move(path), stroke, painter.look.ink);
  }
}

void mark_crowd(Occupancy& occupied, const Frame& frame, const Map& map) {
  const auto x = cell_edges(map.x), y = cell_edges(map.y);
  for (std::size_t j = 0; j < map.y.size(); ++j)
    for (std::size_t i = 0; i < map.x.size(); ++i)
      if (std::isfinite(map.values[j * map.x.size() + i])) {
        const Point low = frame.at(x[i], y[j]), high = frame.at(x[i + 1], y[j + 1]);
        occupied.mark({low.x(), high.y(), high.x(), low.y()});
      }
}

}  // namespace chute::plot
