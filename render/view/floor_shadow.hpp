#pragma once
#include <Eigen/Geometry>
#include <vector>

#include "view/solid_scene.hpp"

namespace chute::view {

/// The soft shadow of balls on a floor, as a grid over it.
class FloorShadow {
 public:
  FloorShadow(const Floor& floor, const std::vector<Ball>& balls, const Eye& eye);
  /// How dark the floor is where the line of sight meets it, 0 to 1; 0 where it does not.
  float at(double x, double y) const;

 private:
  const Floor& floor_;
  const Eye& eye_;
  Eigen::Vector3d u_, v_;  ///< along the floor
  double cell_ = 1;
  int size_ = 0;  ///< cells along each side
  std::vector<float> dark_;
};

}  // namespace chute::view
