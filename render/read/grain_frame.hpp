#pragma once
#include <Eigen/Geometry>
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

/// A file as it lies on disk.
struct FileBytes {
  std::filesystem::path path;
  std::string bytes;
};

/// The grains at one time. Lengths and everything else are in the file's own units.
struct GrainFrame {
  std::filesystem::path file;
  std::optional<double> time;      ///< field data `TimeValue`, if the file says
  std::string units;               ///< "SI", "reduced", or empty if the file does not say
  std::string clock;               ///< what the time counts, "shakes"; empty: it is a time
  int dimensions = 3;              ///< 2 if all grains lie in one plane z = const
  std::vector<double> x, y, z;     ///< centres
  std::vector<double> radius;      ///< > 0
  std::vector<PointArray> arrays;  ///< the numeric point arrays that were wanted, under the file's names
  std::vector<std::string> names;  ///< of all point arrays in the file, also of those that were not wanted
  std::size_t left_out = 0;        ///< points without a place or a size
  bool own = false;                ///< chute's: says its units, gravity or domain, and its type 0 is the bed
  /// Where its ends coincide, the file says nothing of this axis or it is not periodic.
  Eigen::AlignedBox3d domain{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  ///< 0 if the file does not say

  std::size_t size() const { return x.size(); }
  Eigen::Vector3d centre(std::size_t grain) const { return {x[grain], y[grain], z[grain]}; }

  /// The array of that name, or of another name that engines give to the same thing (`velocity`: also `v`,
  /// `Velocity`, `linVel` …), or null.
  const PointArray* find(std::string_view name) const;

  /// Grains glued to the bed: array `type` is 0. False for all if the file has no types, or another program's, whose
  /// types are species.
  bool is_fixed(std::size_t grain) const;

  double period(int axis) const { return domain.sizes()[axis]; }
};

/// Reads one VTK file of grains: polygonal (.vtp) or unstructured (.vtu) XML, or either as legacy .vtk; what
/// it is is told from its content. Radii come from an array `radius`, `diameter` or another usual name for
/// them, else from `radius`, the same for all. InputError, one line that names the file, if it is missing,
/// cut short or not VTK, has no radii, or points of which none has a place and a radius > 0; single ones without are left
/// out and counted, and a file without points is an empty frame.
///
/// `wanted` names the arrays that matter beside radius and type (chute's names stand for other engines', too);
/// unpacking the others would take most of the time. Nothing named: all.
GrainFrame read_frame(const std::filesystem::path& path, std::optional<double> radius = {},
                      const std::vector<std::string>& wanted = {});

/// The same from bytes that are already in memory, of one file or of the parts of one frame.
GrainFrame parse_frame(std::vector<FileBytes> parts, std::optional<double> radius = {},
                       const std::vector<std::string>& wanted = {});

}  // namespace chute::read
