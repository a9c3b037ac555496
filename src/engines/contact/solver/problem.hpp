#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/vec.hpp"

namespace chute::contact {

/// A D × D matrix, row by row: what an impulse at one contact does to the velocity at another.
template <int D>
struct Block {
  std::array<double, static_cast<std::size_t>(D* D)> c{};
  constexpr double& operator()(int row, int column) { return c[static_cast<std::size_t>(row * D + column)]; }
  constexpr double operator()(int row, int column) const {
    return c[static_cast<std::size_t>(row * D + column)];
  }
  bool operator==(const Block&) const = default;
};

template <int D>
constexpr Vec<D> operator*(const Block<D>& a, const Vec<D>& x) {
  Vec<D> y;
  for (int row = 0; row < D; ++row)
    for (int column = 0; column < D; ++column) y[row] += a(row, column) * x[column];
  return y;
}

/// A frictional contact problem: m contacts, the impulses r unknown, contact by contact and in each contact
/// normal first (units of mass × velocity):
///
///   u = W r + q            the relative velocities at the contacts after the impulses, q those without
///   0 ≤ r_n ⟂ u_n ≥ 0      nothing penetrates, nothing pulls
///   |r_t| ≤ μ r_n          Coulomb: u_t = 0 inside the cone; on its edge u_t = −λ r_t, λ ≥ 0
///
/// W is the Delassus matrix HᵀM⁻¹H, kept by rows of blocks.
template <int D>
struct Problem {
  std::vector<std::size_t> row_starts{0};  ///< m + 1: where the blocks of each row begin
  std::vector<std::uint32_t> columns;      ///< of each block; ascending in a row
  std::vector<Block<D>> blocks;            ///< the diagonal ones are all there
  std::vector<Vec<D>> q;                   ///< m
  std::vector<double> friction;            ///< m: μ ≥ 0

  std::size_t size() const { return q.size(); }
  /// The block of row and column i, with its place.
  std::size_t diagonal(std::size_t i) const {
    auto k = row_starts[i];
    while (columns[k] != i) ++k;
    return k;
  }
  /// u = W r + q.
  std::vector<Vec<D>> velocities(std::span<const Vec<D>> r) const {
    std::vector<Vec<D>> u(q);
    for (std::size_t i = 0; i < size(); ++i)
      for (auto k = row_starts[i]; k < row_starts[i + 1]; ++k) u[i] = u[i] + blocks[k] * r[columns[k]];
    return u;
  }
};

}  // namespace chute::contact
