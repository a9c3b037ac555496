#include "plot/names.hpp"

#include <algorithm>
#include <cmath>

#include "plot/mathtext.hpp"
#include "plot/polyline.hpp"

namespace chute::plot {
namespace {

constexpr double step = 3;       // points, between the places that are looked at along a curve
constexpr double away = 3;       // points, between a name and its curve
constexpr double farther = 4;    // points, by which other curves must be farther away than the own one
constexpr double from_edge = 3;  // points, between a name and the frame

/// A curve's or a cloud's places within the frame, one every `step`, in the order of its points.
std::vector<Point> places_of(const Series& s, const Frame& frame) {
  std::vector<Point> found;
  const bool joined = s.kind == Kind::line || s.kind == Kind::both || s.kind == Kind::band;
  Point before{unknown, unknown};
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    const Point at = frame.at(s.x[i], s.y[i]);
    Point a = before, b = at;
    before = at;
    if (!std::isfinite(at.x() + at.y())) continue;
    if (joined && std::isfinite(a.x() + a.y()) && cut_segment(a, b, frame.rect)) {
      const double length = (b - a).norm();
      for (double t = step; t < length; t += step) found.push_back(a + t / length * (b - a));
      found.push_back(b);
    } else if (frame.rect.contains(at)) {
      found.push_back(at);
    }
  }
  return found;
}

double distance(const Rect& r, const Point& p) {
  return std::hypot(std::max({r.left - p.x(), 0.0, p.x() - r.right}),
                    std::max({r.top - p.y(), 0.0, p.y() - r.bottom}));
}

double nearest(const Rect& r, const std::vector<Point>& points) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& p : points) least = std::min(least, distance(r, p));
  return least;
}

}  // namespace

bool put_names(Layout& out, const std::vector<CurveName>& names, const Frame& frame, const Plot& plot,
               const std::map<std::string, SeriesLook>& looks, Occupancy& occupied, const Look& look,
               int panel) {
  std::vector<std::vector<Point>> places;
  for (const auto& s : plot.series) places.push_back(places_of(s, frame.of(s)));
  struct Put {
    const CurveName* name;
    TextBox text;
    Rect box;
  };
  std::vector<Put> puts;
  const Rect room = frame.rect.grown(-from_edge);
  for (const auto& name : names) {
    const auto text = set_text(name.text, look.legend_size);
    const double height = text.ascent + text.descent;
    std::optional<Rect> best;
    double least = 0;
    std::vector<Point> others;
    std::vector<const std::vector<Point>*> own;
    for (std::size_t k = 0; k < plot.series.size(); ++k)
      if (std::find(name.curves.begin(), name.curves.end(), &plot.series[k]) != name.curves.end())
        own.push_back(&places[k]);
      else
        others.insert(others.end(), places[k].begin(), places[k].end());
    for (const auto* along : own)
      for (std::size_t k = 0; k < along->size(); ++k) {
        const Point p = (*along)[k];
        const double to_end = static_cast<double>(along->size() - 1 - k) * step;
        for (const auto& [dx, dy] : {std::pair{0.5, -1.0},
                                     {1.0, -0.5},
                                     {0.0, -0.5},
                                     {0.5, 0.0},
                                     {0.0, -1.0},
                                     {1.0, -1.0},
                                     {0.0, 0.0},
                                     {1.0, 0.0}}) {
          // the block's place about p, as shares of its size; at its side it keeps away
          Rect box{p.x() - dx * text.width, p.y() + dy * height, 0, 0};
          if (dy == -1.0) box.top -= away;
          if (dy == 0.0) box.top += away;
          if (dx == 0.0) box.left += away;
          if (dx == 1.0) box.left -= away;
          box.right = box.left + text.width, box.bottom = box.top + height;
          if (!room.contains(box) || !occupied.free(box.grown(1))) continue;
          if (std::any_of(puts.begin(), puts.end(),
                          [&](const Put& other) { return other.box.grown(away).overlaps(box); }))
            continue;
          double near = std::numeric_limits<double>::infinity();
          for (const auto* mine : own) near = std::min(near, nearest(box, *mine));
          const double far = nearest(box, others);
          if (far < near + farther) continue;
          const double cost = to_end + 2 * near - 0.5 * std::min(far, 30.0);
          if (!best || cost < least) best = box, least = cost;
        }
      }
    if (!best) return false;
    puts.push_back({&name, text, *best});
  }
  for (const auto& put : puts) {
    const std::size_t first = out.list.items.size();
    const Point at{put.box.left, put.box.top + put.text.ascent};
    draw_text(out.list, put.text, at, looks.at(put.name->curves.front()->name).color);
    for (const auto* s : put.name->curves) out.list.tag(Tag::Kind::named, panel, s->name, 0, first);
    out.boxes.push_back({Box::Kind::name, put.box, panel, put.name->text});
    occupied.mark_text(put.box);
  }
  return true;
}

}  // namespace chute::plot
