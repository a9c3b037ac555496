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
  /// Nothing is due more often than once a step.
  Schedule(double from, double every, double dt)
      : from_(from), every_(every == 0 ? 0 : std::max(every, dt)), dt_(dt) {}

  std::int64_t step_of(std::int64_t k) const {
    const double step = std::round((from_ + static_cast<double>(k) * every_) / dt_);
    return step < countable ? static_cast<std::int64_t>(step) : never;
  }
  /// The first due step after `step`; never, if there is no schedule.
  std::int64_t after(std::int64_t step) const {
    if (every_ == 0) return never;
    return step_of(first_index_after(step));
  }
  /// Which one is due at `step`, or −1.
  std::int64_t index_at(std::int64_t step) const {
    if (every_ == 0) return -1;
    const auto k = first_index_after(step - 1);
    return step_of(k) == step ? k : -1;
  }

 private:
  static constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();
  static constexpr double countable = 9e15;  // beyond it doubles miss some steps, and no run gets there

  double from_ = 0, every_ = 0, dt_ = 1;

  std::int64_t first_index_after(std::int64_t step) const {
    const double guess = (static_cast<double>(step) * dt_ - from_) / every_;
    auto k = static_cast<std::int64_t>(std::clamp(std::floor(guess) - 1, 0.0, countable));
    while (step_of(k) <= step) ++k;  // twice or three times: every is a step at least
    return k;
  }
};

}  // namespace chute::measure
