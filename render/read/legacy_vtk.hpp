#pragma once
#include <string_view>

#include "read/vtk_points.hpp"

namespace chute::read {

/// Reads a legacy VTK file (`# vtk DataFile Version …`, ASCII or BINARY) of POLYDATA or UNSTRUCTURED_GRID
/// from memory. VTK's own reader crashes on files that are cut short and takes others for whole; this one
/// counts every value. Throws std::runtime_error that says what is wrong, without the file's name.
PointSet parse_legacy_vtk(std::string_view bytes);

}  // namespace chute::read
