#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/domain.hpp"
#include "core/grains.hpp"

namespace chute::monte_carlo {

/// From where to where grains lie.
template <int D>
struct Extent {
  Vec<D> low{}, high{};
  explicit Extent(const Grains<D>& grains) {
    for (int k = 0; k < D; ++k) {
      const auto& x = grains.position[static_cast<std::size_t>(k)];
      const auto [least, most] = std::minmax_element(x.begin(), x.end());
      low[k] = *least, high[k] = *most;
    }
  }
  template <class Archive>
  void serialize(Archive& archive) {
    archive(low.c, high.c);
  }
};

/// Cells that hold the places of grains themselves, in a fixed number of slots each, so that the question whether a grain
/// would overlap another is a few vector operations on memory that lies together. A cell is at least as wide as the
/// largest grain (but for giants, see below), so that whoever overlaps lies in the same cell or one next to it.
///
/// Where the domain does not repeat, cells are counted modulo their number all the same: far grains share cells with near
/// ones, which costs a little time and is never wrong, for the places tell them apart.
template <int D>
class Slots {
 public:
  using Cell = std::array<int, D>;

  /// Puts all grains in; the fixed ones, too. How many cells there are depends on `extent`, where the domain is unbounded.
  void fill(const Grains<D>& grains, const Domain<D>& domain, const Extent<D>& extent);

  int count(int k) const { return count_[static_cast<std::size_t>(k)]; }
  std::size_t cells() const { return held_.size(); }
  Cell cell_of(const Vec<D>& place) const {
    Cell cell;
    for (int k = 0; k < D; ++k) {
      const int n = count(k);
      const double at = std::floor((place[k] - lower_[k]) * inverse_width_[k]);
      int c = static_cast<int>(at);
      if (c < 0 || c >= n)
        c = domain_.periodic(k) ? (c < 0 ? 0 : n - 1) : static_cast<int>(at - n * std::floor(at / n));
      cell[static_cast<std::size_t>(k)] = c;
    }
    return cell;
  }
  std::size_t number(const Cell& cell) const {
    std::size_t n = 0;
    for (int k = 0; k < D; ++k)
      n = n * static_cast<std::size_t>(count(k)) +
          static_cast<std::size_t>(cell[static_cast<std::size_t>(k)]);
    return n;
  }
  /// Ids of the grains in a cell.
  const std::int32_t* begin(std::size_t cell) const { return &ids_[cell * capacity_]; }
  const std::int32_t* end(std::size_t cell) const { return begin(cell) + held_[cell]; }

  /// Would grain i overlap another if it were at this place, which lies in the domain?
  bool overlaps(std::size_t i, const Vec<D>& place, const Cell& cell) {
    const double radius = radius_[i];
    for (const auto& giant : giants_)
      if (giant.id != i && apart(place, giant.place) < (radius + giant.radius) * (radius + giant.radius))
        return true;
    if (is_giant(i)) return overlaps_wide(place, radius);
    Hidden hidden(*this, i);
    return overlaps_near(place, radius, cell);
  }
  bool is_giant(std::size_t i) const { return radius_[i] > giant_from_; }
  std::size_t giants() const { return giants_.size(); }
  std::size_t giant(std::size_t k) const { return giants_[k].id; }

  /// Grain i goes to this place in that cell. False: the cell has no slot left, and nothing happened.
  bool move(std::size_t i, const Vec<D>& place, const Cell& cell);

 private:
  using Four = double __attribute__((vector_size(32), may_alias));
  using Mask = long long __attribute__((vector_size(32)));
  static constexpr double nowhere = 1e150;
  /// So many grains more than twice the usual size are kept in a list of their own, because cells as wide as one intruder
  /// would hold too many of the others. With more of them cells are that wide.
  static constexpr std::size_t most_giants = 16;
  static constexpr double giant_size = 2;  // in mean radii

  struct Giant {
    std::size_t id;
    Vec<D> place;
    double radius;
  };

