#include "plot/contours.hpp"

#include <algorithm>
#include <cmath>

#include "plot/color_vision.hpp"
#include "plot/level_lines.hpp"
#include "plot/map.hpp"
#include "plot/polyline.hpp"
#include "plot/scale.hpp"

namespace chute::plot {
namespace {

/// Values are set smaller than the numbers at ticks, but for the smallest type that there is.
constexpr double value_size = 0.8;
/// Points between a value and the ends of its line, other lines and the frame.
constexpr double beside_value = 1.2, beside_line = 1, beside_frame = 4;
/// A line that is shorter than so many of its values would be hidden by it.
constexpr double least_length = 2.5;
/// More of a line than this, in widths of its value, may not be hidden: it winds there.
constexpr double most_hidden = 1.5;
/// Places that are looked at on a line; between them at least so many points.
constexpr double most_places = 80, least_step = 2;

/// What of paper and ink shows better on this colour.
Color ink_on(const Color& ground, const Look& look) {
  return grey_difference(ground, look.paper) > grey_difference(ground, look.ink) ? look.paper : look.ink;
}

double length_of(const std::vector<Point>& line) {
  double length = 0;
  for (std::size_t k = 1; k < line.size(); ++k) length += (line[k] - line[k - 1]).norm();
  return length;
}

/// What of a line lies in a box: in how many stretches, and how much.
struct Inside {
  int stretches = 0;
  double length = 0;
};
Inside inside(const std::vector<Point>& line, const Rect& box) {
  Inside found;
  bool before = false, at_begin = false;
  for (std::size_t k = 1; k < line.size(); ++k) {
    Point a = line[k - 1], b = line[k];
    const bool within = cut_segment(a, b, box);
    if (within) found.length += (b - a).norm();
    if (within && !before) ++found.stretches;
    if (within && k == 1) at_begin = true;
    before = within;
  }
  const bool around = line.size() > 2 && (line.front() - line.back()).norm() == 0;
  if (around && before && at_begin && found.stretches > 1) --found.stretches;
  return found;
}

bool crosses(const std::vector<Point>& line, const Rect& box) { return inside(line, box).stretches > 0; }

/// The line without what lies in the box; a point that is NaN is a gap.
std::vector<Point> broken(const std::vector<Point>& line, const Rect& box) {
  std::vector<Point> rest;
  const Point gap{unknown, unknown};
  const auto draw = [&](const Point& from, const Point& to) {
    if ((to - from).norm() == 0) return;
    if (rest.empty() || !rest.back().allFinite()) rest.push_back(from);
    rest.push_back(to);
  };
  for (std::size_t k = 1; k < line.size(); ++k) {
    Point a = line[k - 1], b = line[k];
    if (!cut_segment(a, b, box)) {
      draw(line[k - 1], line[k]);
      continue;
    }
    draw(line[k - 1], a);
    rest.push_back(gap);
    draw(b, line[k]);
  }
  return rest;
}

/// Finds room for values, one line after the other.
class Placing {
 public:
  Placing(std::vector<LevelLine>& contours, const Frame& frame, const Look& look, const Occupancy& taken)
      : contours_(contours),
        frame_(frame.rect.grown(-beside_frame)),
        size_(std::max(smallest_type, value_size * look.tick_size)),
        taken_(taken) {}

  void place(LevelLine& contour) const {
    LevelLine::Value value;
    value.text = set_text(contour.text, size_);
    const double length = length_of(contour.points);
    if (length < least_length * value.text.width) return;
    const double step = std::max(least_step, length / most_places);
    double least = 0, passed = 0, next = step / 2;
    for (std::size_t k = 1; k < contour.points.size(); ++k) {
      const Point from = contour.points[k - 1], way = contour.points[k] - from;
      const double piece = way.norm();
      for (; piece > 0 && next < passed + piece; next += step) {
        const Point at = from + (next - passed) / piece * way;
        const Rect box = box_about(at, value.text);
        const auto cost = cost_of(contour, box, way / piece, std::abs(next / length - 0.5));
        if (!cost || (contour.value && *cost >= least)) continue;
        least = *cost;
        value.box = box;
        value.at = {box.left + beside_value, box.bottom - beside_value - value.text.descent};
        contour.value = value;
      }
      passed += piece;
    }
  }

 private:
  const std::vector<LevelLine>& contours_;
  Rect frame_;
  double size_;
  const Occupancy& taken_;

  static Rect box_about(const Point& at, const TextBox& text) {
    const double half_width = text.width / 2, half_height = (text.ascent + text.descent) / 2;
    return Rect{at.x() - half_width, at.y() - half_height, at.x() + half_width, at.y() + half_height}.grown(
        beside_value);
  }

  /// How bad a place is; none where the value would cover anything but its own line, and that once. Best is a level stretch in
  /// the middle of the line.
  std::optional<double> cost_of(const LevelLine& own, const Rect& box, const Point& along,
                                double from_middle) const {
    if (!frame_.contains(box) || !taken_.free(box)) return {};
    const auto hidden = inside(own.points, box);
    if (hidden.stretches != 1 || hidden.length > most_hidden * box.width()) return {};
    for (const auto& other : contours_) {
      if (&other == &own) continue;
      if (other.value && other.value->box.grown(beside_line).overlaps(box)) return {};
      if (crosses(other.points, box.grown(beside_line))) return {};
    }
    return std::abs(along.y()) + from_middle;
  }
};

}  // namespace

std::vector<double> contour_levels(const Map& map) {
  if (!map.levels.empty()) return map.levels;
  const auto range = range_of(map);
  std::vector<double> levels;
  for (int c = 1; c <= map.contours; ++c)
    levels.push_back(std::lerp(range.low, range.high, static_cast<double>(c) / (map.contours + 1)));
  return levels;
}

std::vector<LevelLine> contours_of(const Map& map, const Frame& frame, const Look& look,
                                   const Occupancy& taken) {
  const auto levels = contour_levels(map);
  const auto range = range_of(map);
  const auto texts = value_texts(levels);
  std::vector<LevelLine> contours;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    const double share = Span{range.low, range.high}.fraction(levels[k]);
    const Color ink = ink_on(map_color(share, map.diverging), look);
    for (auto& line : lines_at(map, frame, levels[k]))
      contours.push_back({levels[k], texts[k], ink, std::move(line)});
  }
  if (!map.values_on_lines) return contours;
  const Placing placing(contours, frame, look, taken);
  for (auto& contour : contours) placing.place(contour);
  return contours;
}

void draw_contours(Painter& painter, const Frame& frame, const std::vector<LevelLine>& contours) {
  for (const auto& contour : contours) {
    const auto& value = contour.value;
    const auto points = value ? broken(contour.points, value->box) : contour.points;
    Path path;
    add_polyline(path, points, frame.rect);
    const std::size_t first = painter.list.items.size();
    if (!path.empty())
      painter.list.stroke(std::move(path), {painter.look.hairline, {}, Cap::round, Join::round}, contour.ink);
    painter.list.tag(Tag::Kind::contour, painter.panel, contour.text, 0, first);
    mark_polyline(painter.occupied, points, frame.rect, painter.look.hairline);
  }
  for (const auto& contour : contours) {
    if (!contour.value) continue;
    draw_text(painter.list, contour.value->text, contour.value->at, contour.ink);
    painter.occupied.mark_text(contour.value->box.grown(-beside_value), contour.text);
  }
}

}  // namespace chute::plot
