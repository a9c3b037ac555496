#pragma once
#include <Eigen/Geometry>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "read/meanings.hpp"
#include "read/point_set.hpp"

namespace chute::read {

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
  std::optional<Lattice>
      lattice;  ///< the box of a dump or an XYZ file; where it is not tilted, `domain` says the same
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  ///< 0 if the file does not say

  std::size_t size() const { return x.size(); }
  Eigen::Vector3d centre(std::size_t grain) const { return {x[grain], y[grain], z[grain]}; }

  /// Arrays that the user said, under chute's names: {"velocity", "u"}.
  std::vector<std::pair<std::string, std::string>> said = {};

  /// The array that was said to be this, the one of that name, or of another name that engines give to the same thing (`velocity`: also `v`,
  /// `Velocity`, `linVel` …), or null.
  const PointArray* find(std::string_view name) const;

  /// Grains glued to the bed: array `type` is 0. False for all if the file has no types, or another program's, whose
  /// types are species.
  bool is_fixed(std::size_t grain) const;

  double period(int axis) const { return domain.sizes()[axis]; }
  /// `way` between two grains, through the periodic ends where that is shorter.
  Eigen::Vector3d shortest(Eigen::Vector3d way) const;
};

/// Reads one VTK file of grains: polygonal (.vtp) or unstructured (.vtu) XML, or either as legacy .vtk; what
/// it is is told from its content; or the first frame of a dump or an XYZ file. Radii come from an array `radius`, `diameter` or another usual name for
/// them, unless `meanings` says otherwise. InputError, with the arrays that are there, if one that it names is not; InputError, one line that names the file, if it is missing,
/// cut short or not VTK, has no radii, or points of which none has a place and a radius > 0; single ones without are left
/// out and counted, and a file without points is an empty frame.
///
/// `wanted` names the arrays that matter beside radius and type (chute's names stand for other engines', too);
/// unpacking the others would take most of the time. Nothing named: all.
GrainFrame read_frame(const std::filesystem::path& path, const Meanings& meanings = {},
                      const std::vector<std::string>& wanted = {});

/// The same from bytes that are already in memory, of one file or of the parts of one frame.
GrainFrame parse_frame(std::vector<FileBytes> parts, const Meanings& meanings = {},
                       const std::vector<std::string>& wanted = {});

}  // namespace chute::read
