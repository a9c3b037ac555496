#pragma once
#include <utility>
#include <vector>

#include "core/contact.hpp"
#include "core/random.hpp"
#include "engines/dsmc/gas_cells.hpp"

namespace chute::dsmc {

/// The collisions of a step: pairs drawn by chance from cells, as often as free flight would bring them together.
///
/// In a cell of N grains and volume V, ½ N (N − 1) w χ d^(D−1) v Δt/V ∫Θ(v̂·σ̂)(v̂·σ̂)dσ̂ pairs of relative velocity v are due.
/// That many candidates are drawn for v_max, no slower than any pair of the cell, and each is accepted with probability
/// v/v_max (Bird's no-time-counter); the direction σ̂ of an accepted one, from i to j, is as likely as its component along v.
template <int D>
class CellCollisions {
 public:
  CellCollisions(const Grains<D>& grains, const DsmcSetup<D>& setup);

  /// Collides all cells, in the given step.
  Tally collide(Grains<D>& grains, const GasCells<D>& cells, std::uint64_t step, Team& team);
  /// With partners a diameter away collisions carry momentum over that way: then they are kept for whoever wants the stress.
  void collect(bool on) { collecting_ = on && setup_.dense == Dense::esmc; }
  std::vector<Collision> take() { return std::exchange(kept_, {}); }

 private:
  const DsmcSetup<D>& setup_;
  bool rough_;         // spins matter
  double widest_ = 1;  // twice the largest radius
  bool equal_ = true;  // all radii
  bool alike_ = true;  // and masses and moments of inertia
  struct Chunk {
    Tally tally;
    std::vector<Collision> kept;
  };
  std::vector<Chunk> of_chunk_;
  bool collecting_ = false;
  std::vector<Collision> kept_;
  struct Buffer {
    std::vector<Vec<D>> velocity;
    std::vector<Vec<turns<D>>> spin;
  };
  std::vector<Buffer> buffers_;  // of each thread

  void fetch_ahead(const Grains<D>& grains, const GasCells<D>& cells, std::size_t cell) const;
  laws::Collider<D> collider(const Grains<D>& grains, std::size_t i, const Vec<D>& v) const;
  void in_cell(Grains<D>& grains, const GasCells<D>& cells, std::size_t cell, std::uint64_t step,
               Buffer& buffer, Tally& tally) const;
  void with_neighbours(Grains<D>& grains, const GasCells<D>& cells, std::size_t cell, std::uint64_t step,
                       Chunk& mine) const;
  Tally collide_coloured(Grains<D>& grains, const GasCells<D>& cells, std::uint64_t step, Team& team);
};

}  // namespace chute::dsmc
