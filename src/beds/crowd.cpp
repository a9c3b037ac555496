#include "beds/crowd.hpp"

#include <algorithm>
#include <cmath>

namespace chute::beds {
namespace {

using Place = std::array<double, 2>;

/// Overlaps below this part of the sum of two radii do not count.
constexpr double tolerance = 1e-3;

/// Places that are farther apart than this, in radii, can be changed at once without one noticing the other.
constexpr double independent = 6;

double squared(const Place& d) { return d[0] * d[0] + d[1] * d[1]; }

/// Places in square cells, to find those near one.
class Grid {
 public:
  /// Cells are at least `least` wide, and wider where there would be many more of them than places.
  Grid(const Sheet& sheet, double least)
      : nx_(cells(sheet.length, width_of(sheet, least))),
        ny_(cells(sheet.width, width_of(sheet, least))),
        dx_(sheet.length / static_cast<double>(nx_)),
        dy_(sheet.width / static_cast<double>(ny_)),
        in_(static_cast<std::size_t>(nx_ * ny_)) {
    for (std::size_t i = 0; i < sheet.place.size(); ++i) in_[cell_of(sheet.place[i])].push_back(i);
  }
  template <class Visit>
  void near(const Place& place, const Visit& visit) const {
    const auto x = column(place), y = row(place);
    const auto span = [](std::int64_t n) { return std::min<std::int64_t>(3, n); };
    for (std::int64_t p = 0; p < span(nx_); ++p)
      for (std::int64_t q = 0; q < span(ny_); ++q)
        for (const auto j :
             in_[static_cast<std::size_t>((x + p + nx_ - 1) % nx_ * ny_ + (y + q + ny_ - 1) % ny_)])
          visit(j);
  }

 private:
  static double width_of(const Sheet& sheet, double least) {
    constexpr double most = 4;  // cells for a place
    const auto places = static_cast<double>(sheet.place.size());
    return std::max(least, std::sqrt(sheet.length * sheet.width / (most * places)));
  }
  static std::int64_t cells(double length, double width) {
    return std::max<std::int64_t>(1, static_cast<std::int64_t>(length / width));
  }

  std::int64_t nx_, ny_;
  double dx_, dy_;
  std::vector<std::vector<std::size_t>> in_;

  std::int64_t column(const Place& p) const {
    return std::clamp<std::int64_t>(static_cast<std::int64_t>(p[0] / dx_), 0, nx_ - 1);
  }
  std::int64_t row(const Place& p) const {
    return std::clamp<std::int64_t>(static_cast<std::int64_t>(p[1] / dy_), 0, ny_ - 1);
  }
  std::size_t cell_of(const Place& p) const { return static_cast<std::size_t>(column(p) * ny_ + row(p)); }
};

}  // namespace

double Crowd::widest() const { return *std::max_element(radius_.begin(), radius_.end()); }

std::vector<Crowd::Pair> Crowd::close_pairs(double skin) const {
  const Grid grid(sheet_, 2 * widest() + skin);
  std::vector<Pair> pairs;
  for (std::size_t a = 0; a < size(); ++a)
    grid.near(sheet_.place[a], [&](std::size_t b) {
      const double reach = radius_[a] + radius_[b] + skin;
      if (a < b && squared(sheet_.way(sheet_.place[a], sheet_.place[b])) < reach * reach)
        pairs.push_back({a, b});
    });
  return pairs;
}

/// As if all radii were `room` times as large.
double Crowd::push_apart(double room, int most) {
  const double skin = 0.5 * widest();
  std::vector<Pair> pairs;
  double deepest = 0, moved = skin;  // since the pairs were found, of the fastest
  for (int k = 0; k < most; ++k) {
    if (2 * moved >= skin) pairs = close_pairs(skin), moved = 0;
    deepest = 0;
    double farthest = 0;
    for (const auto [a, b] : pairs) {
      auto &p = sheet_.place[a], &q = sheet_.place[b];
      const auto way = sheet_.way(p, q);
      const double distance = std::sqrt(squared(way)), reach = room * (radius_[a] + radius_[b]);
      if (distance >= reach) continue;
      deepest = std::max(deepest, (reach - distance) / reach);
      const double push = 0.5 * (reach - distance);
      // Two at the same place part along x.
      const Place out = distance > 0 ? Place{way[0] / distance, way[1] / distance} : Place{1, 0};
      p = {p[0] - push * out[0], p[1] - push * out[1]};
      q = {q[0] + push * out[0], q[1] + push * out[1]};
      farthest = std::max(farthest, push);
    }
    // A disc may have been pushed by several others at once.
    constexpr double neighbours = 4;
    moved += neighbours * farthest;
    if (deepest < tolerance) break;
  }
  for (auto& p : sheet_.place) p = sheet_.wrapped(p);
  return deepest;
}

/// The middles of holes wider than `reach`, the widest first, no two closer than `apart`.
std::vector<Place> Crowd::largest_holes(const Tessellation& t, double reach, double apart,
                                        std::size_t most) const {
  std::vector<Tessellation::Vertex> wide;
  for (const auto& v : t.vertices)
    if (v.distance > reach) wide.push_back(v);
  std::sort(wide.begin(), wide.end(), [](const auto& a, const auto& b) {
    return std::pair(-a.distance, a.place) < std::pair(-b.distance, b.place);
  });
  std::vector<Place> holes;
  for (const auto& v : wide) {
    if (holes.size() == most) break;
    const bool alone = std::all_of(holes.begin(), holes.end(), [&](const Place& other) {
      return squared(sheet_.way(other, v.place)) > apart * apart;
    });
    if (alone) holes.push_back(v.place);
  }
  return holes;
}

bool Crowd::draw_in(double reach) {
  constexpr int most_rounds = 400, few_pushes = 10;
  constexpr double further = 1e-3;  // than needed, in parts of the reach: or the last bit would take for ever
  for (int round = 0; round < most_rounds; ++round) {
    const auto t = tessellate(sheet_);
    bool holes = false;
    for (const auto& v : t.vertices) {
      if (v.distance <= reach) continue;
      holes = true;
      const double draw = (v.distance - (1 - further) * reach) / v.distance;
      for (const auto i : v.of) {
        auto& p = sheet_.place[i];
        const auto way = sheet_.way(p, v.place);
        p = {p[0] + draw * way[0], p[1] + draw * way[1]};
      }
    }
    const double deepest = push_apart(1, few_pushes);
    if (!holes && deepest < tolerance) return true;
  }
  return false;
}

void Crowd::add_in_holes(std::size_t count, double radius) {
  while (size() < count) {
    const auto t = tessellate(sheet_);
    double largest = 0;
    for (const auto& v : t.vertices) largest = std::max(largest, v.distance);
    // Holes nearly as wide as the widest, far from each other, are filled at once: one by one comes to the same.
    constexpr double nearly = 0.95;
    for (const auto& hole : largest_holes(t, nearly * largest, independent * radius, count - size()))
      add(hole, radius);
    push_apart();
  }
}

}  // namespace chute::beds
