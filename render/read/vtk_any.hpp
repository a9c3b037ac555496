#pragma once
#include <filesystem>

#include "read/point_set.hpp"

namespace chute::read {

/// What read_by_vtk does, in this process. Throws std::runtime_error with what VTK complains of, without the file's name.
PointSet read_any_vtk(const std::filesystem::path& path);

}  // namespace chute::read