  Domain<D> domain_;
  Vec<D> lower_{}, width_{}, inverse_width_{};
  std::array<int, D> count_{};
  std::size_t capacity_ = 4;  // slots of a cell, a multiple of four
  Array slots_;               // of each cell: capacity_ numbers of x, then of y (z), then radii
  std::vector<int> held_;
  std::vector<std::int32_t> ids_, slot_of_;
  Array radius_;
  double giant_from_ = std::numeric_limits<double>::infinity(), largest_ordinary_ = 0;
  std::vector<Giant> giants_;

  /// Takes a grain out of sight, so that it does not find itself.
  struct Hidden {
    double& x;
    const double was;
    Hidden(Slots& slots, std::size_t i)
        : x(slots.coordinate(static_cast<std::size_t>(slots.slot_of_[i]), 0)), was(x) {
      x = nowhere;
    }
    ~Hidden() { x = was; }
  };
  double& coordinate(std::size_t slot, std::size_t k) {
    return slots_[slot / capacity_ * capacity_ * (D + 1) + k * capacity_ + slot % capacity_];
  }
  double apart(const Vec<D>& a, const Vec<D>& b) const {
    const Vec<D> way = domain_.way(a, b);
    return dot(way, way);
  }

  bool overlaps_near(const Vec<D>& place, double radius, const Cell& cell) const {
    // The three cells along each direction, and where the place lies as seen from their images.
    std::array<std::array<int, 3>, D> near;
    std::array<std::array<double, 3>, D> seen;
    for (int k = 0; k < D; ++k) {
      const auto a = static_cast<std::size_t>(k);
      const int n = count_[a], c = cell[a];
      const double period = domain_.periodic(k) ? domain_.length[k] : 0;
      near[a] = {c == 0 ? n - 1 : c - 1, c, c + 1 == n ? 0 : c + 1};
      seen[a] = {c == 0 ? place[k] + period : place[k], place[k], c + 1 == n ? place[k] - period : place[k]};
    }
    const auto block = [&](int first) -> const double* {
      return &slots_[static_cast<std::size_t>(first) * capacity_ * (D + 1)];
    };
    if constexpr (D == 2) {
      for (std::size_t x = 0; x < 3; ++x) {
        Mask hit{};
        for (std::size_t y = 0; y < 3; ++y) {
          const int c = near[0][x] * count_[1] + near[1][y];
          check(block(c), held_[static_cast<std::size_t>(c)], {{seen[0][x], seen[1][y]}}, radius, hit);
        }
        if (hit[0] | hit[1] | hit[2] | hit[3]) return true;
      }
    } else {
      // The cells beside and below come first only by habit; most trials that fail do so in the first layer.
      for (std::size_t x = 0; x < 3; ++x)
        for (std::size_t y = 0; y < 3; ++y) {
          Mask hit{};
          for (std::size_t z = 0; z < 3; ++z) {
            const int c = (near[0][x] * count_[1] + near[1][y]) * count_[2] + near[2][z];
            check(block(c), held_[static_cast<std::size_t>(c)], {{seen[0][x], seen[1][y], seen[2][z]}},
                  radius, hit);
          }
          if (hit[0] | hit[1] | hit[2] | hit[3]) return true;
        }
    }
    return false;
  }
  void check(const double* block, int held, const Vec<D>& place, double radius, Mask& hit) const {
    for (std::size_t at = 0; at < static_cast<std::size_t>(held); at += 4) {
      Four square{};
      for (std::size_t k = 0; k <= D; ++k) {
        const Four numbers = *reinterpret_cast<const Four*>(block + k * capacity_ + at);
        if (k < D) {
          const Four way = numbers - place[static_cast<int>(k)];
          square += way * way;
        } else {
          const Four contact = numbers + radius;
          hit |= square < contact * contact;
        }
      }
    }
  }
  bool overlaps_wide(const Vec<D>& place, double radius) const;
  void put(std::size_t i, const Vec<D>& place, std::size_t cell);
};

}  // namespace chute::monte_carlo
