#include "engines/automaton/philox_row.hpp"

#include <cstddef>

#include "core/random.hpp"

namespace chute::automaton {
namespace {

/// Sixteen blocks at once. Salmon et al. 2011: ten rounds of two multiplications, whose upper halves are mixed with the
/// other words and the key, which grows by constants.
struct Blocks {
  std::uint32_t key0, key1, row, step_low, last;
  std::uint32_t* out;
  std::size_t words;

  void operator()() const {
    constexpr std::size_t lanes = words_at_once / 4;
    constexpr std::uint32_t m0 = 0xD2511F53u, m1 = 0xCD9E8D57u, w0 = 0x9E3779B9u, w1 = 0xBB67AE85u;
    for (std::size_t at = 0; at < words; at += words_at_once) {
      alignas(64) std::uint32_t a[lanes], b[lanes], c[lanes], d[lanes];
      for (std::size_t k = 0; k < lanes; ++k) {
        a[k] = static_cast<std::uint32_t>(at / 4 + k);
        b[k] = row, c[k] = step_low, d[k] = last;
      }
      std::uint32_t k0 = key0, k1 = key1;
      for (int round = 0; round < 10; ++round, k0 += w0, k1 += w1) {
        CHUTE_VECTOR_LOOP
        for (std::size_t k = 0; k < lanes; ++k) {
          const std::uint64_t p0 = std::uint64_t{m0} * a[k], p1 = std::uint64_t{m1} * c[k];
          a[k] = static_cast<std::uint32_t>(p1 >> 32) ^ b[k] ^ k0;
          c[k] = static_cast<std::uint32_t>(p0 >> 32) ^ d[k] ^ k1;
          b[k] = static_cast<std::uint32_t>(p1);
          d[k] = static_cast<std::uint32_t>(p0);
        }
      }
      for (std::size_t k = 0; k < lanes; ++k) {
        out[at + 4 * k] = a[k];
        out[at + 4 * k + 1] = b[k];
        out[at + 4 * k + 2] = c[k];
        out[at + 4 * k + 3] = d[k];
      }
    }
  }
};

}  // namespace

void philox_row(Isa isa, std::uint64_t seed, std::uint32_t row, std::uint64_t step,
                std::span<std::uint32_t> words) {
  const auto high = static_cast<std::uint32_t>(step >> 32);
  run_kernel(isa,
             Blocks{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32), row,
                    static_cast<std::uint32_t>(step), high << 8 | static_cast<std::uint32_t>(Purpose::engine),
                    words.data(), words.size()});
}

}  // namespace chute::automaton
