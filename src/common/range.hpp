#pragma once
#include <limits>
#include <string>

namespace chute {

/// Allowed interval of a number.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false, high_open = false;
  bool contains(double x) const;
  std::string describe() const;  ///< "> 0", "in [0, 1]" …
};
inline constexpr double unbounded = std::numeric_limits<double>::infinity();
inline constexpr Range any_number{};
inline constexpr Range positive{0, unbounded, true, false};
inline constexpr Range non_negative{0, unbounded, false, false};
inline constexpr Range unit_interval{0, 1, false, false};
/// Sizes of physical numbers, 0 aside, whose squares, cubes and ratios are still numbers of the machine: no unit that
/// anybody measures in leaves it.
inline constexpr Range computable{1e-60, 1e60, false, false};
inline constexpr Range at_least(double low) { return {low, unbounded, false, false}; }
inline constexpr Range between(double low, double high) { return {low, high, false, false}; }

}  // namespace chute
