#include <catch2/catch.hpp>
#include <set>

#include "core/random.hpp"
#include "engines/event/event_queue.hpp"

using namespace chute;
using namespace chute::event;

// A sorted set is the slow twin.
TEST_CASE("events come in the order of their times, and of their grains where times are equal") {
  Random random(3, Purpose::start);
  const double steps[] = {1e-9, 1e-3, 0.02,
                          1,    40,   1e7};  // events of grains at rest, of flights, and of far ones
  for (const std::size_t n : {1, 2, 3, 50, 1000}) {
    std::vector<double> times(n);
    std::set<std::pair<double, std::size_t>> twin;
    for (std::size_t i = 0; i < n; ++i) {
      times[i] = i % 5 == 4 ? EventQueue::never : random.uniform(0, 2);
      if (i % 7 == 0 && i > 0) times[i] = times[i - 1];
      twin.emplace(times[i], i);
    }
    EventQueue queue;
    queue.start(times);
    const auto set = [&](std::size_t i, double time) {
      twin.erase({times[i], i});
      twin.emplace(times[i] = time, i);
      queue.set(i, time);
    };
    std::size_t different = 0;
    for (int k = 0; k < 50'000; ++k) {
      const auto [time, grain] = *twin.begin();
      if (time == EventQueue::never) break;
      const auto next = queue.next();
      different += next.time != time || next.grain != grain;
      const double step = steps[static_cast<std::size_t>(random.uniform() * 6)] * random.uniform();
      set(grain, k % 11 == 0 ? EventQueue::never : k % 13 == 0 ? time : time + step);
      if (n > 1) {  // its partner's changes too, mostly to another day
        const auto other = static_cast<std::size_t>(random.uniform() * static_cast<double>(n));
        set(other, time + steps[static_cast<std::size_t>(random.uniform() * 5)] * random.uniform());
      }
    }
    CAPTURE(n);
    CHECK(different == 0);
  }
}

TEST_CASE("where nothing will happen the next event is never") {
  EventQueue queue;
  queue.start(std::vector<double>(3, EventQueue::never));
  CHECK(queue.next().time == EventQueue::never);
  queue.set(1, 7);
  CHECK(queue.next().time == 7);
  CHECK(queue.next().grain == 1);
  queue.set(1, EventQueue::never);
  CHECK(queue.next().time == EventQueue::never);
}
