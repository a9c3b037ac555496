#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace chute::event {

/// Every moving grain's next event, the earliest first; events at the same time come in the order of the grains. A
/// calendar (R. Brown 1988; G. Paul, J. Comput. Phys. 221 (2007) 615): time is cut into days, an event waits on the
/// page of its day, unsorted, and only the events up to the present day are kept sorted, in a heap of a few. So a
/// change costs the same however many grains there are. How long a day is costs or saves time only.
class EventQueue {
 public:
  static constexpr double never = std::numeric_limits<double>::infinity();

  /// Begins anew with the grains' events; none may be before those that were taken.
  void start(const std::vector<double>& times);
  void set(std::size_t grain, double time) {
    take_out(grain);
    events_[grain].time = time;
    put_in(static_cast<std::int32_t>(grain));
    if (++changes_ >= retune_after_) start_again();
  }
  bool empty() const { return events_.empty(); }

  struct Entry {
    double time;
    std::size_t grain;
  };
  /// The earliest; its time is `never` where nothing will happen.
  Entry next() {
    if (heap_.empty()) turn_pages();
    if (heap_.empty()) return {never, 0};
    return {event(heap_.front()).time, index(heap_.front())};
  }

 private:
  static constexpr std::int32_t none = -1;
  static constexpr std::int32_t in_heap = -1;  // instead of a page

  struct Event {
    double time;
    std::int32_t page, next, previous;  // where it waits, and beside whom
    std::int32_t place;                 // in the heap
  };
  std::vector<Event> events_;        // of each grain
  std::vector<std::int32_t> first_;  // of each page; the last page is for what is far away
  std::vector<std::int32_t> heap_;   // events up to the present day
  double origin_ = 0, days_per_time_ = 0;
  std::int64_t today_ = 0;  // since the origin
  std::int64_t pages_ = 0;  // a power of two
  std::int64_t changes_ = 0, retune_after_ = 0;

  static std::size_t index(std::int32_t k) { return static_cast<std::size_t>(k); }
  Event& event(std::int32_t grain) { return events_[index(grain)]; }
  const Event& event(std::int32_t grain) const { return events_[index(grain)]; }
  void start_again();
  bool before(std::int32_t a, std::int32_t b) const {
    const double s = event(a).time, t = event(b).time;
    return s != t ? s < t : a < b;
  }
  void put_in(std::int32_t grain);
  void take_out(std::size_t grain);
  void chain(std::int32_t grain, std::int64_t page);
  void push(std::int32_t grain);
  void rise(std::size_t place);
  void sink(std::size_t place);
  void turn_pages();
  void open(std::int64_t page);
};

}  // namespace chute::event
