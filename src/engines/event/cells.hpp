#pragma once
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "engines/hard/flight.hpp"

namespace chute::event {

using hard::Flight;

/// A grid of cells, none narrower than the farthest pair that touches, so that grains meet only in the same
/// or in neighbouring cells. Grains in flight change cells at times that are known ahead. Where the domain is
/// not periodic the outermost cells reach to infinity.
template <int D>
class Cells {
 public:
  using Cell = std::array<int, D>;

  /// Where a grain is: its cell, and how many periods its flight has gone since its place was last wrapped.
  struct Home {
    Cell cell{};
    std::array<int, D> laps{};
  };

  /// The next change of cell.
  struct Crossing {
    double time = std::numeric_limits<double>::infinity();
    int axis = 0, step = 0;
  };

  /// Lays the grid around the grains' places at time `now` and puts them in. No period may be shorter than 2
  /// `reach`, where `reach` is the largest R_i + R_j.
  void build(const std::vector<Flight<D>>& flights, const Domain<D>& domain, double reach, double now);

  /// When grain i leaves its cell. The time is not before `now`.
  Crossing crossing(std::size_t i, const Flight<D>& flight, double now) const;
  void cross(std::size_t i, const Crossing& crossing);
  /// To be called with what Flight::move_to took off.
  void unwind(std::size_t i, const std::array<int, D>& periods) {
    for (std::size_t k = 0; k < D; ++k) homes_[i].laps[k] -= periods[k];
  }

  /// Calls visit(j, shift) for every other grain j near i; `shift` is by how many periods j's flight must be
  /// moved to be seen from i's. With a crossing, only for the cells that came into sight with it.
  template <class Visit>
  void neighbours(std::size_t i, const Crossing* crossed, const Visit& visit) const {
    const Home& home = homes_[i];
    for (int way = 0; way < (D == 2 ? 9 : 27); ++way) {
      std::array<int, D> step{}, around{};
      Cell cell = home.cell;
      bool exists = true;
      for (int k = 0, w = way; k < D; ++k, w /= 3) {
        const auto axis = static_cast<std::size_t>(k);
        step[axis] = w % 3 - 1;
        cell[axis] += step[axis];
        if (cell[axis] >= 0 && cell[axis] < count_[axis]) continue;
        if (!domain_.periodic(k)) {
          exists = false;
          break;
        }
        around[axis] = cell[axis] < 0 ? -1 : 1;
        cell[axis] -= around[axis] * count_[axis];
      }
      if (!exists || (crossed && step[static_cast<std::size_t>(crossed->axis)] != crossed->step)) continue;
      for (auto j = first_[flat(cell)]; j != none; j = next_[static_cast<std::size_t>(j)]) {
        const auto other = static_cast<std::size_t>(j);
        if (other == i) continue;
        std::array<int, D> shift;
        for (std::size_t k = 0; k < D; ++k) shift[k] = around[k] + home.laps[k] - homes_[other].laps[k];
        visit(other, shift);
      }
    }
  }

  /// Whether so many moving grains left the box that the grid should be laid anew: results do not depend on
  /// it, cost does.
  bool outgrown(const std::vector<Flight<D>>& flights, std::size_t moving, double now) const;

 private:
  static constexpr std::int32_t none = -1;
  Domain<D> domain_;
  Vec<D> lower_{}, width_{};
  Cell count_{};
  std::vector<Home> homes_;
  std::vector<std::int32_t> first_, next_, previous_;  // grains of a cell, chained

  std::size_t flat(const Cell& c) const {
    std::size_t n = 0;
    for (std::size_t k = 0; k < D; ++k)
      n = n * static_cast<std::size_t>(count_[k]) + static_cast<std::size_t>(c[k]);
    return n;
  }
  void insert(std::size_t i);
  void remove(std::size_t i);
};

}  // namespace chute::event
