#pragma once
#include <stdexcept>
#include <string_view>

#include "read/vtk_points.hpp"

namespace chute::read {

/// A file that may be right, but that this reader does not take.
struct NotTaken : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Reads a legacy VTK file (`# vtk DataFile Version …`, ASCII or BINARY) of POLYDATA or UNSTRUCTURED_GRID
/// from memory. VTK's own reader crashes on files that are cut short and takes others for whole; this one
/// counts every value. Throws NotTaken, or std::runtime_error that says what is wrong, without the file's name.
PointSet parse_legacy_vtk(std::string_view bytes);

}  // namespace chute::read
