#include "plot/marks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "common/error.hpp"
#include "plot/cells.hpp"
#include "plot/contours.hpp"
#include "plot/extents.hpp"
#include "plot/map.hpp"
#include "plot/polyline.hpp"
#include "plot/shading.hpp"

namespace chute::plot {
namespace {

/// The outline of a histogram from the ground up and down again; in a log frame the ground is the frame's
/// lower edge.
std::vector<Point> outline_of(const Frame& frame, const Series& s) {
  const auto edges = bin_edges(s.x);
  const double ground =
      frame.y.scale == Scale::log || frame.y.low > 0 ? frame.y.low : std::min(0.0, frame.y.high);
  const auto height = [&](double y) { return frame.y.scale == Scale::log && !(y > 0) ? ground : y; };
  std::vector<Point> points;
  if (s.x.empty()) return points;
  points.push_back(frame.at(edges[0], ground));
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    const double y = std::isnan(s.y[i]) ? ground : height(s.y[i]);
    points.push_back(frame.at(edges[i], y));
    points.push_back(frame.at(edges[i + 1], y));
  }
  points.push_back(frame.at(edges.back(), ground));
  return points;
}

class SeriesPainter {
 public:
  SeriesPainter(Painter& painter, const Frame& frame, const Series& series, const SeriesLook& ink)
      : look_(std::make_shared<const Look>(ink.of(painter.look))),
        p_{painter.list, *look_, painter.occupied, painter.panel, painter.over_map},
        frame_(frame.of(series)),
        s_(series),
        ink_(ink) {}

  void area() {
    if (s_.kind == Kind::band) band();
    if (s_.kind == Kind::bars) {
      Path path;
      add_polyline(path, outline_of(frame_, s_), frame_.rect);
      p_.list.fill(path, ink_.color.with_alpha(0.3));
      mark_bins();
    }
  }

  void lines() {
    std::vector<Point> points;
    const double width = has_bins(s_.kind) ? 0.8 * p_.look.line_width : p_.look.line_width;
    if (has_bins(s_.kind)) {
      points = outline_of(frame_, s_);
    } else if (has_line(s_.kind)) {
      for (std::size_t i = 0; i < s_.x.size(); ++i) points.push_back(frame_.at(s_.x[i], s_.y[i]));
    }
    if (points.empty() || (s_.hollow && s_.kind == Kind::both)) return;
    Path path;
    add_polyline(path, points, frame_.rect);
    const std::size_t first = p_.list.items.size();
    // with markers the line stays solid: the markers tell the series apart
    const bool dashed = s_.kind == Kind::line || s_.kind == Kind::band || s_.kind == Kind::steps;
    p_.list.stroke(path,
                   {width, dashed ? dash_pattern(ink_.dash, width) : std::vector<double>{}, Cap::butt,
                    has_bins(s_.kind) ? Join::miter : Join::round},
                   s_.faint ? ink_.color.with_alpha(0.35) : ink_.color);
    if (ink_.marked && s_.kind == Kind::line) marks_on_the_way(points);
    p_.list.tag(Tag::Kind::curve, p_.panel, s_.name, 0, first);
    mark_polyline(p_.occupied, points, frame_.rect, width);
    if (s_.kind == Kind::steps) mark_bins();
  }

  /// A marker every so often: at other places on each curve, so that those that run together can be told apart.
  void marks_on_the_way(const std::vector<Point>& points) {
    constexpr double step = 14;  // in markers
    const double size = p_.look.marker_size, between = step * size;
    const auto shape = ink_.shape(size);
    const Rect inside = frame_.rect.grown(-size / 2);
    constexpr int phases = 5;
    double to_next = between * (0.3 + static_cast<double>(ink_.marker % phases) / phases);
    for (std::size_t i = 1; i < points.size(); ++i) {
      Point a = points[i - 1], b = points[i];
      if (!a.allFinite() || !b.allFinite() || !cut_segment(a, b, frame_.rect)) continue;
      const double length = (b - a).norm();
      for (; to_next < length; to_next += between) {
        const Point at = a + (to_next / length) * (b - a);
        if (!inside.contains(at)) continue;
        draw_marker(p_.list, p_.look, shape, ink_.color, at);
        p_.occupied.mark(shape.path.bounds().moved(at));
      }
      to_next -= length;
    }
  }

