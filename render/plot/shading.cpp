#include "plot/shading.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "common/error.hpp"
#include "common/toml_reader.hpp"
#include "plot/mathtext.hpp"
#include "plot/polyline.hpp"

namespace chute::plot {
namespace {

/// A series as a curve on the page: sorted by x, gaps left out.
std::vector<Point> curve(const Frame& frame, const Plot& plot, const std::string& name) {
  std::vector<std::string> known;
  for (const auto& s : plot.series) {
    known.push_back(s.name);
    if (s.name != name) continue;
    std::vector<Point> points;
    for (std::size_t i = 0; i < s.x.size(); ++i) {
      const Point p = frame.of(s).at(s.x[i], s.y[i]);
      if (p.allFinite()) points.push_back(p);
    }
    std::sort(points.begin(), points.end(), [](Point a, Point b) { return a.x() < b.x(); });
    if (points.size() < 2)
      throw InputError(fmt::format("region: series \"{}\" has fewer than two points", name));
    return points;
  }
  const auto hint = nearest(name, known);
  throw InputError(fmt::format("region: no series \"{}\" in this panel{}", name,
                               hint.empty() ? "" : fmt::format(", did you mean \"{}\"?", hint)));
}

double height_at(const std::vector<Point>& curve, double x) {
  const auto right =
      std::lower_bound(curve.begin(), curve.end(), x, [](Point p, double v) { return p.x() < v; });
  if (right == curve.begin()) return curve.front().y();
  if (right == curve.end()) return curve.back().y();
  const auto left = right - 1;
  const double t = right->x() > left->x() ? (x - left->x()) / (right->x() - left->x()) : 0;
  return left->y() + t * (right->y() - left->y());
}

}  // namespace

void draw_region(Painter& painter, const Frame& frame, const Plot& plot, const Region& region) {
  const Rect& r = frame.rect;
  std::vector<Point> under, over;
  if (!region.above.empty()) under = curve(frame, plot, region.above);
  if (!region.below.empty()) over = curve(frame, plot, region.below);
  const double floor = region.y_min ? frame.at(frame.x.low, *region.y_min).y() : r.bottom;
  const double ceiling = region.y_max ? frame.at(frame.x.low, *region.y_max).y() : r.top;
  double left = region.x_min ? frame.at(*region.x_min, frame.y.low).x() : r.left;
  double right = region.x_max ? frame.at(*region.x_max, frame.y.low).x() : r.right;
  for (const auto* bound : {&under, &over})
    if (!bound->empty())
      left = std::max(left, bound->front().x()), right = std::min(right, bound->back().x());
  if (!(left < right)) return;
  std::vector<double> stops{left, right};
  for (const auto* bound : {&under, &over})
    for (Point p : *bound)
      if (p.x() > left && p.x() < right) stops.push_back(p.x());
  std::sort(stops.begin(), stops.end());
  std::vector<Point> ring;
  for (double x : stops) ring.push_back({x, under.empty() ? floor : height_at(under, x)});
  for (auto x = stops.rbegin(); x != stops.rend(); ++x)
    ring.push_back({*x, over.empty() ? ceiling : height_at(over, *x)});
  const auto& shades = painter.look.shades;
  painter.list.fill(polygon_inside(ring, r), shades[static_cast<std::size_t>(region.shade) % shades.size()]);
}

namespace {

std::vector<Point> reference_points(const Frame& frame, const Reference& reference) {
  if (reference.kind == Reference::Kind::horizontal)
    return {frame.at(frame.x.low, reference.at), frame.at(frame.x.high, reference.at)};
  if (reference.kind == Reference::Kind::vertical)
    return {frame.at(reference.at, frame.y.low), frame.at(reference.at, frame.y.high)};
  const bool straight = frame.x.scale == Scale::linear && frame.y.scale == Scale::linear;
  const int steps = straight ? 1 : 200;  // a curve if one of the axes is logarithmic
  std::vector<Point> points;
  for (int i = 0; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps;
    const double x = frame.x.at(t);
    points.push_back(frame.at(x, x + reference.at));
  }
  return points;
}

}  // namespace

void draw_reference(Painter& painter, const Frame& frame, const Reference& reference) {
  const auto points = reference_points(frame, reference);
  Path path;
  add_polyline(path, points, frame.rect);
  if (path.empty()) return;
  const double width = 1.4 * painter.look.hairline;
  const std::size_t first = painter.list.items.size();
  if (painter.over_map) {  // whatever colour is beneath
    painter.list.stroke(path, {3 * width, {}, Cap::butt, Join::round}, painter.look.paper.with_alpha(0.75));
    painter.list.stroke(path, {width, {5 * width, 4 * width}, Cap::butt, Join::round}, painter.look.ink);
  } else {
    painter.list.stroke(path, {width, {5 * width, 4 * width}, Cap::butt, Join::round}, painter.look.quiet);
  }
  painter.list.tag(Tag::Kind::reference, painter.panel, reference.label, 0, first);
}

namespace {

/// Where a label along a line may end, from right to left, and how the line runs there.
struct Anchor {
  Point at, along;
};
std::vector<Anchor> anchors(const std::vector<Point>& points, const Rect& frame) {
  constexpr double step = 3, first = 8;  // from the frame
  std::vector<Anchor> found;
  double to_next = first;
  for (std::size_t i = points.size() - 1; i > 0; --i) {
    Point a = points[i - 1], b = points[i];
    if (!std::isfinite(a.x() + a.y() + b.x() + b.y()) || !cut_segment(a, b, frame)) continue;
    const double length = (b - a).norm();
    const Point along = (1 / length) * (b - a);
    for (; to_next < length; to_next += step) found.push_back({b - to_next * along, along});
    to_next -= length;
  }
  return found;
}

/// Sets the label along the line, as far right as can be: off the ticks where it covers nothing, or at least no other text.
/// InputError if there is no such place.
void label_line(Painter& painter, const Frame& frame, const Reference& reference) {
  const auto ends = anchors(reference_points(frame, reference), frame.rect);
  if (ends.empty()) return;  // the line lies outside
  const auto text = set_text(reference.label, painter.look.legend_size);
  constexpr double gap = 3;
  const Rect clear_of_ticks = frame.rect.grown(-inset_from_frame);
  struct Demand {
    bool off_ticks, off_ink;
  };
  for (const auto& [off_ticks, off_ink] : {Demand{true, true}, {true, false}, {false, true}, {false, false}})
    for (const auto& [end, along] : ends)
      for (double side : {gap + text.descent, -gap - text.ascent}) {
        const Point up{along.y(), -along.x()}, at = end - text.width * along + side * up;
        Rect box = Rect::nothing();
        for (double s : {0.0, text.width})
          for (double t : {-text.descent, text.ascent}) box.include(at + s * along + t * up);
        if (off_ticks && !clear_of_ticks.contains(box)) continue;
        if (off_ink ? !painter.occupied.free(box) : !painter.occupied.clear_of_texts(box)) continue;
        if (painter.over_map) painter.list.fill(Path{}.rectangle(box), painter.look.paper.with_alpha(0.75));
        draw_text(painter.list, text, at, painter.look.ink, std::atan2(-along.y(), along.x()));
        return painter.occupied.mark_text(box);
      }
  throw InputError(fmt::format("there is no room along its line for the label \"{}\"", reference.label));
}

}  // namespace

void draw_reference_label(Painter& painter, const Frame& frame, const Reference& reference) {
  if (!reference.label.empty()) label_line(painter, frame, reference);
  // only now, or the label would keep off its own line
  mark_polyline(painter.occupied, reference_points(frame, reference), frame.rect, 2 * painter.look.hairline);
}

namespace {

/// From the note's box, where the line to its middle leaves it, to the place that it is about.
void draw_arrow(Painter& painter, const Frame& frame, const Note& note, const Rect& box, Color ink) {
  constexpr double gap = 2, head = 5, half = 1.8;  // points
  const Point tip = frame.at(note.arrow[0], note.arrow[1]);
  if (!frame.rect.contains(tip, 0.01))
    throw InputError(fmt::format("the arrow of the note \"{}\" points out of its panel", note.text));
  const Rect away = box.grown(gap);
  const Point middle = away.centre(), way = tip - middle;
  const double leave = std::min(std::abs(way.x()) > 0 ? away.width() / 2 / std::abs(way.x()) : 1e9,
                                std::abs(way.y()) > 0 ? away.height() / 2 / std::abs(way.y()) : 1e9);
  if (leave * way.norm() + head > way.norm())
    throw InputError(
        fmt::format("the arrow of the note \"{}\" is shorter than its head: move the note away", note.text));
  const Point start = middle + leave * way, along = way.normalized(), across{-along.y(), along.x()};
  const Point neck = tip - head * along;
  painter.list.stroke(Path{}.move(start).line(neck),
                      {1.4 * painter.look.hairline, {}, Cap::butt, Join::miter}, ink);
  painter.list.fill(Path{}.move(tip).line(neck + half * across).line(neck - half * across).close(), ink);
  painter.occupied.mark_segment(start, tip, 2 * half);
}

}  // namespace

namespace {

/// A note as it is set, and where its baseline begins.
struct SetNote {
  TextBox text;
  Point at{0, 0};

