#pragma once
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace chute::io {

/// One moving grain as a VTK file has it.
struct GrainRecord {
  std::array<double, 3> place{}, velocity{}, spin{};
  double radius = 0;
  std::optional<double> mass;
  std::optional<std::array<double, 4>> orientation;  ///< w x y z; of a 2D grain [0] is its angle
  int material = 0;
};

/// The moving grains of a file of grains: chute's own, or any VTK file whose points have a radius. Read by VTK, in a
/// process of its own, so that a damaged file ends in an InputError and nothing worse.
std::vector<GrainRecord> read_grains(const std::filesystem::path& file);
/// The same from the bytes of a .vtp file; `name` is what errors call it.
std::vector<GrainRecord> parse_grains(const std::string& bytes, const std::string& name);

/// The files of a time index (.pvd) with their times, in its order.
std::vector<std::pair<double, std::filesystem::path>> read_pvd(const std::filesystem::path& file);

}  // namespace chute::io
