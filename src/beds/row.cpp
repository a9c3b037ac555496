#include "beds/row.hpp"

#include "core/random.hpp"

namespace chute::beds {

Ground DisorderedRow::lay(const Site& site) const {
  const auto gap = [&](std::int64_t i) {
    return Random(site.seed, Purpose::bed, static_cast<std::uint64_t>(i)).uniform(0, gap_max);
  };
  return line(gap, gap_max / 2, gap_max);
}

}  // namespace chute::beds
