#pragma once
#include <cstddef>
#include <functional>

namespace chute::experiments {

/// Calls work(k) for k in [0, count), up to `jobs` side by side. Each call must write to a place of its own;
/// then the result does not depend on `jobs`. The first exception stops the rest and is thrown on.
void for_each(std::size_t count, int jobs, const std::function<void(std::size_t)>& work);

}  // namespace chute::experiments
