#pragma once
#include <cstdint>

namespace chute {

/// What followed one grain that was added to a pile.
struct Avalanche {
  std::int64_t update;  ///< when, in updates
  std::int64_t size;    ///< topplings
};

}  // namespace chute
