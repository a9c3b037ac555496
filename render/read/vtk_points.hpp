#pragma once
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "read/grain_frame.hpp"

namespace chute::read {

/// A VTK point set as plain arrays: what read_frame and read_contacts make sense of.
struct VtkPoints {
  std::vector<double> x, y, z;
  std::vector<PointArray> point_arrays, cell_arrays, field_arrays;
  std::vector<std::pair<std::string, std::string>>
      field_texts;                                ///< string arrays of the field data, first value
  std::vector<std::array<std::size_t, 2>> lines;  ///< two-point cells, as pairs of points
  std::vector<std::size_t> line_cells;            ///< their cells' numbers, for `cell_arrays`
};

/// Reads XML or legacy VTK from memory. What VTK complains about becomes an InputError that names `path`;
/// nothing is printed.
VtkPoints parse_vtk(std::string bytes, const std::filesystem::path& path);

}  // namespace chute::read
