#include "engines/monte_carlo/slots.hpp"

#include <algorithm>
#include <numbers>
#include <numeric>

namespace chute::monte_carlo {
namespace {

/// No more grains than this, of diameters from `smallest` on, have their centres in a box of these widths.
template <int D>
std::size_t most_in(const Vec<D>& widths, double smallest) {
  // Four discs fit only with their centres in the corners until the diagonal lets a fifth in between, and eight spheres.
  double widest = 0;
  for (int k = 0; k < D; ++k) widest = std::max(widest, widths[k]);
  if (D == 2 && widest < std::numbers::sqrt2 * smallest) return 4;
  if (D == 3 && widest < 2 / std::numbers::sqrt3 * smallest) return 8;
  // Their bodies lie in a box that is wider by one diameter, and no packing is denser than the triangular or the face-centred one.
  double room = D == 2 ? std::numbers::pi / std::sqrt(12.0) : std::numbers::pi / std::sqrt(18.0);
  for (int k = 0; k < D; ++k) room *= widths[k] + smallest;
  const double body = D == 2 ? std::numbers::pi / 4 * smallest * smallest
                             : std::numbers::pi / 6 * smallest * smallest * smallest;
  return static_cast<std::size_t>(room / body);
}

}  // namespace

template <int D>
void Slots<D>::fill(const Grains<D>& grains, const Domain<D>& domain, const Extent<D>& extent) {
  domain_ = domain;
  radius_ = grains.radius;
  const double mean =
      std::accumulate(radius_.begin(), radius_.begin() + static_cast<std::ptrdiff_t>(grains.moving), 0.0) /
      static_cast<double>(grains.moving);
  const auto giants = std::ranges::count_if(radius_, [&](double r) { return r > giant_size * mean; });
  giant_from_ = giants <= static_cast<std::ptrdiff_t>(most_giants) ? giant_size * mean
                                                                   : std::numeric_limits<double>::infinity();
  double smallest = std::numeric_limits<double>::infinity();
  largest_ordinary_ = 0;
  for (const double r : radius_)
    if (!(r > giant_from_))
      largest_ordinary_ = std::max(largest_ordinary_, r), smallest = std::min(smallest, r);

  // In a thin gas cells are so wide that there are not many more of them than grains.
  Vec<D> length{};
  double volume = 1;
  for (int k = 0; k < D; ++k) {
    lower_[k] = domain.lower[k];
    length[k] = domain.length[k];
    if (!domain.periodic(k)) {
      constexpr double margin = 1.5;  // room for grains that rise before cells are laid again
      lower_[k] = extent.low[k];
      length[k] = margin * (extent.high[k] - extent.low[k]) + 4 * largest_ordinary_;
    }
    volume *= length[k];
  }
  constexpr double cells_per_grain = 2.5;
  const double least =
      std::max(2 * largest_ordinary_ * (1 + 1e-12),
               std::pow(volume / (cells_per_grain * static_cast<double>(grains.size())), 1.0 / D));
  std::size_t total = 1;
  bool bounded = true;
  for (int k = 0; k < D; ++k) {
    const auto a = static_cast<std::size_t>(k);
    count_[a] = std::max(1, static_cast<int>(length[k] / least));
    width_[k] = length[k] / count_[a];
    inverse_width_[k] = 1 / width_[k];
    total *= static_cast<std::size_t>(count_[a]);
    bounded = bounded && domain.periodic(k);
  }
  // Unbounded directions fold onto themselves, and a cell holds more than one place's grains.
  capacity_ = most_in<D>(width_, 2 * smallest) + (bounded ? 0 : 4);
  capacity_ = (capacity_ + 3) / 4 * 4;
  slots_.assign(total * capacity_ * (D + 1), 0);
  for (std::size_t cell = 0; cell < total; ++cell)
    for (std::size_t s = 0; s < D * capacity_; ++s) slots_[cell * capacity_ * (D + 1) + s] = nowhere;
  held_.assign(total, 0);
  ids_.assign(total * capacity_, 0);
  slot_of_.assign(grains.size(), 0);
  giants_.clear();
  for (std::size_t i = 0; i < grains.size(); ++i) {
    const auto place = grains.place(i);
    if (is_giant(i))
      giants_.push_back({i, place, radius_[i]});
    else
      put(i, place, number(cell_of(place)));
  }
}

template <int D>
void Slots<D>::put(std::size_t i, const Vec<D>& place, std::size_t cell) {
  const std::size_t slot = cell * capacity_ + static_cast<std::size_t>(held_[cell]++);
  if (static_cast<std::size_t>(held_[cell]) > capacity_) {
    // A start that overlaps can fill a cell beyond what fits; whoever fills looks for overlaps next, and a slot more
    // is enough to find one. Here the last slot is written again.
    held_[cell] = static_cast<int>(capacity_);
    slot_of_[i] = static_cast<std::int32_t>(slot - 1);
    return;
  }
  ids_[slot] = static_cast<std::int32_t>(i);
  slot_of_[i] = static_cast<std::int32_t>(slot);
  for (std::size_t k = 0; k < D; ++k) coordinate(slot, k) = place[static_cast<int>(k)];
  coordinate(slot, D) = radius_[i];
}

template <int D>
bool Slots<D>::move(std::size_t i, const Vec<D>& place, const Cell& cell) {
  if (is_giant(i)) {
    for (auto& g : giants_)
      if (g.id == i) g.place = place;
    return true;
  }
  const auto to = number(cell), slot = static_cast<std::size_t>(slot_of_[i]), from = slot / capacity_;
  if (from == to) {
    for (std::size_t k = 0; k < D; ++k) coordinate(slot, k) = place[static_cast<int>(k)];
    return true;
  }
  if (static_cast<std::size_t>(held_[to]) == capacity_) return false;
  const std::size_t last = from * capacity_ + static_cast<std::size_t>(--held_[from]);
  const auto other = ids_[last];
  for (std::size_t k = 0; k <= D; ++k) coordinate(slot, k) = coordinate(last, k);
  ids_[slot] = other;
  slot_of_[static_cast<std::size_t>(other)] = static_cast<std::int32_t>(slot);
  for (std::size_t k = 0; k < D; ++k) coordinate(last, k) = nowhere;
  put(i, place, to);
  return true;
}

/// For a giant: every cell that it reaches, wherever its images are.
template <int D>
bool Slots<D>::overlaps_wide(const Vec<D>& place, double radius) const {
  Cell first{}, many{};
  for (int k = 0; k < D; ++k) {
    const auto a = static_cast<std::size_t>(k);
    const double reach = radius + largest_ordinary_;
    const auto low = static_cast<int>(std::floor((place[k] - reach - lower_[k]) * inverse_width_[k]));
    const auto high = static_cast<int>(std::floor((place[k] + reach - lower_[k]) * inverse_width_[k]));
    many[a] = std::min(high - low + 1, count_[a]);
    first[a] = ((low % count_[a]) + count_[a]) % count_[a];
  }
  const auto any = [&](std::size_t cell) {
    const double* block = &slots_[cell * capacity_ * (D + 1)];
    for (int s = 0; s < held_[cell]; ++s) {
      Vec<D> other;
      for (int k = 0; k < D; ++k)
        other[k] = block[static_cast<std::size_t>(k) * capacity_ + static_cast<std::size_t>(s)];
      const double contact = radius + block[D * capacity_ + static_cast<std::size_t>(s)];
      if (apart(place, other) < contact * contact) return true;
    }
    return false;
  };
  Cell cell{};
  const auto along = [&](auto&& self, std::size_t k) -> bool {
    if (k == D) return any(number(cell));
    for (int n = 0; n < many[k]; ++n) {
      cell[k] = (first[k] + n) % count_[k];
      if (self(self, k + 1)) return true;
    }
    return false;
  };
  return along(along, 0);
}

template class Slots<2>;
template class Slots<3>;

}  // namespace chute::monte_carlo
