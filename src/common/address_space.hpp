#pragma once
#include <sys/resource.h>

#include <cstddef>

namespace chute {

/// This process may take so many bytes of addresses. Not where a sanitizer is compiled in: it reserves terabytes for its
/// notes at any time.
inline void limit_address_space([[maybe_unused]] std::size_t bytes) {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  const rlimit memory{bytes, RLIM_INFINITY};
  ::setrlimit(RLIMIT_AS, &memory);
#endif
}

}  // namespace chute
