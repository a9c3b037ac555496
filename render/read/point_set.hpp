#pragma once
#include <Eigen/Core>
#include <Eigen/LU>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace chute::read {

/// An array with `components` values per grain, as in the file: value c of grain i is `values[i * components
/// + c]`.
struct PointArray {
  std::string name;
  int components = 1;
  std::vector<double> values;
  std::vector<std::string> words =
      {};  ///< of an array of words, such as species: each once; `values` count them

  double at(std::size_t grain, int component = 0) const {
    return values[grain * static_cast<std::size_t>(components) + static_cast<std::size_t>(component)];
  }
};

/// A file as it lies on disk; or of one that holds several frames, a frame.
struct FileBytes {
  std::filesystem::path path;
  std::string bytes;
  std::uint64_t first_line = 1;  ///< of the bytes in the file
  std::string units = {};        ///< that the file names at its begin only
  std::string named =
      {};  ///< of an index that VTK's own reader follows: what stands for the bytes of all files that it names
};

/// A box that repeats, or just encloses the grains: a corner and the three edges from there, which need not be square.
struct Lattice {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Matrix3d edges = Eigen::Matrix3d::Zero();  ///< columns
  std::array<bool, 3> periodic{};                   ///< along each edge

  /// A place in edges from the corner.
  Eigen::Vector3d fractions(const Eigen::Vector3d& place) const {
    return edges.partialPivLu().solve(place - origin);
  }
  /// Along which axis an edge lies, if it lies along one and the two others square to it; else -1.
  int axis_of(int edge) const;
  /// `way` between two places, less the whole periods in it: the shortest one, if the box is not much tilted.
  Eigen::Vector3d shortest(const Eigen::Vector3d& way) const;
};

/// Points with arrays, as VTK's files, dumps of LAMMPS and XYZ files hold them: what read_frame, read_network and read_walls make
/// sense of.
struct PointSet {
  enum class Format { vtk, dump, xyz } format = Format::vtk;
  std::vector<double> x, y, z;
  std::vector<PointArray> point_arrays, cell_arrays, field_arrays;
  std::vector<std::string> point_names;  ///< of all point arrays, wanted or not
  std::vector<std::pair<std::string, std::string>>
      field_texts;  ///< string arrays of the field data, first value
  /// Lines and polygons; vertices are left out.
  struct Cell {
    std::size_t number;                ///< for `cell_arrays`
    std::vector<std::size_t> corners;  ///< two points at least
  };
  std::vector<Cell> cells;
  std::size_t cells_in_all = 0;    ///< with the vertices
  std::optional<Lattice> lattice;  ///< of dumps and XYZ files
};

}  // namespace chute::read
