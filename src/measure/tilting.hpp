#pragma once
#include <optional>
#include <vector>

#include "core/frame.hpp"

namespace chute::measure {

/// The angles, in degrees, at which a flow on an incline that is tilted meanwhile starts and stops. It starts where its
/// mean v_x first stays above 0.01 √(g d) for 10 √(d/g), and stops where, after it moved, v_x first stays below that for
/// as long. A flow that moves from the first row on stops first, and starts where it moves again after that. Nothing where
/// the run does not tell.
struct TurningAngles {
  std::optional<double> start, stop;
};

/// `time` and `v_x` of the series, row by row.
TurningAngles turning_angles(const Tilt& tilt, double diameter, const std::vector<double>& time,
                             const std::vector<double>& v_x);

}  // namespace chute::measure