  void dots() {
    if (s_.kind != Kind::dots) return;
    DotsItem item;
    // a crowd is drawn with finer dots, or it would run together: from 3000 dots on, which cover a tenth of a
    // single column's frame, and not below what a printer still shows
    constexpr double few = 3000, finest = 0.62;
    const double crowd = std::clamp(std::sqrt(few / static_cast<double>(s_.x.size() + 1)), finest, 1.0);
    item.shape = dot_shape(crowd * p_.look.dot_radius, ink_.marker);
    item.color = ink_.color;
    for (std::size_t i = 0; i < s_.x.size(); ++i) {
      const Point at = frame_.at(s_.x[i], s_.y[i]);
      if (!is_inside(i)) continue;
      item.at.push_back(at);
      p_.occupied.mark(Rect{at.x(), at.y(), at.x(), at.y()}.grown(p_.look.dot_radius));
    }
    const std::size_t first = p_.list.items.size(), drawn = item.at.size();
    if (!item.at.empty()) p_.list.items.emplace_back(std::move(item));
    p_.list.tag(Tag::Kind::dots, p_.panel, s_.name, drawn, first);
  }

  void error_bars() {
    if (s_.kind == Kind::line || s_.kind == Kind::dots || s_.kind == Kind::band || s_.kind == Kind::cells)
      return;
    Path path;
    for (std::size_t i = 0; i < s_.x.size(); ++i) {
      if (!is_inside(i)) continue;
      bar(path, i, error_at(s_.y_err, i), true);
      if (!has_bins(s_.kind)) bar(path, i, error_at(s_.x_err, i), false);
    }
    if (!path.empty()) p_.list.stroke(path, {1.3 * p_.look.hairline, {}, Cap::butt, Join::miter}, ink_.color);
  }

  void markers() {
    if (!has_markers(s_.kind)) return;
    const auto shape = ink_.shape(p_.look.marker_size);
    for (std::size_t i = 0; i < s_.x.size(); ++i) {
      const Point at = frame_.at(s_.x[i], s_.y[i]);
      if (!is_inside(i)) continue;
      const std::size_t first = p_.list.items.size();
      draw_marker(p_.list, p_.look, shape, ink_.color, at);
      p_.list.tag(Tag::Kind::marker, p_.panel, s_.name, 1, first);
      p_.occupied.mark(shape.path.bounds().moved(at));
    }
  }

  /// No point is lost: what lies outside the frame is an arrow at it, pointing there.
  void arrows() {
    if (s_.kind == Kind::line || s_.kind == Kind::band || s_.kind == Kind::cells) return;
    struct Beyond {
      Point at, along;
      std::size_t points = 0;
    };
    std::vector<Beyond> all;
    for (std::size_t i = 0; i < s_.x.size(); ++i) {
      if (!std::isfinite(s_.x[i]) || !std::isfinite(s_.y[i])) continue;
      const double fx = side(frame_.x, s_.x[i]), fy = side(frame_.y, s_.y[i]);
      const bool left_or_right = fx < 0 || fx > 1, up_or_down = fy < 0 || fy > 1;
      if (!left_or_right && !up_or_down) continue;
      if (has_bins(s_.kind) && !(s_.y[i] > 0)) continue;  // an empty bin is no point
      const double in = 0.9 * p_.look.marker_size;        // the shaft's begin, away from the corners
      const Rect inner = frame_.rect.grown(-in);
      const Point place{frame_.rect.left + std::clamp(fx, 0.0, 1.0) * frame_.rect.width(),
                        frame_.rect.bottom - std::clamp(fy, 0.0, 1.0) * frame_.rect.height()};
      Beyond b;
      if (up_or_down)
        b.at = {std::clamp(place.x(), inner.left, inner.right), place.y()}, b.along = {0, fy > 1 ? -1 : 1};
      else
        b.at = {place.x(), std::clamp(place.y(), inner.top, inner.bottom)}, b.along = {fx > 1 ? 1 : -1, 0};
      const auto near = std::find_if(all.begin(), all.end(), [&](const Beyond& other) {
        return (other.at - b.at).norm() < p_.look.marker_size && (other.along - b.along).norm() < 0.1;
      });
      if (near == all.end())
        b.points = 1, all.push_back(b);
      else
        ++near->points;
    }
    for (const auto& b : all) {
      const double length = 1.9 * p_.look.marker_size, head = 0.95 * p_.look.marker_size,
                   half = 0.42 * p_.look.marker_size;
      const Point across{-b.along.y(), b.along.x()}, tip = b.at - 0.6 * b.along, neck = tip - head * b.along;
      Path shaft, triangle;
      shaft.move(tip - length * b.along).line(neck);
      triangle.move(tip).line(neck + half * across).line(neck - half * across).close();
      const std::size_t first = p_.list.items.size();
      p_.list.stroke(shaft, {0.85 * p_.look.line_width, {}, Cap::butt, Join::miter}, ink_.color);
      if (ink_.hollow)
        p_.list.stroke(triangle, {0.85 * p_.look.line_width, {}, Cap::butt, Join::miter}, ink_.color);
      else
        p_.list.fill(triangle, ink_.color);
      p_.list.tag(Tag::Kind::beyond, p_.panel, s_.name, b.points, first);
      Rect taken = Rect::nothing();
      taken.include(tip), taken.include(tip - length * b.along + half * across),
          taken.include(tip - length * b.along - half * across);
      p_.occupied.mark(taken);
    }
  }

