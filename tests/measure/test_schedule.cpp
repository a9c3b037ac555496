#include <catch2/catch.hpp>

#include "measure/schedule.hpp"

namespace schedule_tests {
using namespace chute::measure;

TEST_CASE("due steps are the nearest to each time, none twice, none left out") {
  const double dt = 0.013, from = 0.5, every = 0.1;
  const Schedule schedule(from, every, dt);
  std::int64_t step = 0;
  for (std::int64_t k = 0; k < 300; ++k) {
    const auto next = schedule.after(step);
    CHECK(next > step);
    CHECK(std::abs(static_cast<double>(next) * dt - (from + static_cast<double>(k) * every)) <=
          dt / 2 * (1 + 1e-9));
    CHECK(schedule.index_at(next) == k);
    for (auto between = step + 1; between < next; ++between) CHECK(schedule.index_at(between) == -1);
    step = next;
  }
}

TEST_CASE("without a schedule nothing is ever due") {
  const Schedule never;
  CHECK(never.after(5) == std::numeric_limits<std::int64_t>::max());
  CHECK(never.index_at(0) == -1);
}

TEST_CASE("the start is due when the schedule begins there") {
  CHECK(Schedule(0, 1, 0.1).index_at(0) == 0);
  CHECK(Schedule(0, 1, 0.1).after(0) == 10);
  CHECK(Schedule(0.5, 1, 0.1).index_at(0) == -1);
}

}  // namespace schedule_tests
