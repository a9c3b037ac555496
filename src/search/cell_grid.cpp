#include <algorithm>
#include <cmath>

#include "search/pairs.hpp"

namespace chute::search {
namespace {

template <int D>
bool within(const Grains<D>& grains, const Domain<D>& domain, std::size_t i, std::size_t j, double skin) {
  if (grains.independent && j < grains.moving) return false;
  const double reach = grains.radius[i] + grains.radius[j] + skin;
  const auto way = domain.way(grains.place(i), grains.place(j));
  return dot(way, way) < reach * reach;
}

/// A box of cells around all grains; a cell is at least as wide as the farthest pair that may touch.
template <int D>
struct Layout {
  Vec<D> lower{}, width{};
  std::array<int, D> count{};

  Layout(const Grains<D>& grains, const Domain<D>& domain, double skin) {
    const double reach = 2 * *std::max_element(grains.radius.begin(), grains.radius.end()) + skin;
    // A grain far away must not cost memory: no more cells than a few per grain.
    const double most = std::pow(4.0 * static_cast<double>(grains.size()) + 64, 1.0 / D) * 4;
    for (int k = 0; k < D; ++k) {
      double length = domain.length[k];
      lower[k] = domain.lower[k];
      if (!domain.periodic(k)) {
        const auto [low, high] = std::minmax_element(grains.position[k].begin(), grains.position[k].end());
        lower[k] = *low;
        length = std::max(*high - *low, reach) * (1 + 1e-12);
      }
      count[k] = static_cast<int>(std::clamp(std::floor(length / reach), 1.0, most));
      width[k] = length / count[k];
    }
  }
  int total() const {
    int n = 1;
    for (int k = 0; k < D; ++k) n *= count[k];
    return n;
  }
  int index_along(int k, double x) const {
    return std::clamp(static_cast<int>(std::floor((x - lower[k]) / width[k])), 0, count[k] - 1);
  }
  /// Is there a period of fewer than three cells?
  bool narrow(const Domain<D>& domain) const {
    for (int k = 0; k < D; ++k)
      if (domain.periodic(k) && count[k] < 3) return true;
    return false;
  }
  /// look(first, last) for all cells next to `home` and itself, by ranges of cells with consecutive numbers.
  template <class Look>
  void for_neighbours(const Domain<D>& domain, const std::array<int, D>& home, const Look& look) const {
    constexpr int lines = D == 2 ? 3 : 9, along = D - 1;
    for (int line = 0; line < lines; ++line) {
      auto cell = home;
      bool inside = true;
      for (int k = 0, w = line; k < along; ++k, w /= 3) {
        cell[k] += w % 3 - 1;
        if (domain.periodic(k))
          cell[k] = (cell[k] + count[k]) % count[k];
        else
          inside = inside && cell[k] >= 0 && cell[k] < count[k];
      }
      if (!inside) continue;
      const int base = flat(cell) - cell[along], c = home[along], last = count[along] - 1;
      look(base + std::max(c - 1, 0), base + std::min(c + 1, last));
      if (!domain.periodic(along)) continue;
      if (c == 0) look(base + last, base + last);
      if (c == last) look(base, base);
    }
  }
  int flat(const std::array<int, D>& c) const {
    int n = 0;
    for (int k = 0; k < D; ++k) n = n * count[k] + c[k];
    return n;
  }
};

/// Few numbers by their ranks, for the branches of a sort would be guessed wrong; many by the library.
template <class Out>
void sort_into(Out out, const std::int32_t* numbers, std::size_t count) {
  constexpr std::size_t few = 24;
  if (count > few) {
    std::copy_n(numbers, count, out);
    std::sort(out, out + static_cast<std::ptrdiff_t>(count));
    return;
  }
  for (std::size_t k = 0; k < count; ++k) {
    std::int32_t rank = 0;
    for (std::size_t m = 0; m < k; ++m) rank += numbers[m] <= numbers[k];
    for (std::size_t m = k + 1; m < count; ++m) rank += numbers[m] < numbers[k];
    out[rank] = numbers[k];
  }
}

}  // namespace

template <int D>
void CellGrid<D>::find(const Grains<D>& grains, const Domain<D>& domain, double skin, PairNames& pairs,
                       Team& team) {
  const Layout<D> layout(grains, domain, skin);
  const std::size_t n = grains.size();
  const auto cell_at = [&](std::size_t i) {
    std::array<int, D> c;
    for (int k = 0; k < D; ++k) c[k] = layout.index_along(k, grains.position[k][i]);
    return c;
  };

  // Sort grains by cell: count, then place.
  start_.assign(static_cast<std::size_t>(layout.total()) + 1, 0);
  member_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    ++start_[static_cast<std::size_t>(layout.flat(cell_at(i))) + 1];
  }
  for (std::size_t c = 1; c < start_.size(); ++c) start_[c] += start_[c - 1];
  for (std::size_t i = n; i-- > 0;) {  // backwards through the grains: ids ascend within a cell
    const auto cell = static_cast<std::size_t>(layout.flat(cell_at(i))) + 1;
    member_[static_cast<std::size_t>(--start_[cell])] = {grains.place(i), grains.radius[i],
                                                         static_cast<std::int32_t>(i)};
  }
  // After the loop start_[c + 1] is where cell c begins; the end of cell c is the begin of c + 1.
  const auto begin_of = [&](int c) {
    return static_cast<std::size_t>(start_[static_cast<std::size_t>(c) + 1]);
  };
  const auto end_of = [&](int c) {
    return static_cast<std::size_t>(c) + 2 < start_.size()
               ? static_cast<std::size_t>(start_[static_cast<std::size_t>(c) + 2])
               : n;
  };