  /// Scatter dots differ in shape too, as far as their size lets one see it.
  static Path dot_shape(double radius, int marker) {
    switch (marker % 3) {
      case 0:
        return Path{}.circle({0, 0}, radius);
      case 1:
        return marker_shape(6, 2 * radius).path;  // square
      default:
        return marker_shape(2, 2.2 * radius).path;  // triangle
    }
  }

 private:
  std::shared_ptr<const Look> look_;  // shared: painters are moved, and p_ refers to it
  Painter p_;
  Frame frame_;
  const Series& s_;
  const SeriesLook& ink_;

  static constexpr double edge = 0.01;  // points: on the frame counts as within

  /// Where along an axis a value lies, 0 to 1 within the frame; what a logarithmic axis cannot show lies below.
  double side(const Span& span, double value) const {
    const double f = span.fraction(value), slack = edge / std::min(frame_.rect.width(), frame_.rect.height());
    if (std::isnan(f) || value < span.low_limit) return -1;
    if (value > span.high_limit) return 2;
    return f < 0 && f > -slack ? 0 : f > 1 && f < 1 + slack ? 1 : f;
  }

  bool is_inside(std::size_t i) const {
    if (!std::isfinite(s_.x[i]) || !std::isfinite(s_.y[i])) return false;
    const double fx = side(frame_.x, s_.x[i]), fy = side(frame_.y, s_.y[i]);
    return fx >= 0 && fx <= 1 && fy >= 0 && fy <= 1;
  }

  void mark_bins() {
    const auto points = outline_of(frame_, s_);
    if (points.empty()) return;
    for (std::size_t i = 1; i + 2 < points.size(); i += 2)
      if (!std::isnan(points[i].x()))
        p_.occupied.mark({points[i].x(), std::min(points[i].y(), points[0].y()), points[i + 1].x(),
                          std::max(points[i].y(), points[0].y())});
  }

  void band() {
    std::vector<Point> upper, lower;
    const auto flush = [&] {
      std::vector<Point> ring = upper;
      ring.insert(ring.end(), lower.rbegin(), lower.rend());
      if (upper.size() > 1) {
        p_.list.fill(polygon_inside(ring, frame_.rect), ink_.color.with_alpha(0.25));
        for (std::size_t i = 0; i + 1 < upper.size(); ++i)
          p_.occupied.mark({upper[i].x(), std::min(upper[i].y(), upper[i + 1].y()), upper[i + 1].x(),
                            std::max(lower[i].y(), lower[i + 1].y())});
      }
      upper.clear(), lower.clear();
    };
    for (std::size_t i = 0; i < s_.x.size(); ++i) {
      const double e = error_at(s_.y_err, i);
      const bool log = frame_.y.scale == Scale::log;
      const double low = log && s_.y[i] - e <= 0 ? frame_.y.low : s_.y[i] - e;
      const Point a = frame_.at(s_.x[i], s_.y[i] + e), b = frame_.at(s_.x[i], low);
      if (std::isnan(a.x()) || std::isnan(a.y()) || std::isnan(b.y()))
        flush();
      else
        upper.push_back(a), lower.push_back(b);
    }
    flush();
  }

  void bar(Path& path, std::size_t i, double error, bool vertical) {
    if (!(error > 0)) return;
    const double centre = vertical ? s_.y[i] : s_.x[i];
    const Span& span = vertical ? frame_.y : frame_.x;
    const Rect& r = frame_.rect;
    for (double sign : {-1.0, 1.0}) {
      double end = centre + sign * error;
      const bool beyond = (span.scale == Scale::log && end <= 0) || end < span.low || end > span.high;
      end = std::clamp(end, span.low, span.high);
      const Point a = frame_.at(s_.x[i], s_.y[i]);
      const Point b =
          vertical ? Point{a.x(), frame_.at(s_.x[i], end).y()} : Point{frame_.at(end, s_.y[i]).x(), a.y()};
      path.move(a).line(b);
      p_.occupied.mark_segment(a, b, p_.look.cap);
      if (beyond) continue;  // the frame cuts it: no cap
      const double half = p_.look.cap / 2;
      if (vertical)
        path.move({std::max(r.left, b.x() - half), b.y()}).line({std::min(r.right, b.x() + half), b.y()});
      else
        path.move({b.x(), std::max(r.top, b.y() - half)}).line({b.x(), std::min(r.bottom, b.y() + half)});
    }
  }
};

}  // namespace

