#pragma once
#include <immintrin.h>

#include <cstddef>
#include <cstdint>

#include "core/kernel.hpp"

namespace chute {
namespace detail {

/// Eight flags at a time; a compiler does not find this loop by itself.
[[gnu::target("arch=x86-64-v4")]] inline std::size_t compress_avx512(const std::int64_t* flag,
                                                                     std::size_t count, std::int32_t base,
                                                                     std::int32_t* out) {
  std::size_t end = 0, p = 0;
  __m256i index = _mm256_add_epi32(_mm256_set1_epi32(base), _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
  for (; p + 8 <= count; p += 8) {
    const __m512i flags = _mm512_loadu_si512(flag + p);
    const __mmask8 set = _mm512_test_epi64_mask(flags, flags);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(out + end), _mm256_maskz_compress_epi32(set, index));
    end += static_cast<std::size_t>(__builtin_popcount(set));
    index = _mm256_add_epi32(index, _mm256_set1_epi32(8));
  }
  for (; p < count; ++p) {
    out[end] = base + static_cast<std::int32_t>(p);
    end += flag[p] != 0;
  }
  return end;
}

}  // namespace detail

/// Writes base + p for every flag p that is not 0 to `out`, in order, and tells how many there are. Without a
/// branch, for which are set is not predictable; so `out` needs room for `count`.
inline std::size_t compress(Isa isa, const std::int64_t* flag, std::size_t count, std::int32_t base,
                            std::int32_t* out) {
  if (isa == Isa::avx512) return detail::compress_avx512(flag, count, base, out);
  std::size_t end = 0;
  for (std::size_t p = 0; p < count; ++p) {
    out[end] = base + static_cast<std::int32_t>(p);
    end += flag[p] != 0;
  }
  return end;
}

}  // namespace chute
