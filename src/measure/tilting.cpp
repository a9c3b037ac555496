#include "measure/tilting.hpp"

#include <cmath>
#include <numbers>

namespace chute::measure {
namespace {

constexpr double moving = 0.01;  ///< of √(g d)
constexpr double for_good = 10;  ///< of √(d/g)

/// The first row from `begin` on from which `is` holds for that long, up to a row of the series; none is the size.
template <class Is>
std::size_t first_lasting(const std::vector<double>& time, std::size_t begin, double lasts, const Is& is) {
  std::size_t from = begin;
  for (std::size_t k = begin; k < time.size(); ++k) {
    if (!is(k))
      from = k + 1;
    else if (time[k] - time[from] >= lasts)
      return from;
  }
  return time.size();
}

}  // namespace

TurningAngles turning_angles(const Tilt& tilt, double diameter, const std::vector<double>& time,
                             const std::vector<double>& v_x) {
  const double least = moving * std::sqrt(tilt.gravity * diameter),
               lasts = for_good * std::sqrt(diameter / tilt.gravity);
  const auto angle = [&](std::size_t k) { return tilt.angle(time[k]) * 180 / std::numbers::pi; };
  const auto starts_from = [&](std::size_t row) {
    return first_lasting(time, row, lasts, [&](std::size_t k) { return v_x[k] > least; });
  };
  TurningAngles angles;
  const auto moves = starts_from(0);
  if (moves == time.size()) return angles;
  if (moves > 0) angles.start = angle(moves);
  const auto stops = first_lasting(time, moves, lasts, [&](std::size_t k) { return v_x[k] <= least; });
  if (stops == time.size()) return angles;
  angles.stop = angle(stops);
  if (moves > 0) return angles;
  const auto again = starts_from(stops);
  if (again < time.size()) angles.start = angle(again);
  return angles;
}

}  // namespace chute::measure
