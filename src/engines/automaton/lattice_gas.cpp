#include "engines/automaton/lattice_gas.hpp"

#include <bit>
#include <cmath>

#include "core/random.hpp"

namespace chute::automaton {
namespace {

/// Items of random numbers besides rows: walls' sites, and sites at the start.
constexpr std::uint64_t for_walls = std::uint64_t{1} << 31;

/// Streaming of a row: each bit comes from the site that lies against its direction.
struct Stream {
  const Site *here, *below, *above;
  Site* to;
  std::size_t columns;
  std::ptrdiff_t odd;  // 1 in odd rows, which are shifted to the right

  void operator()() const {
    CHUTE_VECTOR_LOOP
    for (std::size_t x = 0; x < columns; ++x) {
      const auto at = static_cast<std::ptrdiff_t>(x);
      const unsigned moved = (here[at - 1] & 1u) | (below[at - 1 + odd] & 2u) | (below[at + odd] & 4u) |
                             (here[at + 1] & 8u) | (above[at + odd] & 16u) | (above[at - 1 + odd] & 32u);
      to[at] = static_cast<Site>(moved | (here[at] & 192u));
    }
  }
};

}  // namespace

LatticeGas::LatticeGas(const LatticeGasSetup& setup)
    : setup_(setup),
      table_(setup.rule),
      links_(cut_links(setup.lattice, setup.walls)),
      stride_(static_cast<std::size_t>(setup.lattice.columns) + 2 * edge),
      now_(stride_ * static_cast<std::size_t>(setup.lattice.rows), 0),
      next_(now_.size(), 0),
      empty_(stride_, 0),
      row_lost_(static_cast<std::size_t>(setup.lattice.rows)),
      row_crossed_(row_lost_.size()),
      words_(static_cast<std::size_t>(setup.threads)),
      team_(setup.threads) {
  for (const auto& row : links_.of_row) kept_.emplace_back(row.size());
  const auto columns = static_cast<std::size_t>(setup_.lattice.columns);
  for (auto& words : words_) words.resize((columns + words_at_once - 1) / words_at_once * words_at_once);
  fill();
}

void LatticeGas::fill() {
  for (int y = 0; y < setup_.lattice.rows; ++y) {
    const double height = Lattice::place(0, y)[1];
    if (height < setup_.fill_low || height > setup_.fill_high) continue;
    Random random(setup_.seed, Purpose::start, static_cast<std::uint64_t>(y));
    for (int x = 0; x < setup_.lattice.columns; ++x) {
      unsigned moving = 0;
      for (int k = 0; k < directions; ++k)
        moving |= static_cast<unsigned>(random.uniform() < setup_.density / directions) << k;
      if (links_.inside[setup_.lattice.index(x, y)]) set(x, y, site_of(moving, 0));
    }
  }
}

void LatticeGas::update(std::int64_t update) {
  const auto rows = static_cast<std::size_t>(setup_.lattice.rows);
  const auto part = [&](std::size_t k) {
    return Part{rows * k / team_.size(), rows * (k + 1) / team_.size()};
  };
  team_.run([&](std::size_t k) {
    for (auto y = part(k).begin; y < part(k).end; ++y) collide_row(static_cast<int>(y), update, words_[k]);
  });
  team_.run([&](std::size_t k) {
    for (auto y = part(k).begin; y < part(k).end; ++y) stream_row(static_cast<int>(y));
  });
  now_.swap(next_);
  crossed_ = 0;
  for (std::size_t y = 0; y < rows; ++y) lost_ += row_lost_[y], crossed_ += row_crossed_[y];
}

void LatticeGas::collide_row(int y, std::int64_t update, std::span<std::uint32_t> words) {
  philox_row(isa_, setup_.seed, static_cast<std::uint32_t>(y), static_cast<std::uint64_t>(update), words);
  const auto columns = static_cast<std::size_t>(setup_.lattice.columns);
  Site* sites = &now_[row(y) + edge];
  unsigned lost = 0;
  for (std::size_t x = 0; x < columns; ++x) {
    const unsigned entry = table_(sites[x], words[x]);
    sites[x] = static_cast<Site>(entry);
    lost += entry >> 8;
  }
  row_lost_[static_cast<std::size_t>(y)] = lost;
  turn_back(y, update);
  // The other end's sites, for whoever streams past the ends. Closed ends have walls, which let nobody out.
  sites[-1] = setup_.lattice.periodic_x ? sites[columns - 1] : Site{0};
  sites[columns] = setup_.lattice.periodic_x ? sites[0] : Site{0};
  const int out = std::popcount(sites[columns - 1] & 1u), in = std::popcount(sites[0] & 8u);
  // Of the slanted links over x = 0 each belongs to the row from which it leaves.
  const unsigned right = y & 1 ? 1u << 1 | 1u << 5 : 0u, left = y & 1 ? 0u : 1u << 2 | 1u << 4;
  row_crossed_[static_cast<std::size_t>(y)] =
      setup_.lattice.periodic_x
          ? out - in + std::popcount(sites[columns - 1] & right) - std::popcount(sites[0] & left)
          : 0;
}

/// Takes movers that a wall stops out of the row, and keeps how they come back.
void LatticeGas::turn_back(int y, std::int64_t update) {
  const auto& at_walls = links_.of_row[static_cast<std::size_t>(y)];
  auto& kept = kept_[static_cast<std::size_t>(y)];
  Site* sites = &now_[row(y) + edge];
  for (std::size_t w = 0; w < at_walls.size(); ++w) {
    const auto& wall = at_walls[w];
    const unsigned stopped = sites[wall.x] & wall.blocked;
    kept[w] = 0;
    if (!stopped) continue;
    sites[wall.x] = static_cast<Site>(sites[wall.x] & ~stopped);
    bool reversed = wall.mirror < 0;
    if (!reversed) {
      Random random(setup_.seed, Purpose::engine, for_walls + setup_.lattice.index(wall.x, y),
                    static_cast<std::uint64_t>(update));
      reversed = random.uniform() < setup_.reversal;
    }
    for (int k = 0; k < directions; ++k)
      if (stopped >> k & 1u)
        kept[w] = static_cast<Site>(
            kept[w] | 1u << (reversed ? opposite(k) : (wall.mirror - k + directions) % directions));
  }
}

void LatticeGas::stream_row(int y) {
  const int rows = setup_.lattice.rows;
  // Beyond closed ends nobody comes in: links there are cut, so what the other end's row holds must not be seen.
  const auto line = [&](int at) -> const Site* {
    if (at < 0 || at >= rows) {
      if (!setup_.lattice.periodic_y) return nullptr;
      at += at < 0 ? rows : -rows;
    }
    return &now_[row(at) + edge];
  };
  const Site *below = line(y - 1), *above = line(y + 1);
  Site* to = &next_[row(y) + edge];
  run_kernel(isa_, Stream{&now_[row(y) + edge], below ? below : &empty_[edge], above ? above : &empty_[edge],
                          to, static_cast<std::size_t>(setup_.lattice.columns), y & 1});
  const auto& at_walls = links_.of_row[static_cast<std::size_t>(y)];
  for (std::size_t w = 0; w < at_walls.size(); ++w)
    to[at_walls[w].x] = static_cast<Site>(to[at_walls[w].x] | kept_[static_cast<std::size_t>(y)][w]);
}

namespace {
struct Totals {
  std::int64_t mass = 0, moving = 0;
  std::array<std::int64_t, directions> along{};
  Vec<2> momentum() const {
    Vec<2> sum{};
    for (int k = 0; k < directions; ++k)
      sum = sum + static_cast<double>(along[static_cast<std::size_t>(k)]) * unit_step(k);
    return sum;
  }
};
Totals totals_of(std::span<const std::int64_t, 256> count) {
  Totals totals;
  for (unsigned s = 0; s < site_states; ++s) {
    const auto n = count[s];
    totals.moving += n * std::popcount(s & 63u);
    totals.mass += n * (std::popcount(s & 63u) + static_cast<int>(s >> 6));
    for (unsigned k = 0; k < directions; ++k) totals.along[k] += n * (s >> k & 1u);
  }
  return totals;
}
}  // namespace

static std::array<std::int64_t, 256> census(const LatticeGas& gas) {
  std::array<std::int64_t, 256> count{};
  for (int y = 0; y < gas.lattice().rows; ++y)
    for (int x = 0; x < gas.lattice().columns; ++x) ++count[gas.at(x, y)];
  return count;
}

std::vector<std::pair<std::string, double>> LatticeGas::tells() const {
  const auto totals = totals_of(census(*this));
  const Vec<2> p = totals.momentum();
  return {{"mass", static_cast<double>(totals.mass)},
          {"moving", static_cast<double>(totals.moving)},
          {"momentum_x", p[0]},
          {"momentum_y", p[1]},
          {"flux", static_cast<double>(crossed_)},
          {"dissipated", 0.5 * static_cast<double>(lost_)}};
}

Model::Energy LatticeGas::energy() const {
  return {0.5 * static_cast<double>(totals_of(census(*this)).moving), 0.5 * static_cast<double>(lost_)};
}

void LatticeGas::show(Grains<2>& grains) const {
  for (int y = 0; y < setup_.lattice.rows; ++y)
    for (int x = 0; x < setup_.lattice.columns; ++x) {
      const Site site = at(x, y);
      if (!site) continue;
      Vec<2> p{};
      for (int k = 0; k < directions; ++k)
        if (site >> k & 1) p = p + unit_step(k);
      const double mass = std::popcount(unsigned{movers(site)}) + resting(site);
      grains.add(Lattice::place(x, y), 0.5, mass, 0.1 * mass, true);
      for (std::size_t k = 0; k < 2; ++k) grains.velocity[k].back() = p[static_cast<int>(k)] / mass;
      grains.material.back() = resting(site);
    }
}

}  // namespace chute::automaton
