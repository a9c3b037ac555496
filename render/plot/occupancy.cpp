#include "plot/occupancy.hpp"

#include <array>
#include <cmath>

namespace chute::plot {
namespace {

constexpr double clearance = 1.5;  // points between a block and whatever is beside it

}  // namespace

Occupancy::Occupancy(const Rect& frame)
    : frame_(frame),
      columns_(std::max(1, static_cast<int>(std::ceil(frame.width() / cell)))),
      rows_(std::max(1, static_cast<int>(std::ceil(frame.height() / cell)))),
      cells_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0) {}

void Occupancy::mark(const Rect& rect) {
  summed_.clear();
  const auto index = [](double v, int count) {
    return std::clamp(static_cast<int>(std::floor(std::clamp(v, -1e6, 1e6))), 0, count - 1);
  };
  if (!rect.overlaps(frame_)) return;
  const int x0 = index((rect.left - frame_.left) / cell, columns_),
            x1 = index((rect.right - frame_.left) / cell, columns_);
  const int y0 = index((rect.top - frame_.top) / cell, rows_),
            y1 = index((rect.bottom - frame_.top) / cell, rows_);
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) cells_[static_cast<std::size_t>(y * columns_ + x)] = 1;
}

void Occupancy::mark_segment(Point a, Point b, double width) {
  const double length = (b - a).norm();
  const int steps = std::clamp(static_cast<int>(std::ceil(length / (cell / 2))), 1, 4000);
  for (int i = 0; i <= steps; ++i) {
    const Point p = a + (static_cast<double>(i) / steps) * (b - a);
    mark(Rect{p.x(), p.y(), p.x(), p.y()}.grown(width / 2 + 0.01));
  }
}

void Occupancy::mark_text(const Rect& rect, const std::string& contour) {
  mark(rect);
  texts_.push_back({rect, contour});
}

bool Occupancy::clear_of_texts(const Rect& rect) const {
  return frame_.contains(rect) &&
         std::none_of(texts_.begin(), texts_.end(), [&](const Text& t) { return t.rect.overlaps(rect); });
}

std::optional<Point> Occupancy::beside_texts(double width, double height, double inset, Place wanted) const {
  const Rect area = frame_.grown(-inset);
  const Point to = corner(width, height, inset, wanted);
  const bool anywhere = wanted == Place::automatic;
  std::optional<Point> best;
  double least = 0;
  const auto steps = [](double room) { return static_cast<int>(std::floor(room / cell + 1e-9)); };
  for (int j = 0; j <= steps(area.height() - height); ++j)
    for (int i = 0; i <= steps(area.width() - width); ++i) {
      // from the right edge and the bottom, so that these corners are among the places
      const Point p{area.right - width - i * cell, area.bottom - height - j * cell};
      const Rect block{p.x(), p.y(), p.x() + width, p.y() + height};
      if (!clear_of_texts(block.grown(clearance))) continue;
      const double cost = anywhere ? covered(block) : (p - to).norm();
      if (!best || cost < least) best = p, least = cost;
    }
  return best;
}

double Occupancy::covered(const Rect& r) const {
  constexpr double slack = 1e-6;
  if (r.left < frame_.left - slack || r.top < frame_.top - slack || r.right > frame_.right + slack ||
      r.bottom > frame_.bottom + slack)
    return 1;
  const auto stride = static_cast<std::size_t>(columns_ + 1);
  if (summed_.empty()) {
    summed_.assign(stride * static_cast<std::size_t>(rows_ + 1), 0);
    for (std::size_t y = 0; y < static_cast<std::size_t>(rows_); ++y)
      for (std::size_t x = 0; x + 1 < stride; ++x)
        summed_[(y + 1) * stride + x + 1] = cells_[y * (stride - 1) + x] + summed_[y * stride + x + 1] +
                                            summed_[(y + 1) * stride + x] - summed_[y * stride + x];
  }
  const auto x0 = static_cast<std::size_t>(std::clamp((r.left - frame_.left) / cell, 0.0, columns_ - 1.0));
  const auto y0 = static_cast<std::size_t>(std::clamp((r.top - frame_.top) / cell, 0.0, rows_ - 1.0));
  const auto x1 =
      static_cast<std::size_t>(std::clamp((r.right - frame_.left) / cell, 0.0, columns_ - 1.0)) + 1;
  const auto y1 = static_cast<std::size_t>(std::clamp((r.bottom - frame_.top) / cell, 0.0, rows_ - 1.0)) + 1;
  const int sum = summed_[y1 * stride + x1] - summed_[y0 * stride + x1] - summed_[y1 * stride + x0] +
                  summed_[y0 * stride + x0];
  return static_cast<double>(sum) / static_cast<double>((x1 - x0) * (y1 - y0));
}

Point Occupancy::corner(double width, double height, double inset, Place place) const {
  const bool left = place == Place::top_left || place == Place::bottom_left;
  const bool top = place == Place::top_left || place == Place::top_right;
  return {left ? frame_.left + inset : frame_.right - inset - width,
          top ? frame_.top + inset : frame_.bottom - inset - height};
}

std::optional<Occupancy::Room> Occupancy::room_for(double width, double height, double inset,
                                                   Place wanted) const {
  constexpr std::array corners{Place::top_right, Place::top_left, Place::bottom_right, Place::bottom_left};
  const Rect area = frame_.grown(-inset);
  if (area.width() < width || area.height() < height) return {};
  const auto is_free = [&](Point p) {
    return free(Rect{p.x(), p.y(), p.x() + width, p.y() + height}.grown(clearance));
  };
  std::optional<Room> best;
  const auto consider = [&](Point p) {
    double cost = 1e300;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (wanted != Place::automatic && wanted != corners[i]) continue;
      const Point c = corner(width, height, inset, corners[i]);
      cost = std::min(cost, (p - c).norm() + 1.0 * static_cast<double>(i));
    }
    if ((!best || cost < best->from_corner) && is_free(p)) best = Room{p, cost};
  };
  for (Place c : corners)
    if (wanted == Place::automatic || wanted == c) consider(corner(width, height, inset, c));
  if (wanted != Place::automatic) return best;
  for (double y = area.top; y + height <= area.bottom; y += cell)
    for (double x = area.left; x + width <= area.right; x += cell) consider({x, y});
  return best;
}

}  // namespace chute::plot
