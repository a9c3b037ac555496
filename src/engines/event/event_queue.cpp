#include "engines/event/event_queue.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace chute::event {
namespace {

/// Pages for each event: with days as long as events come at first, the calendar reaches over most of them.
constexpr std::size_t pages_per_event = 2;
/// Changes, for each event, after which the length of a day is chosen anew: it costs some ten changes for each.
constexpr std::int64_t changes_per_event = 64;

}  // namespace

void EventQueue::start(const std::vector<double>& times) {
  events_.resize(times.size());
  for (std::size_t i = 0; i < times.size(); ++i) events_[i].time = times[i];
  start_again();
}

void EventQueue::start_again() {
  const std::size_t n = events_.size();
  changes_ = 0, retune_after_ = changes_per_event * static_cast<std::int64_t>(n) + 256;
  heap_.clear();
  heap_.reserve(n);  // never more: no change of an event allocates
  pages_ = static_cast<std::int64_t>(std::bit_ceil(pages_per_event * n + 1));
  first_.assign(static_cast<std::size_t>(pages_) + 1, none);
  if (n == 0) return;

  // So long that about one event falls into each of the first days: half of the events come before the median.
  std::vector<double> sorted(n);
  for (std::size_t i = 0; i < n; ++i) sorted[i] = events_[i].time;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(n / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  const double earliest = *std::min_element(sorted.begin(), middle + 1), half = *middle - earliest;
  origin_ = std::isfinite(earliest) ? earliest : 0;
  days_per_time_ = half > 0 && std::isfinite(half) ? 0.5 * static_cast<double>(n) / half : 1;
  today_ = 0;
  for (std::size_t i = 0; i < n; ++i) put_in(static_cast<std::int32_t>(i));
}

void EventQueue::put_in(std::int32_t grain) {
  const double days = (event(grain).time - origin_) * days_per_time_;
  if (!(days >= static_cast<double>(today_ + 1))) return push(grain);
  if (!(days < static_cast<double>(today_ + pages_))) return chain(grain, pages_);
  chain(grain, static_cast<std::int64_t>(days) & (pages_ - 1));
}

void EventQueue::take_out(std::size_t grain) {
  const Event& gone = events_[grain];
  if (gone.page == in_heap) {
    const auto place = index(gone.place);
    const auto last = heap_.back();
    heap_.pop_back();
    if (place == heap_.size()) return;
    heap_[place] = last;
    event(last).place = static_cast<std::int32_t>(place);
    rise(place);
    sink(index(event(last).place));
    return;
  }
  (gone.previous == none ? first_[index(gone.page)] : event(gone.previous).next) = gone.next;
  if (gone.next != none) event(gone.next).previous = gone.previous;
}

void EventQueue::chain(std::int32_t grain, std::int64_t page) {
  auto& first = first_[static_cast<std::size_t>(page)];
  Event& e = event(grain);
  e.page = static_cast<std::int32_t>(page), e.next = first, e.previous = none;
  if (first != none) event(first).previous = grain;
  first = grain;
}

void EventQueue::push(std::int32_t grain) {
  event(grain).page = in_heap;
  event(grain).place = static_cast<std::int32_t>(heap_.size());
  heap_.push_back(grain);
  rise(heap_.size() - 1);
}

void EventQueue::rise(std::size_t place) {
  const auto grain = heap_[place];
  for (; place > 0 && before(grain, heap_[(place - 1) / 2]); place = (place - 1) / 2) {
    heap_[place] = heap_[(place - 1) / 2];
    event(heap_[place]).place = static_cast<std::int32_t>(place);
  }
  heap_[place] = grain;
  event(grain).place = static_cast<std::int32_t>(place);
}

void EventQueue::sink(std::size_t place) {
  const auto grain = heap_[place];
  for (std::size_t child; (child = 2 * place + 1) < heap_.size(); place = child) {
    if (child + 1 < heap_.size() && before(heap_[child + 1], heap_[child])) ++child;
    if (!before(heap_[child], grain)) break;
    heap_[place] = heap_[child];
    event(heap_[place]).place = static_cast<std::int32_t>(place);
  }
  heap_[place] = grain;
  event(grain).place = static_cast<std::int32_t>(place);
}

/// Goes on to the next day that has events. Every page passed: what is far away comes nearer, or is all there is.
void EventQueue::turn_pages() {
  for (std::int64_t turned = 0; heap_.empty(); ++turned) {
    if (turned == pages_) return start_again();
    ++today_;
    open(today_ & (pages_ - 1));
    if ((today_ & (pages_ - 1)) == 0) open(pages_);
  }
}

/// Puts the events of a page where they belong now.
void EventQueue::open(std::int64_t page) {
  auto grain = first_[static_cast<std::size_t>(page)];
  first_[static_cast<std::size_t>(page)] = none;
  while (grain != none) {
    const auto after = event(grain).next;
    put_in(grain);
    grain = after;
  }
}

}  // namespace chute::event
