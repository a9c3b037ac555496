#include "read/surroundings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "common/fields.hpp"
#include "read/vtk_points.hpp"

namespace chute::read {
namespace {

const PointArray* find_scalar(const std::vector<PointArray>& arrays, std::string_view name) {
  for (const auto& array : arrays)
    if (array.name == name && array.components == 1) return &array;
  return nullptr;
}

/// A point of the file, finite.
Eigen::Vector3d point(const PointSet& points, std::size_t i, const std::filesystem::path& path) {
  Eigen::Vector3d p{points.x[i], points.y[i], points.z[i]};
  if (!p.allFinite())
    throw InputError(fmt::format("{}: point {}: a coordinate is not a finite number", path.string(), i));
  return p;
}

}  // namespace

std::vector<WallPiece> read_walls(const std::filesystem::path& path) {
  const PointSet points = parse_vtk(read_file(path), path);
  const auto* number = find_scalar(points.cell_arrays, fields::wall.name);
  std::vector<WallPiece> pieces;
  for (const auto& cell : points.cells) {
    auto& piece = pieces.emplace_back();
    piece.wall = static_cast<int>(number ? std::lround(number->at(cell.number)) : std::ssize(pieces) - 1);
    for (const auto corner : cell.corners) piece.corners.push_back(point(points, corner, path));
  }
  return pieces;
}

std::vector<Impact> read_impacts(const std::filesystem::path& path) {
  const PointSet points = parse_vtk(read_file(path), path);
  const auto *time = find_scalar(points.point_arrays, fields::time.name),
             *bead = find_scalar(points.point_arrays, fields::bead.name);
  if (!points.x.empty() && (!time || !bead))
    throw InputError(path.string() + ": no point arrays \"time\" and \"bead\": when and where impacts were");
  std::vector<Impact> impacts;
  for (std::size_t i = 0; i < points.x.size(); ++i)
    impacts.push_back({point(points, i, path), time->at(i), std::llround(bead->at(i))});
  std::stable_sort(impacts.begin(), impacts.end(),
                   [](const Impact& a, const Impact& b) { return a.time < b.time; });
  return impacts;
}

}  // namespace chute::read
