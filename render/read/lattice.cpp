#include <cmath>

#include "read/point_set.hpp"

namespace chute::read {
namespace {

// Of an edge's length: less than that beside an axis is how numbers were rounded when the box was written.
constexpr double rounding = 1e-9;

}  // namespace

int Lattice::axis_of(int edge) const {
  const Eigen::Vector3d way = edges.col(edge);
  Eigen::Index axis = 0;
  const double along = way.cwiseAbs().maxCoeff(&axis);
  Eigen::Vector3d beside = way;
  beside[axis] = 0;
  return along > 0 && way[axis] > 0 && beside.norm() <= rounding * along ? static_cast<int>(axis) : -1;
}

Eigen::Vector3d Lattice::shortest(const Eigen::Vector3d& way) const {
  const Eigen::Vector3d parts = edges.partialPivLu().solve(way);
  Eigen::Vector3d result = way;
  for (int edge = 0; edge < 3; ++edge)
    if (periodic[static_cast<std::size_t>(edge)] && std::isfinite(parts[edge]))
      result -= std::round(parts[edge]) * edges.col(edge);
  return result;
}

}  // namespace chute::read
