#include "engines/automaton/lattice_gas.hpp"

#include <bit>
#include <cmath>

#include "core/random.hpp"

namespace chute::automaton {
namespace {

/// Items of random numbers besides rows: walls' sites, and sites at the start.
constexpr std::uint64_t for_walls = std::uint64_t{1} << 31;

/// Streaming of a plane of a row: every bit to its neighbour, or as it is. `in` is what comes in at the end that is left
/// free; bits that leave the columns are lost.
struct Stream {
  const std::uint64_t* from;
  std::uint64_t* to;
  std::size_t words, columns;
  int step;  // +1: to the right, −1: to the left
  bool in;

  void operator()() const {
    if (step == 0) {
      for (std::size_t w = 0; w < words; ++w) to[w] = from[w];
      return;
    }
    const std::size_t last = (columns - 1) / sites_of_word, bit = (columns - 1) % sites_of_word;
    if (step > 0) {
      to[0] = from[0] << 1 | std::uint64_t{in};
      CHUTE_VECTOR_LOOP
      for (std::size_t w = 1; w < words; ++w) to[w] = from[w] << 1 | from[w - 1] >> 63;
      if (const auto beyond = columns / sites_of_word; beyond < words)
        to[beyond] &= ~(std::uint64_t{1} << columns % sites_of_word);
      return;
    }
    CHUTE_VECTOR_LOOP
    for (std::size_t w = 0; w + 1 < words; ++w) to[w] = from[w] >> 1 | from[w + 1] << 63;
    to[words - 1] = from[words - 1] >> 1;
    to[last] |= std::uint64_t{in} << bit;
  }
};

std::size_t words_for(int columns) {
  const auto sites = static_cast<std::size_t>(columns);
  return (sites + sites_of_block - 1) / sites_of_block * words_of_block;
}

}  // namespace

LatticeGas::LatticeGas(const LatticeGasSetup& setup)
    : setup_(setup),
      rule_(setup.rule),
      links_(cut_links(setup.lattice, setup.walls)),
      stride_(words_for(setup.lattice.columns)),
      now_(stride_ * planes * static_cast<std::size_t>(setup.lattice.rows), 0),
      next_(now_.size(), 0),
      empty_(stride_, 0),
      row_lost_(static_cast<std::size_t>(setup.lattice.rows)),
      row_crossed_(row_lost_.size()),
      team_(setup.threads) {
  for (const auto& row : links_.of_row) kept_.emplace_back(row.size());
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
    for (auto y = part(k).begin; y < part(k).end; ++y) collide_row(static_cast<int>(y), update);
  });
  team_.run([&](std::size_t k) {
    for (auto y = part(k).begin; y < part(k).end; ++y) stream_row(static_cast<int>(y));
  });
  now_.swap(next_);
  crossed_ = 0;
  for (std::size_t y = 0; y < rows; ++y) lost_ += row_lost_[y], crossed_ += row_crossed_[y];
}

void LatticeGas::collide_row(int y, std::int64_t update) {
  row_lost_[static_cast<std::size_t>(y)] =
      rule_.apply(isa_, {&now_[index(y, 0, 0)], stride_, stride_ / words_of_block},
                  {setup_.seed, static_cast<std::uint32_t>(y), static_cast<std::uint64_t>(update)});
  turn_back(y, update);
  // Of the slanted links over x = 0 each belongs to the row from which it leaves.
  const int last = setup_.lattice.columns - 1;
  std::int64_t crossed = has(last, y, 0) - has(0, y, 3);
  if (y & 1)
    crossed += has(last, y, 1) + has(last, y, 5);
  else
    crossed -= has(0, y, 2) + has(0, y, 4);
  row_crossed_[static_cast<std::size_t>(y)] = setup_.lattice.periodic_x ? crossed : 0;
}

/// Takes movers that a wall stops out of the row, and keeps how they come back.
void LatticeGas::turn_back(int y, std::int64_t update) {
  const auto& at_walls = links_.of_row[static_cast<std::size_t>(y)];
  auto& kept = kept_[static_cast<std::size_t>(y)];
  for (std::size_t w = 0; w < at_walls.size(); ++w) {
    const auto& wall = at_walls[w];
    const Site site = at(wall.x, y);
    const unsigned stopped = site & wall.blocked;
    kept[w] = 0;
    if (!stopped) continue;
    set(wall.x, y, static_cast<Site>(site & ~stopped));
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

/// Where a plane's bits come from: the row below, this or above, and whether x shifts there. Odd rows are shifted by half a
/// site, so along slanted links x shifts out of even rows to the left and out of odd ones to the right.
void LatticeGas::stream_row(int y) {
  constexpr std::array<int, planes> from_row{0, -1, -1, 0, 1, 1, 0, 0};
  const int rows = setup_.lattice.rows, last = setup_.lattice.columns - 1, odd = y & 1;
  const std::array<int, planes> step{1, 1 - odd, -odd, -1, -odd, 1 - odd, 0, 0};
  for (int k = 0; k < planes; ++k) {
    const auto plane_of = static_cast<std::size_t>(k);
    int from = y + from_row[plane_of];
    // Beyond closed ends nobody comes in: links there are cut, so what the other end's row holds must not be seen.
    const bool outside = from < 0 || from >= rows;
    if (outside) from += from < 0 ? rows : -rows;
    const bool seen = !outside || setup_.lattice.periodic_y;
    const bool in = seen && setup_.lattice.periodic_x && has(step[plane_of] > 0 ? last : 0, from, k);
    run_kernel(isa_, Stream{seen ? plane(from, k) : empty_.data(), &next_[index(y, k, 0)], stride_,
                            static_cast<std::size_t>(setup_.lattice.columns), step[plane_of], in});
  }
  const auto& at_walls = links_.of_row[static_cast<std::size_t>(y)];
  for (std::size_t w = 0; w < at_walls.size(); ++w)
    if (const unsigned back = kept_[static_cast<std::size_t>(y)][w])
      for (int k = 0; k < directions; ++k)
        next_[index(y, k, at_walls[w].x)] |= std::uint64_t{back >> k & 1u} << (at_walls[w].x & 63);
}

LatticeGas::Totals LatticeGas::totals() const {
  std::array<std::int64_t, planes> number{};
  for (int y = 0; y < setup_.lattice.rows; ++y)
    for (int k = 0; k < planes; ++k)
      for (std::size_t w = 0; w < stride_; ++w)
        number[static_cast<std::size_t>(k)] += std::popcount(plane(y, k)[w]);
  Totals totals;
  for (int k = 0; k < directions; ++k) {
    const auto along = number[static_cast<std::size_t>(k)];
    totals.moving += along;
    totals.momentum = totals.momentum + static_cast<double>(along) * unit_step(k);
  }
  totals.resting = number[6] + 2 * number[7];
  return totals;
}

std::vector<std::pair<std::string, double>> LatticeGas::tells() const {
  const auto all = totals();
  return {{"mass", static_cast<double>(all.moving + all.resting)},
          {"moving", static_cast<double>(all.moving)},
          {"momentum_x", all.momentum[0]},
          {"momentum_y", all.momentum[1]},
          {"flux", static_cast<double>(crossed_)},
          {"dissipated", 0.5 * static_cast<double>(lost_)}};
}

Model::Energy LatticeGas::energy() const {
  return {0.5 * static_cast<double>(totals().moving), 0.5 * static_cast<double>(lost_)};
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
