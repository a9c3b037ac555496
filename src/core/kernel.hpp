#pragma once

/// Loops over arrays, compiled several times and chosen once by what the processor can do, so that one binary
/// is fast everywhere. A kernel is a small struct that names the arrays it reads and writes, with one loop in
/// operator(). Contraction is off and the loops hold no reductions over floating-point numbers, so all
/// variants give the same bytes; a test holds them to that.
namespace chute {

enum class Isa { baseline, avx2, avx512 };

/// The widest variant that this processor runs.
inline Isa best_isa() {
  static const Isa best = [] {
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
        __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw"))
      return Isa::avx512;
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") ? Isa::avx2 : Isa::baseline;
  }();
  return best;
}

namespace detail {
template <class Kernel>
[[gnu::target("arch=x86-64-v4,prefer-vector-width=512"), gnu::flatten, gnu::noinline]] void run_avx512(
    const Kernel& kernel) {
  kernel();
}
template <class Kernel>
[[gnu::target("arch=x86-64-v3"), gnu::flatten, gnu::noinline]] void run_avx2(const Kernel& kernel) {
  kernel();
}
template <class Kernel>
[[gnu::flatten, gnu::noinline]] void run_baseline(const Kernel& kernel) {
  kernel();
}
}  // namespace detail

template <class Kernel>
void run_kernel(Isa isa, const Kernel& kernel) {
  switch (isa) {
    case Isa::avx512:
      return detail::run_avx512(kernel);
    case Isa::avx2:
      return detail::run_avx2(kernel);
    case Isa::baseline:
      return detail::run_baseline(kernel);
  }
}

/// Tells the vectoriser that the arrays of a kernel do not overlap. Goes right before the loop.
#define CHUTE_VECTOR_LOOP _Pragma("GCC ivdep")

}  // namespace chute
