#pragma once
// Philox alone needs no vector instructions, and their headers are a third of what a file that draws numbers would read.
#define R123_USE_SSE 0
#include <Random123/philox.h>

#include <array>
#include <boost/random/normal_distribution.hpp>
#include <cstdint>

namespace chute {

/// What random numbers are for. Each purpose has numbers of its own, so that asking for more of one kind does not
/// change the others: the same seed gives the same bed under another start.
enum class Purpose : std::uint8_t {
  bed = 1,
  sizes = 2,
  start = 3,
  stochastic = 4,
  bootstrap = 5,
  engine = 6,
  inflow = 7
};

/// Random numbers that are a function of where they are used, not of what was drawn before: Philox4x32-10 (Salmon et
/// al. 2011, doi:10.1145/2063384.2063405) of the key `seed` and the counter (purpose, item, step, draw). An object of
/// this class only counts the draws of one item (a grain, a cell) in one step. So there is no stream to save, and the
/// same numbers come whatever the number of threads, the order of the work, or a restart.
///
/// It is a generator of 64-bit numbers as the standard and Boost want them. Boost's distributions, unlike the standard
/// library's, are the same numbers on every platform.
class Random {
 public:
  using result_type = std::uint64_t;

  /// `step` below 2⁵⁶; `item` below 2³².
  Random(std::uint64_t seed, Purpose purpose, std::uint64_t item = 0, std::uint64_t step = 0)
      : key_{{low(seed), high(seed)}},
        counter_{{0, low(item), low(step), high(step) << 8 | static_cast<std::uint32_t>(purpose)}} {}

  static constexpr result_type min() { return 0; }
  static constexpr result_type max() { return ~result_type{0}; }
  result_type operator()() {
    if (left_ == 0) {
      block_ = r123::Philox4x32()(counter_, key_);
      ++counter_.v[0];
      left_ = 2;
    }
    const auto at = 4 - 2 * static_cast<std::size_t>(left_--);
    return std::uint64_t{block_.v[at]} | std::uint64_t{block_.v[at + 1]} << 32;
  }

  /// Evenly in [0, 1), in steps of 2⁻⁵³.
  double uniform() { return static_cast<double>((*this)() >> 11) * 0x1p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Gaussian with mean 0 and standard deviation 1.
  double normal() { return boost::random::normal_distribution<double>{}(*this); }

 private:
  r123::Philox4x32::key_type key_;
  r123::Philox4x32::ctr_type counter_, block_{};
  int left_ = 0;  // numbers of the block that were not given out yet

  static std::uint32_t low(std::uint64_t x) { return static_cast<std::uint32_t>(x); }
  static std::uint32_t high(std::uint64_t x) { return static_cast<std::uint32_t>(x >> 32); }
};

}  // namespace chute
