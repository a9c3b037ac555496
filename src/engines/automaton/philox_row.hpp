#pragma once
#include <cstdint>
#include <span>

#include "core/kernel.hpp"

namespace chute::automaton {

/// A row of random words, those of Philox4x32-10 with the counters (block, row, step, purpose) that core/random.hpp has: word
/// x is number x mod 4 of block x / 4. Many blocks are computed side by side. `words` holds a multiple of `words_at_once`.
inline constexpr std::size_t words_at_once = 64;
void philox_row(Isa isa, std::uint64_t seed, std::uint32_t row, std::uint64_t step,
                std::span<std::uint32_t> words);

}  // namespace chute::automaton
