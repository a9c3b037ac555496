#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/vec.hpp"

namespace chute::automaton {

/// The six directions of the triangular lattice, e_k = (cos kπ/3, sin kπ/3), and on them in whole numbers of e_0 and e_1.
inline constexpr int directions = 6;
inline constexpr double row_height = 0.8660254037844386;  ///< √3/2
inline constexpr std::array<std::array<int, 2>, 6> axial{
    {{1, 0}, {0, 1}, {-1, 1}, {-1, 0}, {0, -1}, {1, -1}}};
inline Vec<2> unit_step(int k) {
  const auto& e = axial[static_cast<std::size_t>(k)];
  return {{e[0] + 0.5 * e[1], row_height * e[1]}};
}
inline constexpr int opposite(int k) { return (k + 3) % directions; }

/// A triangular lattice of `columns` × `rows` sites a unit apart. Odd rows are shifted by half a unit, so site (x, y) lies
/// at (x + ½ (y mod 2) + ¼, (y + ½) √3/2), and the lattice fills [0, columns] × [0, rows √3/2].
struct Lattice {
  int columns = 1, rows = 1;
  bool periodic_x = true, periodic_y = false;

  std::size_t sites() const { return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows); }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(x);
  }
  static Vec<2> place(int x, int y) { return {{x + 0.25 + 0.5 * (y & 1), (y + 0.5) * row_height}}; }

  /// The neighbour in direction k, −1 where the lattice ends.
  std::int64_t neighbour(int x, int y, int k) const {
    const int odd = y & 1;
    const std::array<int, 6> across{1, odd, odd - 1, -1, odd - 1, odd}, up{0, 1, 1, 0, -1, -1};
    int to_x = x + across[static_cast<std::size_t>(k)], to_y = y + up[static_cast<std::size_t>(k)];
    if (to_x < 0 || to_x >= columns) {
      if (!periodic_x) return -1;
      to_x += to_x < 0 ? columns : -columns;
    }
    if (to_y < 0 || to_y >= rows) {
      if (!periodic_y) return -1;
      to_y += to_y < 0 ? rows : -rows;
    }
    return static_cast<std::int64_t>(index(to_x, to_y));
  }
};

}  // namespace chute::automaton
