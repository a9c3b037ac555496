#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <vector>

namespace chute::read {

/// A force between two grains, or a grain and a wall: the ends of its line, and its magnitude in the file's unit.
struct ForceLink {
  Eigen::Vector3d from, to;
  double force;
};

/// Reads a contact network: VTK lines of two points each with a cell array `normal_force` or `force` (a
/// vector counts with its length). An empty network is fine. InputError, one line that names the file, as
/// read_frame.
std::vector<ForceLink> read_network(const std::filesystem::path& path);
std::vector<ForceLink> parse_network(std::string bytes, const std::filesystem::path& path);

}  // namespace chute::read
