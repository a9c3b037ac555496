#pragma once
#include <cstdint>
#include <vector>

#include "core/kernel.hpp"
#include "engines/automaton/site_rule.hpp"

namespace chute::automaton {

/// Sites side by side as bits of words: plane k, 0 ≤ k < 6, says which sites have a mover in direction k, and planes 6 and 7 are
/// the two bits of how many rest there. What happens at a site is then a circuit of logical operations, which does it
/// for 512 sites at once.
inline constexpr int planes = 8;
inline constexpr std::size_t sites_of_word = 64, words_of_block = 8,
                             sites_of_block = sites_of_word * words_of_block;

/// A row of sites: plane k begins at words + k × stride, and has `blocks` whole blocks.
struct PlaneRow {
  std::uint64_t* words = nullptr;
  std::size_t stride = 0, blocks = 0;
};

/// What draws a row's chances: Philox4x32-10 with the key `seed` and the counters (number, row, step, purpose), as in
/// core/random.hpp.
struct RowChances {
  std::uint64_t seed = 0;
  std::uint32_t row = 0;
  std::uint64_t step = 0;
};

/// The rule of sites made ready for planes. Probabilities are kept to 2⁻³².
class PlaneRule {
 public:
  explicit PlaneRule(const SiteRule& rule);
  /// Collides, dissipates and accelerates every site of a row, each as outcomes() has it. Returns how many movers came to
  /// rest. The same bits with every instruction set.
  std::int64_t apply(Isa isa, const PlaneRow& row, const RowChances& chances) const;

 private:
  /// An event of probability below / 2³².
  struct Chance {
    std::uint64_t below = 0;
  };
  struct Pull {
    int direction;
    Chance chance;  // of this one, if none before it was drawn
  };
  Chance dissipation_, gravity_;
  std::vector<Pull> pulls_;
  friend struct PlaneKernel;
};

}  // namespace chute::automaton
