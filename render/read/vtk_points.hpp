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
};

/// Reads XML or legacy VTK from memory. What VTK complains about becomes an InputError that names `path`;
/// nothing is printed. `wanted` says which point arrays are to be unpacked.
VtkPoints parse_vtk(
    std::string bytes, const std::filesystem::path& path,
    const std::function<bool(std::string_view)>& wanted = [](std::string_view) { return true; });

}  // namespace chute::read
