#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "read/grain_frame.hpp"

namespace chute::read {

/// A VTK point set as plain arrays: what read_frame, read_network and read_walls make sense of.
struct VtkPoints {
  std::vector<double> x, y, z;
  std::vector<PointArray> point_arrays, cell_arrays, field_arrays;
  std::vector<std::string> point_names;  ///< of all numeric point arrays, wanted or not
  std::vector<std::pair<std::string, std::string>>
      field_texts;  ///< string arrays of the field data, first value
  /// Lines and polygons; vertices are left out.
  struct Cell {
    std::size_t number;                ///< for `cell_arrays`
    std::vector<std::size_t> corners;  ///< two points at least
  };
  std::vector<Cell> cells;
  std::size_t cells_in_all = 0;  ///< with the vertices
};

/// Reads XML or legacy VTK from memory. What VTK complains about becomes an InputError that names `path`;
/// nothing is printed. `wanted` says which point arrays are to be unpacked.
VtkPoints parse_vtk(
    std::string bytes, const std::filesystem::path& path,
    const std::function<bool(std::string_view)>& wanted = [](std::string_view) { return true; });

/// The files that hold the points of `path`: itself, or the pieces that a parallel index (.pvtp, .pvtu) or the blocks that a
/// multi-block file (.vtm) names. InputError if an index names another index or nothing.
std::vector<FileBytes> read_parts(const std::filesystem::path& path);

/// The same of all of them as one set. An array that a part with points lacks, or has with other components, is left out, as VTK
/// does it. The first part with points says what stands in the field data.
VtkPoints parse_vtk(
    std::vector<FileBytes> parts,
    const std::function<bool(std::string_view)>& wanted = [](std::string_view) { return true; });

}  // namespace chute::read
