#pragma once
#include <Eigen/Core>
#include <optional>
#include <unordered_map>
#include <vector>

#include "read/grain_frame.hpp"

namespace chute::view {

/// Where a grain, or the mean of all that move, is from frame to frame: a path without jumps where grains leave
/// through one periodic end and come back through the other.
class PathFinder {
 public:
  /// InputError naming the file if it has no ids, or not that one.
  void see(const read::GrainFrame& frame, std::optional<long long> id, double time);
  /// Averaged over some frames, so that a camera that follows does not shake.
  std::vector<Eigen::Vector3d> smooth() const;

 private:
  struct Known {
    Eigen::Vector3d place, velocity;
  };
  std::unordered_map<long long, Known> before_;
  double time_ = 0;
  std::vector<Eigen::Vector3d> path_;
};

}  // namespace chute::view
