#pragma once
#include "read/grain_frame.hpp"

namespace chute::view {

/// The grains at a moment between two frames, `part` (0 to 1) of the time from `a` to `b` later than `a`: places go straight, the
/// short way through periodic ends, orientations turn evenly (slerp), numbers change evenly, and what only names things (ids, types,
/// species) is that of `a`. Grains are matched by their ids, or by their order where the files have none; where grains came or went it
/// is `a`.
read::GrainFrame between(const read::GrainFrame& a, const read::GrainFrame& b, double part);

}  // namespace chute::view
