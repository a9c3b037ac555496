#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "read/point_set.hpp"

namespace chute::read {

/// Reads XML or legacy VTK from memory. What VTK complains about becomes an InputError that names `path`;
/// nothing is printed. `wanted` says which point arrays are to be unpacked.
PointSet parse_vtk(
    std::string bytes, const std::filesystem::path& path,
    const std::function<bool(std::string_view)>& wanted = [](std::string_view) { return true; });

/// The same of all of them as one set. An array that a part with points lacks, or has with other components, is left out, as VTK
/// does it. The first part with points says what stands in the field data.
PointSet parse_vtk(
    std::vector<FileBytes> parts,
    const std::function<bool(std::string_view)>& wanted = [](std::string_view) { return true; });

}  // namespace chute::read
