#pragma once
#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace chute::read {

/// An array with `components` values per grain, as in the file: value c of grain i is `values[i * components
/// + c]`.
struct PointArray {
  std::string name;
  int components = 1;
  std::vector<double> values;

  double at(std::size_t grain, int component = 0) const {
    return values[grain * static_cast<std::size_t>(components) + static_cast<std::size_t>(component)];
  }
};

/// The grains at one time. Lengths and everything else are in the file's own units.
struct GrainFrame {
  std::filesystem::path file;
  std::optional<double> time;       ///< field data `TimeValue`, if the file says
  std::string units;                ///< "SI", "reduced", or empty if the file does not say
  int dimensions = 3;               ///< 2 if all grains lie in one plane z = const
  std::vector<double> x, y, z;      ///< centres
  std::vector<double> radius;       ///< > 0
  std::vector<PointArray> arrays;   ///< every numeric point array, under the file's names
  std::array<double, 6> domain{};   ///< x0 x1 y0 y1 z0 z1; equal ends: not periodic there, or not said
  std::array<double, 3> gravity{};  ///< 0 if the file does not say

  std::size_t size() const { return x.size(); }

  /// The array of that name, or of another name that engines give to the same thing (`velocity`: also `v`,
  /// `Velocity`, `linVel` …), or null.
  const PointArray* find(std::string_view name) const;

  /// Grains glued to the bed: array `type` is 0. False for all if the file has no types.
  bool is_fixed(std::size_t grain) const;

  double period(int axis) const {
    return domain[2 * static_cast<std::size_t>(axis) + 1] - domain[2 * static_cast<std::size_t>(axis)];
  }
};

/// Reads one VTK file of grains: polygonal (.vtp) or unstructured (.vtu) XML, or either as legacy .vtk; what
/// it is is told from its content. Radii come from an array `radius`, `diameter` or another usual name for
/// them, else from `radius`, the same for all. InputError, one line that names the file, if it is missing,
/// cut short or not VTK, has no points, a coordinate that is not a number, no radius or one that is not > 0.
GrainFrame read_frame(const std::filesystem::path& path, std::optional<double> radius = {});

/// The same from bytes that are already in memory; `path` stands for the file in messages.
GrainFrame parse_frame(std::string bytes, const std::filesystem::path& path,
                       std::optional<double> radius = {});

}  // namespace chute::read
