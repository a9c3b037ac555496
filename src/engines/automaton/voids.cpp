#include "engines/automaton/voids.hpp"

#include <algorithm>
#include <cmath>

namespace chute::automaton {

Voids::Voids(const VoidsSetup& setup)
    : setup_(setup),
      links_(cut_links(setup.lattice, setup.walls)),
      kind_(setup.lattice.sites(), nothing),
      band_(kind_.size(), 0),
      left_(kind_.size(), 0),
      right_(kind_.size(), 0) {
  first_ = static_cast<int>(std::lround(setup.orifice_x - 0.5 * static_cast<double>(setup.orifice)));
  for (int y = 0; y < setup_.lattice.rows; ++y) {
    Random random(setup_.seed, Purpose::start, static_cast<std::uint64_t>(y));
    for (int x = 0; x < setup_.lattice.columns; ++x) {
      const auto drawn = drawn_kind(random);
      if (Lattice::place(x, y)[1] > setup_.fill_high || !links_.inside[at(x, y)]) continue;
      kind_[at(x, y)] = drawn;
      band_[at(x, y)] = static_cast<std::uint8_t>(y / band_rows % 2);
    }
  }
}

std::uint8_t Voids::drawn_kind(Random& random) const {
  return random.uniform() < setup_.small ? small : large;
}

/// The grain in direction k (1 or 2, upwards) that could fall into (x, y), −1 if there is none.
std::int64_t Voids::above(int x, int y, int k) const {
  if (links_.blocked[at(x, y)] >> k & 1) return -1;
  const auto to = setup_.lattice.neighbour(x, y, k);
  return to >= 0 && kind_[static_cast<std::size_t>(to)] != nothing ? to : -1;
}

void Voids::climb(int x, int y, Random& random) {
  const double heavy[] = {0, 1, setup_.bias};
  for (;;) {
    const auto here = at(x, y);
    const auto right = above(x, y, 1), left = above(x, y, 2);
    if (right < 0 && left < 0) break;
    const double of_right = right < 0 ? 0 : heavy[kind_[static_cast<std::size_t>(right)]];
    const double of_left = left < 0 ? 0 : heavy[kind_[static_cast<std::size_t>(left)]];
    const bool to_right = random.uniform() * (of_right + of_left) < of_right;
    const auto from = static_cast<std::size_t>(to_right ? right : left);
    kind_[here] = kind_[from], band_[here] = band_[from];
    ++(to_right ? left_ : right_)[from];
    kind_[from] = nothing;
    x = static_cast<int>(from % static_cast<std::size_t>(setup_.lattice.columns)), ++y;
    if (y == setup_.lattice.rows) y = 0;
  }
  if (setup_.refill && y + 1 == setup_.lattice.rows) {
    kind_[at(x, y)] = drawn_kind(random);
    band_[at(x, y)] = static_cast<std::uint8_t>(updates_ / (band_rows * setup_.lattice.columns) % 2);
    ++in_;
  }
}

void Voids::update(std::int64_t update) {
  Random random(setup_.seed, Purpose::engine, 0, static_cast<std::uint64_t>(update));
  ++updates_;
  const int x = (first_ + static_cast<int>(random.uniform() * static_cast<double>(setup_.orifice)) +
                 setup_.lattice.columns) %
                setup_.lattice.columns;
  if (kind_[at(x, 0)] == nothing) return;
  kind_[at(x, 0)] = nothing;
  ++left_[at(x, 0)];
  ++out_;
  climb(x, 0, random);
}

std::vector<std::pair<std::string, double>> Voids::tells() const {
  double mass = 0, surface = 0;
  for (int y = 0; y < setup_.lattice.rows; ++y)
    for (int x = 0; x < setup_.lattice.columns; ++x)
      if (occupied(x, y)) ++mass, surface = std::max(surface, Lattice::place(x, y)[1]);
  return {{"mass", mass},
          {"flux", updates_ > 0 ? static_cast<double>(out_) / static_cast<double>(updates_) : 0},
          {"left", static_cast<double>(out_)},
          {"refilled", static_cast<double>(in_)},
          {"surface", surface}};
}

/// Velocities are means over the run: how often a grain left the site, and where to.
void Voids::show(Grains<2>& grains) const {
  const double per = updates_ > 0 ? 1 / static_cast<double>(updates_) : 0;
  for (int y = 0; y < setup_.lattice.rows; ++y)
    for (int x = 0; x < setup_.lattice.columns; ++x) {
      if (!occupied(x, y)) continue;
      const double radius = kind_[at(x, y)] == small ? 0.35 : 0.5;
      grains.add(Lattice::place(x, y), radius, 1, 0.4 * radius * radius, true);
      const double to_left = per * static_cast<double>(left_[at(x, y)]),
                   to_right = per * static_cast<double>(right_[at(x, y)]);
      grains.velocity[0].back() = 0.5 * (to_right - to_left);
      grains.velocity[1].back() = -row_height * (to_left + to_right);
      grains.material.back() = kind_[at(x, y)] == small ? 2 : band_[at(x, y)];
    }
}

}  // namespace chute::automaton
