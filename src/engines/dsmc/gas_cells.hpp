#pragma once
#include <cereal/types/vector.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/wrong_state.hpp"
#include "core/team.hpp"
#include "engines/dsmc/dsmc_setup.hpp"
#include "engines/dsmc/obstacles.hpp"

namespace chute::dsmc {

/// Why so many cells are not possible for so many grains; nothing if they are.
std::optional<std::string> too_many_cells(double cells, std::size_t grains);

/// The cells in which grains find their partners. Along a period a whole number of them fits; between two level walls they
/// fill the room of the centres; away from a floor layers are added where grains come to. Grains that leave the cells
/// elsewhere (sideways out of an unbounded domain) fly freely. Where walls and beads reach into a cell, only the part that
/// centres can be in counts as its volume.
template <int D>
class GasCells {
 public:
  using Index = std::array<int, D>;
  static constexpr std::uint32_t outside = 0xffffffff;

  GasCells(const Grains<D>& grains, const DsmcSetup<D>& setup, const Obstacles<D>& obstacles);

  /// Sorts the grains into cells, by id within each, and brings packing fractions up to date.
  void fill(const Grains<D>& grains, Team& team);

  std::size_t count() const { return volume_.size(); }
  std::span<const std::uint32_t> members(std::size_t cell) const {
    return {&order_[start_[cell]], start_[cell + 1] - start_[cell]};
  }
  double volume(std::size_t cell) const { return volume_[cell]; }
  /// χ around the cell. Grains are counted in the cell and those beside it, which are few, so that their number fluctuates:
  /// by Poisson's law, for what chance partners know nothing of is where others are. Two things follow, for which χ is
  /// corrected: a pair is more often where it is crowded by itself, so it is left out of the count (the mean of N (N − 1) f(N)
  /// is μ² times that of f(N + 2)); and the mean of χ is not χ of the mean, but more by ½ χ'' times the variance.
  double crowding(std::size_t cell) const;
  /// φ around, averaged over the last steps.
  double packing(std::size_t cell) const { return phi_[cell]; }
  double densest_packing() const;
  const Index& along() const { return many_; }
  bool periodic(int k) const { return setup_.domain.periodic(k); }
  double side(int k) const { return side_[k]; }

  std::uint32_t cell_of(const Vec<D>& place) const {
    std::size_t cell = 0;
    for (int k = D; k-- > 0;) {
      const double at = std::floor((place[k] - low_[k]) * inverse_[k]);
      const int n = many_[static_cast<std::size_t>(k)];
      if (!(at >= 0 && at < n)) {
        if (!setup_.domain.periodic(k)) return outside;
        cell =
            cell * static_cast<std::size_t>(n) + static_cast<std::size_t>(at < 0 ? 0 : n - 1);  // by rounding
      } else {
        cell = cell * static_cast<std::size_t>(n) + static_cast<std::size_t>(at);
      }
    }
    return static_cast<std::uint32_t>(cell);
  }
  Index index(std::size_t cell) const {
    Index at;
    for (std::size_t k = 0; k < D; ++k)
      at[k] = static_cast<int>(cell % static_cast<std::size_t>(many_[k])),
      cell /= static_cast<std::size_t>(many_[k]);
    return at;
  }
  std::size_t number(const Index& at) const {
    std::size_t cell = 0;
    for (std::size_t k = D; k-- > 0;)
      cell = cell * static_cast<std::size_t>(many_[k]) + static_cast<std::size_t>(at[k]);
    return cell;
  }
  /// visit(cell) for the cell and those beside it, each once.
  template <class Visit>
  void around(std::size_t cell, const Visit& visit) const {
    const Index at = index(cell);
    std::array<std::array<int, 3>, D> near{};
    std::array<int, D> n{};
    for (std::size_t k = 0; k < D; ++k)
      for (int step = -1; step <= 1; ++step) {
        int to = at[k] + step;
        if (to < 0 || to >= many_[k]) {
          if (!setup_.domain.periodic(static_cast<int>(k))) continue;
          to = (to + many_[k]) % many_[k];
        }
        bool known = false;
        for (int j = 0; j < n[k]; ++j) known = known || near[k][static_cast<std::size_t>(j)] == to;
        if (!known) near[k][static_cast<std::size_t>(n[k]++)] = to;
      }
    Index where;
    const auto go = [&](auto&& self, std::size_t k) -> void {
      if (k == D) return visit(number(where));
      for (int j = 0; j < n[k]; ++j) where[k] = near[k][static_cast<std::size_t>(j)], self(self, k + 1);
    };
    go(go, 0);
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(many_, phi_, settled_);
    std::size_t cells = 1;
    for (const auto many : many_) {
      if (many < 1 || static_cast<std::size_t>(many) > phi_.size()) wrong_state();
      cells *= static_cast<std::size_t>(many);
    }
    if (cells != phi_.size()) wrong_state();
    if (volume_.size() != phi_.size()) volume_.clear(), add_volumes();
  }

 private:
  const DsmcSetup<D>& setup_;
  const Obstacles<D>& obstacles_;
  double mean_radius_ = 0.5, mean_content_ = 1;
  Vec<D> low_{}, side_{}, inverse_{};
  Index many_{};
  bool grows_ = false;  // upwards
  bool equal_ = true;   // all grains are as large
  std::vector<double> volume_, phi_, content_;
  std::vector<double> now_, share_;  // φ of this step, and what one grain adds to it
  bool settled_ = false;             // phi_ has a past
  std::vector<std::uint32_t> cell_, order_, start_;
  std::vector<std::vector<std::uint32_t>> counts_;  // of each thread

  void lay(int k, const Grains<D>& grains);
  void grow(const Grains<D>& grains);
  void add_volumes();
  double free_part(const Vec<D>& corner) const;
};

}  // namespace chute::dsmc
