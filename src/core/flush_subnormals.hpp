#pragma once
#include <xmmintrin.h>

namespace chute {

/// While it lives, this thread takes numbers below 2⁻¹⁰²² as 0, in and out (the bits flush-to-zero and
/// denormals-are-zero of MXCSR). The derivatives that a predictor-corrector keeps of a grain in free flight decay into
/// such numbers, and several processors compute with them a hundred times more slowly. Measuring, files and drawing
/// happen outside, with numbers as IEEE has them.
class FlushSubnormals {
 public:
  FlushSubnormals() : before_(_mm_getcsr()) { _mm_setcsr(before_ | flush_to_zero | denormals_are_zero); }
  ~FlushSubnormals() { _mm_setcsr(before_); }
  FlushSubnormals(const FlushSubnormals&) = delete;
  FlushSubnormals& operator=(const FlushSubnormals&) = delete;

 private:
  static constexpr unsigned flush_to_zero = 0x8000, denormals_are_zero = 0x0040;
  unsigned before_;
};

}  // namespace chute
