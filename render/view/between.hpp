#pragma once
#include "read/grain_frame.hpp"
#include "read/network.hpp"

namespace chute::view {

/// The grains at a moment between two frames, `part` (0 to 1) of the time from `a` to `b` later than `a`: places go straight, the
/// short way through periodic ends, orientations turn evenly (slerp), numbers change evenly, and what only names things (ids, types,
/// species) is that of `a`. Grains are matched by their ids, or by their order where the files have none; where grains came or went it
/// is `a`.
read::GrainFrame between(const read::GrainFrame& a, const read::GrainFrame& b, double part);

/// Contacts of frame `a` at that moment: an end that lies in the centre of a grain, or of one of its images, goes with it. `now` is
/// what `between` made of `a`. Others, such as those on walls, stay.
void move_ends(std::vector<read::ForceLink>& links, const read::GrainFrame& a, const read::GrainFrame& now);

}  // namespace chute::view
