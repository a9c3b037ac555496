#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace chute::measure {

/// Steps at which something is due: every so many, from a first one on, each time rounded to the nearest
/// step.
class Schedule {
 public:
  Schedule() = default;
  Schedule(double from, double every, double dt) : from_(from), every_(every), dt_(dt) {}

  std::int64_t step_of(std::int64_t k) const {
    return std::llround((from_ + static_cast<double>(k) * every_) / dt_);
  }
  /// The first due step after `step`; never, if there is no schedule.
  std::int64_t after(std::int64_t step) const {
    if (every_ == 0) return std::numeric_limits<std::int64_t>::max();
    return step_of(first_index_after(step));
  }
  /// Which one is due at `step`, or −1.
  std::int64_t index_at(std::int64_t step) const {
    if (every_ == 0) return -1;
    const auto k = first_index_after(step - 1);
    return step_of(k) == step ? k : -1;
  }

 private:
  double from_ = 0, every_ = 0, dt_ = 1;

  std::int64_t first_index_after(std::int64_t step) const {
    const double guess = (static_cast<double>(step) * dt_ - from_) / every_;
    auto k = std::max<std::int64_t>(0, static_cast<std::int64_t>(std::floor(guess)) - 1);
    while (step_of(k) <= step) ++k;
    return k;
  }
};

}  // namespace chute::measure
