#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <vector>

/// What a run keeps beside its frames, once for all of them.
namespace chute::read {

/// A flat piece of a wall: its corners in order. Two corners are a line, which is what walls in the plane are.
struct WallPiece {
  int wall = 0;  ///< the number of the wall that it belongs to
  std::vector<Eigen::Vector3d> corners;
};

/// Reads VTK lines and polygons with a cell array `wall` (without one, each is a wall of its own). InputError,
/// one line that names the file, as read_frame.
std::vector<WallPiece> read_walls(const std::filesystem::path& path);

/// A grain that met another: where their surfaces touched, when, and whom it hit.
struct Impact {
  Eigen::Vector3d place;
  double time = 0;
  long long bead = -1;  ///< id of the grain that was hit
};

/// Reads impacts.vtp, sorted by time. InputError as read_frame; also if `time` or `bead` is missing.
std::vector<Impact> read_impacts(const std::filesystem::path& path);

}  // namespace chute::read
