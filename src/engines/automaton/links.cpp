#include "engines/automaton/links.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace chute::automaton {
namespace {

double crossed(const Vec<2>& a, const Vec<2>& b) { return a[0] * b[1] - a[1] * b[0]; }

/// A little more than rounding, in lattice units: a wall that ends exactly on a link, or goes through a site, cuts it.
constexpr double touch = 1e-9;

/// Does the way from `from` along `step` pass the wall?
bool passes(const Wall<2>& wall, const Vec<2>& from, const Vec<2>& step) {
  if (const auto* segment = wall.bounded()) {
    const Vec<2> along = 2 * segment->half, start = wall.point - segment->half;
    const double det = crossed(step, along);
    if (det == 0) return false;
    const Vec<2> way = start - from;
    const double t = crossed(way, along) / det, s = crossed(way, step) / det;
    return t > -touch && t < 1 + touch && s > -touch && s < 1 + touch;
  }
  // Heights count inside of planes and circles.
  return (wall.height(from) >= 0) != (wall.height(from + step) >= 0);
}

/// The mirror of the wall near a place, if the lattice has it: a line at angle α mirrors direction φ to 2α − φ.
std::optional<int> mirror_of(const Wall<2>& wall, const Vec<2>& place) {
  const Vec<2> n = wall.nearest(place, 0, {}).normal;
  const double twice = 2 * (std::atan2(n[1], n[0]) + std::numbers::pi / 2) / (std::numbers::pi / 3);
  if (std::abs(twice - std::round(twice)) > 1e-6) return {};
  return (static_cast<int>(std::lround(twice)) % directions + directions) % directions;
}

/// Mirrors of the lattice's own edges: along a row, and upright.
constexpr int level = 0, upright = 3;

bool is_bit(unsigned mask, int k) { return mask >> k & 1u; }

/// A mirror is good if every blocked direction comes back on a link whose other end cannot send anybody in.
bool fits(unsigned blocked, int mirror) {
  for (int k = 0; k < directions; ++k)
    if (is_bit(blocked, k) && !is_bit(blocked, opposite((mirror - k + directions) % directions)))
      return false;
  return true;
}

}  // namespace

Links cut_links(const Lattice& lattice, const std::vector<Wall<2>>& walls) {
  Links links;
  links.blocked.assign(lattice.sites(), 0);
  links.inside.assign(lattice.sites(), 1);
  links.of_row.resize(static_cast<std::size_t>(lattice.rows));
  for (int y = 0; y < lattice.rows; ++y)
    for (int x = 0; x < lattice.columns; ++x) {
      const Vec<2> place = Lattice::place(x, y);
      unsigned blocked = 0;
      std::optional<int> mirror;
      bool same = true;
      const auto cut = [&](int k, std::optional<int> by) {
        same = same && by && (!mirror || *mirror == *by);
        if (by) mirror = by;
        blocked |= 1u << k;
      };
      for (int k = 0; k < directions; ++k) {
        if (lattice.neighbour(x, y, k) < 0) {
          const bool side = k == 0 || k == 3;
          const int to_y = y + (k == 1 || k == 2) - (k == 4 || k == 5);
          cut(k, side || (to_y >= 0 && to_y < lattice.rows) ? upright : level);
        }
        for (const auto& wall : walls)
          if (passes(wall, place, unit_step(k))) cut(k, mirror_of(wall, place));
      }
      const auto at = lattice.index(x, y);
      for (const auto& wall : walls)
        if (!wall.bounded() && wall.height(place) < 0) links.inside[at] = 0;
      links.blocked[at] = static_cast<std::uint8_t>(blocked);
      if (blocked)
        links.of_row[static_cast<std::size_t>(y)].push_back(
            {x, static_cast<std::uint8_t>(blocked), same && fits(blocked, *mirror) ? *mirror : -1});
    }
  return links;
}

}  // namespace chute::automaton