  SetNote(const Look& look, const Frame& frame, const Note& note)
      : text(set_text(note.text, note.size.value_or(look.legend_size))) {
    const Point middle = note.fraction ? Point{frame.rect.left + note.x * frame.rect.width(),
                                               frame.rect.bottom - note.y * frame.rect.height()}
                                       : frame.at(note.x, note.y);
    if (!frame.rect.contains(middle, 0.01))
      throw InputError(fmt::format("note \"{}\" lies outside its panel", note.text));
    const Rect room = frame.rect.grown(-2);
    const double height = text.ascent + text.descent;
    if (text.width > room.width() || height > room.height())
      throw InputError(fmt::format("note \"{}\" is larger than its panel", note.text));
    // near the frame it moves in
    const double left = std::clamp(middle.x() - text.width / 2, room.left, room.right - text.width);
    const double top = std::clamp(middle.y() - height / 2, room.top, room.bottom - height);
    at = {left, top + text.ascent};
  }
};

}  // namespace

Rect note_box(const Look& look, const Frame& frame, const Note& note) {
  const SetNote set(look, frame, note);
  return set.text.box_at(set.at);
}

void draw_note(Painter& painter, const Frame& frame, const Note& note) {
  const SetNote set(painter.look, frame, note);
  const Color ink = note.ink.value_or(painter.look.ink);
  const Rect box = set.text.box_at(set.at);
  if (painter.over_map)
    painter.list.fill(Path{}.rectangle(box.grown(1)), painter.look.paper.with_alpha(0.75));
  draw_text(painter.list, set.text, set.at, ink);
  painter.occupied.mark_text(box);
  if (note.arrow.size() == 2) draw_arrow(painter, frame, note, box, ink);
}

}  // namespace chute::plot
