#pragma once
#include <cereal/types/vector.hpp>

#include "core/random.hpp"
#include "engines/automaton/links.hpp"
#include "engines/automaton/model.hpp"

namespace chute::automaton {

struct VoidsSetup {
  Lattice lattice;
  std::vector<Wall<2>> walls;
  double orifice_x = 0;      ///< middle of the opening in the lowest row
  std::int64_t orifice = 1;  ///< sites wide
  double fill_high = 1e300;  ///< height up to which sites are filled
  bool refill = false;       ///< a void that reaches the highest row is filled from above
  double small = 0;          ///< part of the grains that are small
  double bias = 1;           ///< a small grain falls into a void so many times as readily as a large one
  std::uint64_t seed = 1;
};

/// Voids that rise through a hopper (Litwiniszyn; Caram & Hong, Phys. Rev. Lett. 67, 828 (1991); Fitt & Wilmott, Phys. Rev. A
/// 45, 2383 (1992)). In an update a grain leaves by the opening, and its void climbs: it changes places with the grain at its
/// upper left or at its upper right, each with probability ½ (or by `bias`, where sizes differ), until there is none and it
/// has reached the surface.
class Voids final : public SavedModel<Voids> {
 public:
  explicit Voids(const VoidsSetup& setup);

  void update(std::int64_t update) override;
  void show(Grains<2>& grains) const override;
  std::vector<std::pair<std::string, double>> tells() const override;

  const Lattice& lattice() const { return setup_.lattice; }
  /// How many grains have left site (x, y) downwards so far.
  std::int64_t fallen(int x, int y) const { return left_[at(x, y)] + right_[at(x, y)]; }
  bool occupied(int x, int y) const { return kind_[at(x, y)] != nothing; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(kept(kind_), kept(band_), kept(left_), kept(right_), updates_, out_, in_);
  }

 private:
  static constexpr std::uint8_t nothing = 0, large = 1, small = 2;
  static constexpr int band_rows = 10;  // grains that start in the same so many rows have one colour
  VoidsSetup setup_;
  Links links_;
  std::vector<std::uint8_t> kind_, band_;
  std::vector<std::int64_t> left_, right_;  // grains that fell out of a site to its lower left and right
  std::int64_t updates_ = 0, out_ = 0, in_ = 0;
  int first_ = 0;  // column of the opening's left end

  std::size_t at(int x, int y) const { return setup_.lattice.index(x, y); }
  std::uint8_t drawn_kind(Random& random) const;
  std::int64_t above(int x, int y, int k) const;
  void climb(int x, int y, Random& random);
};

}  // namespace chute::automaton