  const auto find_of = [&](std::size_t i, std::vector<std::int32_t>& row, PairNames& found) {
    std::size_t size = 0;
    const auto home = cell_at(i);
    const auto here = grains.place(i);
    const double own = grains.radius[i] + skin;
    const auto first_other = static_cast<std::int32_t>(grains.independent ? grains.moving : i + 1);
    const auto look = [&](int first, int last) {  // through cells that follow on each other
      const std::size_t begin = begin_of(first), end = end_of(last);
      if (row.size() < size + end - begin) row.resize(2 * (size + end - begin));
      // Each is written, and counts if it is near: a branch would be guessed wrong every third time.
      for (std::size_t m = begin; m < end; ++m) {
        const auto& other = member_[m];
        const auto way = domain.way(here, other.place);
        const double reach = own + other.radius;
        row[size] = other.id;
        size += (other.id >= first_other) & (dot(way, way) < reach * reach);
      }
    };
    layout.for_neighbours(domain, home, look);
    const auto old_end = static_cast<std::ptrdiff_t>(found.j.size());
    found.j.resize(found.j.size() + size);
    const auto begin = found.j.begin() + old_end;
    sort_into(begin, row.data(), size);
    // with fewer than three periodic cells a neighbour can appear twice
    if (layout.narrow(domain)) found.j.erase(std::unique(begin, found.j.end()), found.j.end());
    found.i.resize(found.j.size(), static_cast<std::int32_t>(i));
  };
  row_.resize(team.size());
  parts_.resize(team.size() - 1);
  team.split(grains.moving, [&](Part range, std::size_t k) {
    PairNames& found = k == 0 ? pairs : parts_[k - 1];
    found.clear();
    found.reserve(grains.moving * (D == 2 ? 4 : 10));  // about what a dense flow has
    for (std::size_t i = range.begin; i < range.end; ++i) find_of(i, row_[k], found);
  });
  for (const auto& part : parts_) pairs.append(part);
}

template <int D>
void all_pairs(const Grains<D>& grains, const Domain<D>& domain, double skin, PairNames& pairs) {
  pairs.clear();
  for (std::size_t i = 0; i < grains.moving; ++i)
    for (std::size_t j = i + 1; j < grains.size(); ++j)
      if (within(grains, domain, i, j, skin)) pairs.add(i, j);
}

template class CellGrid<2>;
template class CellGrid<3>;
template void all_pairs(const Grains<2>&, const Domain<2>&, double, PairNames&);
template void all_pairs(const Grains<3>&, const Domain<3>&, double, PairNames&);

}  // namespace chute::search
