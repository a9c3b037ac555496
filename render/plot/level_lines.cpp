#include "plot/level_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace chute::plot {
namespace {

/// Of a triangle. The node is its number among all middles and means, so that triangles which share an edge know it.
struct Corner {
  Point at{0, 0};
  double value = 0;
  std::size_t node = 0;
};
using Triangle = std::array<Corner, 3>;

/// Between two corners of which one is above. The same two give the same point in either order.
Point cut(const Corner& p, const Corner& q, double level) {
  const Corner &a = p.node < q.node ? p : q, &b = p.node < q.node ? q : p;
  return a.at + (level - a.value) / (b.value - a.value) * (b.at - a.at);
}

class Triangles {
 public:
  Triangles(const Map& map, const Frame& frame) : map_(map), frame_(frame) {}

  std::size_t columns() const { return map_.x.size(); }
  std::size_t rows() const { return map_.y.size(); }
  Point place(std::size_t i, std::size_t j) const { return corner(i, j).at; }

  bool is_above(std::size_t i, std::size_t j, double level) const {
    const auto corners = corners_of(i, j);
    return std::all_of(corners.begin(), corners.end(),
                       [&](const Corner& c) { return std::isfinite(c.value) && c.value >= level; });
  }

  template <class Do>
  void of_square(std::size_t i, std::size_t j, Do&& act) const {
    const auto corners = corners_of(i, j);
    Corner middle;
    for (const auto& c : corners) middle.at += 0.25 * c.at, middle.value += 0.25 * c.value;
    if (!std::isfinite(middle.value)) return;
    middle.node = columns() * rows() + corners[0].node;
    for (std::size_t c = 0; c < 4; ++c) act(Triangle{corners[c], corners[(c + 1) % 4], middle});
  }

 private:
  const Map& map_;
  const Frame& frame_;

  Corner corner(std::size_t i, std::size_t j) const {
    const std::size_t node = j * columns() + i;
    return {frame_.at(map_.x[i], map_.y[j]), map_.values[node], node};
  }
  std::array<Corner, 4> corners_of(std::size_t i, std::size_t j) const {
    return {corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)};
  }
};

void add_part(Path& path, const Triangle& corners, double level) {
  std::vector<Point> part;
  for (std::size_t c = 0; c < 3; ++c) {
    const auto &p = corners[c], &q = corners[(c + 1) % 3];
    if (p.value >= level) part.push_back(p.at);
    if ((p.value >= level) != (q.value >= level)) part.push_back(cut(p, q, level));
  }
  for (std::size_t k = 0; k < part.size(); ++k) k ? path.line(part[k]) : path.move(part[k]);
  if (!part.empty()) path.close();
}

/// Pieces of lines, one a triangle, put together where they meet. An edge belongs to two triangles at most, so that no more than
/// two pieces meet on it.
class Threads {
 public:
  void add(const Triangle& corners, double level) {
    std::vector<std::size_t> ends;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto &p = corners[c], &q = corners[(c + 1) % 3];
      if ((p.value >= level) == (q.value >= level)) continue;
      const auto edge = std::minmax(p.node, q.node);
      const auto [known, is_new] = of_edge_.try_emplace({edge.first, edge.second}, knots_.size());
      if (is_new) knots_.push_back({cut(p, q, level), {}});
      ends.push_back(known->second);
    }
    if (ends.size() != 2) return;
    knots_[ends[0]].next.push_back(ends[1]);
    knots_[ends[1]].next.push_back(ends[0]);
  }

  std::vector<std::vector<Point>> lines() {
    std::vector<std::vector<Point>> found;
    for (const std::size_t ends : {1, 2})  // first those that end somewhere, then those that run around
      for (std::size_t k = 0; k < knots_.size(); ++k)
        if (!knots_[k].used && knots_[k].next.size() == ends) found.push_back(follow(k, ends == 2));
    return found;
  }

 private:
  struct Knot {
    Point at{0, 0};
    std::vector<std::size_t> next;
    bool used = false;
  };
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> of_edge_;
  std::vector<Knot> knots_;

  std::vector<Point> follow(std::size_t k, bool around) {
    std::vector<Point> line;
    const Point first = knots_[k].at;
    for (;;) {
      knots_[k].used = true;
      line.push_back(knots_[k].at);
      const auto& next = knots_[k].next;
      const auto on = std::find_if(next.begin(), next.end(), [&](std::size_t n) { return !knots_[n].used; });
      if (on == next.end()) break;
      k = *on;
    }
    if (around) line.push_back(first);
    return line;
  }
};

}  // namespace

Path area_above(const Map& map, const Frame& frame, double level) {
  const Triangles triangles(map, frame);
  Path path;
  for (std::size_t j = 0; j + 1 < triangles.rows(); ++j)
    for (std::size_t i = 0; i + 1 < triangles.columns(); ++i) {
      if (triangles.is_above(i, j, level)) {  // whole squares in a row are one rectangle
        const std::size_t first = i;
        while (i + 2 < triangles.columns() && triangles.is_above(i + 1, j, level)) ++i;
        const Point a = triangles.place(first, j), b = triangles.place(i + 1, j + 1);
        path.move(a).line({b.x(), a.y()}).line(b).line({a.x(), b.y()}).close();
        continue;
      }
      triangles.of_square(i, j, [&](const Triangle& corners) { add_part(path, corners, level); });
    }
  return path;
}

std::vector<std::vector<Point>> lines_at(const Map& map, const Frame& frame, double level) {
  const Triangles triangles(map, frame);
  Threads threads;
  for (std::size_t j = 0; j + 1 < triangles.rows(); ++j)
    for (std::size_t i = 0; i + 1 < triangles.columns(); ++i)
      triangles.of_square(i, j, [&](const Triangle& corners) { threads.add(corners, level); });
  return threads.lines();
}

}  // namespace chute::plot
