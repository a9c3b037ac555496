#pragma once
#include "read/grain_frame.hpp"
#include "read/network.hpp"

namespace chute::view {

/// The grains at a moment between two frames, `part` (0 to 1) of the time from `a` to `b` later than `a`: places go straight, the
/// short way through periodic ends, orientations turn evenly (slerp), numbers change evenly, and what only names things (ids, types,
/// species) is that of `a`. Grains are matched by their ids, or, where the files have none, by their order, if there are as many. A
/// grain that is gone in `b` goes on as fast as it went, if frames have velocities and times; one that is new in `b` is not there yet.
read::GrainFrame between(const read::GrainFrame& a, const read::GrainFrame& b, double part);

/// The contacts of a frame and the grains that they join.
struct Network {
  const read::GrainFrame& grains;
  std::vector<read::ForceLink> links;
};

/// Contacts at that moment; `now` is what `between` made of the grains. The force of a contact of the same two grains in both frames
/// changes evenly, that of one which comes or goes from or to nothing. An end that lies in the centre of a grain, or of one of its
/// images, goes with it. Other ends, such as those on walls, belong to the nearest one that the same grain has in the other frame, and
/// go straight from one to the other.
std::vector<read::ForceLink> between(const Network& a, const Network& b, const read::GrainFrame& now,
                                     double part);

}  // namespace chute::view
