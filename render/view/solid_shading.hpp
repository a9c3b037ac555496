#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "view/solid_tile.hpp"

namespace chute::view {

/// What a sample shows: colour, and the surface that is there.
struct Shaded {
  Eigen::Vector3f color;   ///< red, green, blue
  Eigen::Vector3f normal;  ///< right, up, depth
  float depth;             ///< beyond that of the eye's centre
};

/// Works out the colours of balls and rods. Names count the balls first, then the rods.
class Shading {
 public:
  Shading(const SolidContent& content, const std::vector<SeenBall>& balls, const std::vector<SeenRod>& rods,
          const Eye& eye, const SolidLook& look);

  Shaded at(std::uint32_t name, double x, double y) const;
  /// The colour of a matt surface under the scene's lights.
  Eigen::Vector3f lit(const Eigen::Vector3f& color, const Eigen::Vector3f& normal,
                      const Eigen::Vector3f& towards) const;

 private:
  const SolidContent& content_;
  const std::vector<SeenBall>& balls_;
  const std::vector<SeenRod>& rods_;
  const Eye& eye_;
  const SolidLook& look_;
  std::vector<std::uint32_t> first_spot_;  ///< of each ball, and one more: the end

  void mark(Eigen::Vector3f& color, std::size_t ball, const Eigen::Vector3f& normal, float facing) const;
};

}  // namespace chute::view
