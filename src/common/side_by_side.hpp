#pragma once
#include <cstddef>
#include <functional>

namespace chute {

/// Told the part done, 0 to 1; answers whether to go on.
using Report = std::function<bool(double part)>;

/// Does `count` independent pieces of work, up to `jobs` of them at a time, in threads. `work(k, report)`
/// does piece k and reports how much of it is done. The first error stops all and is thrown again; WorkError
/// if `progress` asks to stop.
void side_by_side(std::size_t count, int jobs, const Report& progress,
                  const std::function<void(std::size_t k, const Report& report)>& work);

}  // namespace chute
