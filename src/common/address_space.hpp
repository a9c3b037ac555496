#pragma once
#include <sys/resource.h>

#include <cstddef>

// GCC says by names of its own, clang by a question, that a sanitizer is compiled in.
#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define CHUTE_SANITIZED
#endif
#elif defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define CHUTE_SANITIZED
#endif

namespace chute {

/// This process may take so many bytes of addresses. Not where a sanitizer is compiled in: it reserves terabytes for its
/// notes at any time.
inline void limit_address_space([[maybe_unused]] std::size_t bytes) {
#ifndef CHUTE_SANITIZED
  const rlimit memory{bytes, RLIM_INFINITY};
  ::setrlimit(RLIMIT_AS, &memory);
#endif
}

}  // namespace chute
