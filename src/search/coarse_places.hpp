#pragma once
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/domain.hpp"
#include "core/grains.hpp"

namespace chute::search {

/// Where grains are, coarsely: each coordinate as a 32-bit fraction of a period, two of them in a word. It
/// halves what has to be gathered to tell that two grains do not touch, and a difference of two fractions
/// wraps around the period by itself. The period only has to be longer than what the grains of a pair can be
/// apart: it is about 4 times that, and in a periodic direction a whole part of the domain's length.
///
/// A fraction is wrong by half a `quantum`, a way from one grain to another by at most two: one from the
/// ends, one from a carry between the two numbers of a word. Whoever decides by it must leave the `margin`.
template <int D>
struct CoarsePlaces {
  static constexpr int words = (D + 1) / 2;
  using Word = std::vector<std::uint64_t, CacheAligned<std::uint64_t>>;

  std::array<Word, words> word;
  Vec<D> lower{};
  Vec<D> per_length{};  ///< 2³² / period
  Vec<D> quantum{};     ///< period / 2³²
  double margin = 0;    ///< how wrong the square of a way up to `longest_way` can be

  bool ready() const { return margin > 0; }
  /// For grains of a pair that are at most `longest_way` apart.
  void set_up(const Domain<D>& domain, double longest_way) {
    for (int k = 0; k < D; ++k) {
      double period = 4 * longest_way;
      if (domain.periodic(k))
        period = domain.length[k] / std::max(1.0, std::floor(domain.length[k] / period));
      lower[k] = domain.lower[k];
      per_length[k] = 0x1p32 / period;
      quantum[k] = period * 0x1p-32;
    }
    const double wrong = 3 * norm(quantum);  // with something to spare for rounding
    margin = wrong * (2 * longest_way + wrong);
  }

  /// One coordinate, counted in quanta from the lower bound, as the low half of the result. Exact to rounding
  /// for up to 2⁵⁰ quanta: adding 1.5 · 2⁵² leaves the integer in the low bits of a double.
  static std::uint64_t fraction(double quanta) {
    return std::bit_cast<std::uint64_t>(quanta + 0x1.8p52) & 0xffffffffU;
  }
  static constexpr double most_quanta = 0x1p50;

  /// The difference of two fractions, each in the low half, as a number of quanta in [−2³¹, 2³¹).
  static double quanta(std::uint64_t biased) {
    return std::bit_cast<double>(biased | 0x4330000000000000U) - 0x1.000008p52;
  }
};

}  // namespace chute::search
