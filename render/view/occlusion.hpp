#pragma once
#include <Eigen/Core>
#include <vector>

#include "view/eye.hpp"

namespace chute::view {

/// What is seen at each pixel, row by row.
struct Surfaces {
  int width, height;
  std::vector<float> depths;             ///< beyond that of the eye's centre; infinite where there is nothing
  std::vector<Eigen::Vector3f> normals;  ///< right, up, depth

  Surfaces(int w, int h);
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

/// How much of the light from all sides reaches each pixel, 0 to 1, past what stands within `reach` of it.
/// The cost is one per pixel, whatever is there.
std::vector<float> ambient_light(const Surfaces& surfaces, const Eye& eye, double reach);

}  // namespace chute::view
