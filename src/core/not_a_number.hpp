#pragma once
#include <cstddef>

namespace chute {

/// A grain's place is not a number. The engine, which knows the time, turns it into a WorkError.
struct NotANumber {
  std::size_t grain;
};

}  // namespace chute
