#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <vector>

#include "read/grain_frame.hpp"
#include "read/meanings.hpp"
#include "read/run_frames.hpp"

namespace chute::read {

/// A force between two grains, or a grain and a wall: the ends of its line, and its magnitude in the file's unit.
struct ForceLink {
  Eigen::Vector3d from, to;
  double force;
};

/// Reads a contact network. Of VTK files the lines of two points, with a cell array `normal_force` or `force` (a vector counts
/// with its length) or what `meanings.force` names. Of files without such lines, of tables (.csv) and of LAMMPS's dumps of entries
/// (dump local), each row is a contact: its ends stand in columns (x1 y1 z1 x2 y2 z2, or what `meanings.ends` names), or it names
/// two grains of `grains` by their ids; those with a grain that is not there, such as a wall, are left out. An empty network is
/// fine. Several files are parts of one network: each has contacts of its own, and an array that one with contacts lacks is left
/// out, as VTK does it. InputError, one line that names the file, as read_frame.
std::vector<ForceLink> parse_network(std::vector<FileBytes> files, const Meanings& meanings = {},
                                     const GrainFrame* grains = nullptr);
std::vector<ForceLink> read_network(const std::filesystem::path& path);

/// The files of the network that belongs to a frame, with all its parts.
std::vector<FileBytes> network_bytes(const FrameFile& frame);

}  // namespace chute::read
