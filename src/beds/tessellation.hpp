#pragma once
#include <array>
#include <cstddef>
#include <vector>

/// The plane that beads lie on, and who lies beside whom there.
namespace chute::beds {

/// Places on a plane that repeats after `length` along and `width` across.
struct Sheet {
  double length, width;
  std::vector<std::array<double, 2>> place;

  /// The shortest way from a to b.
  std::array<double, 2> way(const std::array<double, 2>& a, const std::array<double, 2>& b) const;
  /// Inside the first period.
  std::array<double, 2> wrapped(std::array<double, 2> place) const;
};

/// Voronoi's and Delaunay's division of a sheet, with its repetition.
struct Tessellation {
  /// A point that is equally far from three places, and from no other less: the middle of a gap between them.
  struct Vertex {
    std::array<double, 2> place;
    double distance;
    std::array<std::size_t, 3> of;  ///< three of the places that are so far
  };
  /// Two places whose cells share a border.
  struct Edge {
    std::size_t a, b;
    std::array<double, 2> way;  ///< from a to b
    double distance;
  };
  std::vector<Vertex> vertices;   ///< those inside the first period
  std::vector<Edge> edges;        ///< each pair once
  std::vector<double> cell_area;  ///< of each place
};

/// By Boost.Polygon, which computes with whole numbers: distances are good to some 1e-7 of a typical one. Needs at least
/// three places that do not all lie on one line.
Tessellation tessellate(const Sheet& sheet);

}  // namespace chute::beds