namespace {

/// What all but the map covers: values on its contours keep off that, although they are drawn before.
Occupancy covered_beside_map(const Painter& painter, const Frame& frame, const Plot& plot,
                             const std::map<std::string, SeriesLook>& looks) {
  Plot rest = plot;
  rest.map.reset();
  DisplayList nowhere;
  Occupancy covered(frame.rect);
  Painter trial{nowhere, painter.look, covered, painter.panel, painter.over_map};
  draw_marks(trial, frame, rest, looks);
  return covered;
}

}  // namespace

void draw_marks(Painter& painter, const Frame& frame, const Plot& plot,
                const std::map<std::string, SeriesLook>& looks) {
  painter.list.items.emplace_back(ClipBegin{frame.rect});
  if (plot.map) draw_map(painter.list, frame, *plot.map);
  draw_cells(painter, frame, plot, cell_grid(plot), looks);
  if (plot.map && (plot.map->contours > 0 || !plot.map->levels.empty()))
    draw_contours(
        painter, frame,
        contours_of(*plot.map, frame, painter.look, covered_beside_map(painter, frame, plot, looks)));
  if (plot.map && plot.map->log) mark_crowd(painter.occupied, frame, *plot.map);
  for (const auto& region : plot.regions) draw_region(painter, frame, plot, region);
  for (const auto& reference : plot.references) draw_reference(painter, frame, reference);
  std::vector<SeriesPainter> series;
  series.reserve(plot.series.size());
  for (const auto& s : plot.series) series.emplace_back(painter, frame, s, looks.at(s.name));
  for (auto& s : series) s.area();
  for (auto& s : series) s.dots();
  for (auto& s : series) s.lines();
  if (plot.chains) draw_chains(painter, frame, *plot.chains);
  painter.list.items.emplace_back(ClipEnd{});
  for (auto& s : series) s.error_bars();
  for (auto& s : series) s.markers();
  for (auto& s : series) s.arrows();
  for (const auto& note : plot.notes) draw_note(painter, frame, note);
  for (const auto& reference : plot.references) draw_reference_label(painter, frame, reference);
}

void draw_marker(DisplayList& list, const Look& look, const MarkerShape& shape, Color color,
                 const Point& at) {
  Path path;
  path.append(shape.path, at);
  const Stroke pen{0.85 * look.line_width, {}, Cap::butt, Join::miter};
  if (shape.paint == MarkerShape::Paint::hollow) list.fill(path, look.paper);
  if (!shape.inside.empty()) {
    Path inside;
    inside.append(shape.inside, at);
    list.fill(inside, color);
  }
  if (shape.paint == MarkerShape::Paint::filled)
    list.fill(path, color);
  else
    list.stroke(path, pen, color);
}

void draw_sample(DisplayList& list, const Look& style, Kind kind, const SeriesLook& ink, Point at,
                 double width) {
  const Look look = ink.of(style);
  const double middle = at.x() + width / 2, half = 0.32 * look.legend_size;
  if (kind == Kind::cells) {
    Path box;
    box.rectangle({at.x(), at.y() - half, at.x() + width, at.y() + half});
    list.fill(box, cell_tint(ink.color, look.paper));
    list.stroke(box, {look.hairline, {}, Cap::butt, Join::miter}, look.ink);
    draw_marker(list, look, ink.shape(look.marker_size), ink.color, {middle, at.y()});
  }
  if (kind == Kind::bars || kind == Kind::band) {
    Path box;
    box.rectangle({at.x() + (kind == Kind::bars ? 4 : 0), at.y() - half,
                   at.x() + width - (kind == Kind::bars ? 4 : 0), at.y() + half});
    list.fill(box, ink.color.with_alpha(kind == Kind::bars ? 0.3 : 0.25));
    if (kind == Kind::bars) list.stroke(box, {0.8 * look.line_width, {}, Cap::butt, Join::miter}, ink.color);
  }
  if ((has_line(kind) && !(kind == Kind::both && ink.hollow)) || kind == Kind::steps) {
    const bool dashed = kind != Kind::both;
    Path line;
    line.move({at.x(), at.y()}).line({at.x() + width, at.y()});
    list.stroke(line,
                {look.line_width, dashed ? dash_pattern(ink.dash, look.line_width) : std::vector<double>{}},
                ink.color);
  }
  if (kind == Kind::dots) {
    const auto shape = SeriesPainter::dot_shape(2.2 * look.dot_radius, ink.marker);
    list.items.emplace_back(DotsItem{shape, {{middle, at.y()}}, ink.color});
  }
  if (has_markers(kind) || (ink.marked && kind == Kind::line))
    draw_marker(list, look, ink.shape(look.marker_size), ink.color, {middle, at.y()});
}

}  // namespace chute::plot
