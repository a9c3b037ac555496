#pragma once
#include <filesystem>
#include <functional>
#include <string_view>
#include <vector>

#include "read/point_set.hpp"

/// Points of any file that is read: VTK's, dumps of LAMMPS, XYZ files.
namespace chute::read {

/// The files that hold the points of `path`: itself, or the pieces that a parallel index (.pvtp, .pvtu) or the blocks that a
/// multi-block or partitioned file (.vtm, .vtpd, .vtpc) names, which may be such indexes themselves; of a dump or an XYZ file, its
/// first frame. Packed files are unpacked. InputError if an index names nothing, or itself in a circle.
std::vector<FileBytes> read_parts(const std::filesystem::path& path);

/// What they hold as one set. `wanted` says which point arrays are to be unpacked. InputError as parse_vtk, parse_dump and parse_xyz.
PointSet parse_points(
    std::vector<FileBytes> parts,
    const std::function<bool(std::string_view)>& wanted = [](std::string_view) { return true; });

}  // namespace chute::read
