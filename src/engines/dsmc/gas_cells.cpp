#include "engines/dsmc/gas_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "common/error.hpp"
#include "engines/dsmc/hard_gas.hpp"

namespace chute::dsmc {
namespace {

/// How much of a step's packing goes into the average that says whether the gas is too dense: a single step's is noisy.
constexpr double newest = 0.02;

/// Places along each direction at which a cell is asked whether it is free.
constexpr int probes = 8;

/// Cells per grain at most: beyond, where hardly a grain is, they fly freely. At the start a finer grid is refused.
constexpr std::size_t most_per_grain = 20, fewest_cells = 100000;

}  // namespace

std::optional<std::string> too_many_cells(double cells, std::size_t grains) {
  if (cells <= static_cast<double>(std::max(fewest_cells, most_per_grain * grains))) return {};
  return fmt::format("makes {:.3g} cells, at most {} and {} a grain are possible; use a larger one", cells,
                     fewest_cells, most_per_grain);
}

template <int D>
GasCells<D>::GasCells(const Grains<D>& grains, const DsmcSetup<D>& setup, const Obstacles<D>& obstacles)
    : setup_(setup), obstacles_(obstacles), counts_(static_cast<std::size_t>(setup.threads)) {
  mean_content_ = 0;
  mean_radius_ = std::accumulate(grains.radius.begin(),
                                 grains.radius.begin() + static_cast<std::ptrdiff_t>(grains.moving), 0.0) /
                 static_cast<double>(grains.moving);
  for (std::size_t i = 0; i < grains.moving; ++i)
    mean_content_ += content<D>(grains.radius[i]) / static_cast<double>(grains.moving);
  equal_ =
      std::all_of(grains.radius.begin(), grains.radius.begin() + static_cast<std::ptrdiff_t>(grains.moving),
                  [&](double R) { return R == grains.radius[0]; });
  for (int k = 0; k < D; ++k) lay(k, grains);
  double cells = 1;
  for (const int n : many_) cells *= n;
  if (const auto why = too_many_cells(cells, grains.moving)) throw InputError("engine.cell: " + *why);
  add_volumes();
  cell_.resize(grains.moving), order_.resize(grains.moving);
}

/// Where cells begin along direction k, and how many there are at first.
template <int D>
void GasCells<D>::lay(int k, const Grains<D>& grains) {
  const auto a = static_cast<std::size_t>(k);
  const auto cells_in = [&](double length) {
    const double many = length / setup_.cell;
    if (!(many < 0.5 * std::numeric_limits<int>::max()))
      throw InputError("engine.cell: " + too_many_cells(many, 0).value());
    return static_cast<int>(many);
  };
  if (setup_.domain.periodic(k)) {
    many_[a] = std::max(1, cells_in(setup_.domain.length[k]));
    low_[k] = setup_.domain.lower[k];
    side_[k] = setup_.domain.length[k] / many_[a];
  } else {
    const auto& x = grains.position[a];
    const auto [least, most] =
        std::minmax_element(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(grains.moving));
    double low = *least, high = *most;
    bool floor = false, ceiling = false;
    for (const auto& wall : setup_.walls) {
      if (wall.bounded() || wall.cylinder() || std::abs(wall.normal[k]) < 1 - 1e-12) continue;
      if (wall.normal[k] > 0)
        low = std::max(floor ? low : wall.point[k] + mean_radius_, wall.point[k] + mean_radius_),
        floor = true;
      else
        high = std::min(ceiling ? high : wall.point[k] - mean_radius_, wall.point[k] - mean_radius_),
        ceiling = true;
    }
    // A bed of beads is a floor, too: no centre gets below the lowest bead's.
    if (k == D - 1 && !floor && grains.moving < grains.size()) {
      low = *std::min_element(x.begin() + static_cast<std::ptrdiff_t>(grains.moving), x.end());
      floor = true;
    }
    if (floor && ceiling) {
      many_[a] = std::max(1, cells_in(high - low));
      side_[k] = (high - low) / many_[a];
    } else {
      many_[a] = cells_in(high - low) + 2;
      side_[k] = setup_.cell;
      if (!floor) low -= 0.5 * setup_.cell;
      if (ceiling) low = high - many_[a] * side_[k];
      grows_ = grows_ || (k == D - 1 && !ceiling);
    }
    low_[k] = low;
  }
  inverse_[k] = 1 / side_[k];
}

template <int D>
double GasCells<D>::free_part(const Vec<D>& corner) const {
  double diagonal = 0;
  Vec<D> middle = corner;
  for (int k = 0; k < D; ++k) diagonal += side_[k] * side_[k] / 4, middle[k] += side_[k] / 2;
  if (!obstacles_.near(middle, std::sqrt(diagonal), mean_radius_)) return 1;
  int free = 0, all = 1;
  for (int k = 0; k < D; ++k) all *= probes;
  for (int p = 0; p < all; ++p) {
    Vec<D> place = corner;
    int rest = p;
    for (int k = 0; k < D; ++k, rest /= probes) place[k] += (rest % probes + 0.5) / probes * side_[k];
    free += obstacles_.free(place, mean_radius_);
  }
  return static_cast<double>(free) / all;
}

/// Volumes of cells that have none yet. Those that nobody can be in get a little, so that nothing is divided by 0.
template <int D>
void GasCells<D>::add_volumes() {
  constexpr double least = 1e-3;
  double whole = 1;
  std::size_t cells = 1;
  for (int k = 0; k < D; ++k)
    whole *= side_[k], cells *= static_cast<std::size_t>(many_[static_cast<std::size_t>(k)]);
  for (std::size_t c = volume_.size(); c < cells; ++c) {
    const Index at = index(c);
    Vec<D> corner = low_;
    for (int k = 0; k < D; ++k) corner[k] += at[static_cast<std::size_t>(k)] * side_[k];
    volume_.push_back(whole * std::max(least, free_part(corner)));
  }
  phi_.resize(cells, 0);
}

/// Adds layers up to the highest grain. The last direction is the slowest, so cells keep their numbers.
template <int D>
void GasCells<D>::grow(const Grains<D>& grains) {
  const auto& z = grains.position[D - 1];
  const double top = *std::max_element(z.begin(), z.begin() + static_cast<std::ptrdiff_t>(grains.moving));
  const std::size_t layer = volume_.size() / static_cast<std::size_t>(many_[D - 1]);
  const std::size_t most = std::max(fewest_cells, most_per_grain * grains.moving) / layer;
  const double wanted = std::floor((top - low_[D - 1]) * inverse_[D - 1]) + 1;
  if (!(wanted > many_[D - 1])) return;
  many_[D - 1] = static_cast<int>(std::min(
      wanted, static_cast<double>(std::max<std::size_t>(most, static_cast<std::size_t>(many_[D - 1])))));
  add_volumes();
}

template <int D>
void GasCells<D>::fill(const Grains<D>& grains, Team& team) {
  if (grows_) grow(grains);
  const std::size_t cells = count();
  start_.assign(cells + 1, 0);
  content_.assign(cells, 0);
  now_.resize(cells), share_.resize(cells);
  team.split(grains.moving, [&](Part part, std::size_t k) {
    auto& mine = counts_[k];
    mine.assign(cells, 0);
    for (std::size_t i = part.begin; i < part.end; ++i) {
      cell_[i] = cell_of(grains.place(i));
      if (cell_[i] != outside) ++mine[cell_[i]];
    }
  });
  // Where each thread's grains of a cell begin: threads have ids in order, so a cell's grains are in order of ids.
  std::uint32_t at = 0;
  for (std::size_t c = 0; c < cells; ++c) {
    start_[c] = at;
    for (std::size_t k = 0; k < team.size(); ++k) at += std::exchange(counts_[k][c], at);
  }
  start_[cells] = at;
  team.split(grains.moving, [&](Part part, std::size_t k) {
    for (std::size_t i = part.begin; i < part.end; ++i)
      if (cell_[i] != outside) order_[counts_[k][cell_[i]]++] = static_cast<std::uint32_t>(i);
  });
  const double one = setup_.weight * content<D>(grains.radius[0]);
  team.split(cells, [&](Part part, std::size_t) {
    for (std::size_t c = part.begin; c < part.end; ++c) {
      if (equal_) {
        content_[c] = one * static_cast<double>(members(c).size());
        continue;
      }
      for (const auto i : members(c)) content_[c] += setup_.weight * content<D>(grains.radius[i]);
    }
  });
  team.split(cells, [&](Part part, std::size_t) {
    for (std::size_t c = part.begin; c < part.end; ++c) {
      double filled = 0, room = 0;
      around(c, [&](std::size_t other) { filled += content_[other], room += volume_[other]; });
      now_[c] = filled / room, share_[c] = setup_.weight * mean_content_ / room;
      phi_[c] += (settled_ ? newest : 1) * (now_[c] - phi_[c]);
    }
  });
  settled_ = true;
}

template <int D>
double GasCells<D>::crowding(std::size_t cell) const {
  const double phi = std::clamp(now_[cell] - 2 * share_[cell], 0.0, densest);
  return std::max(1.0, chi<D>(phi) - 0.5 * chi_bend<D>(phi) * phi * share_[cell]);
}

template <int D>
double GasCells<D>::densest_packing() const {
  return phi_.empty() ? 0 : *std::max_element(phi_.begin(), phi_.end());
}

template class GasCells<2>;
template class GasCells<3>;

}  // namespace chute::dsmc
