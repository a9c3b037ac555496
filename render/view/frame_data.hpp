#pragma once
#include <span>

#include "read/grain_frame.hpp"
#include "read/network.hpp"
#include "read/surroundings.hpp"

namespace chute::view {

/// What one frame is drawn from.
struct FrameData {
  const read::GrainFrame& frame;
  double time = 0;
  std::span<const read::ForceLink> links = {};            ///< for style.chains
  std::span<const read::GrainFrame* const> earlier = {};  ///< for style.trail, the oldest first
  std::span<const read::WallPiece> walls = {};
  std::span<const read::Impact> impacts = {};       ///< for style.impacts, up to `time`
  Eigen::Vector3d focus = Eigen::Vector3d::Zero();  ///< what style.camera.follow looks at
};

}  // namespace chute::view
