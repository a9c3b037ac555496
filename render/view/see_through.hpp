#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "view/solid_shading.hpp"

namespace chute::view {

inline constexpr std::size_t samples_of_pixel = std::size_t{samples} * samples;

/// What lies before the solid things of a pixel and lets a part of them through.
struct Veil {
  Eigen::Vector4f color{0, 0, 0, 0};            ///< alpha multiplied in
  std::array<float, samples_of_pixel> through;  ///< share of what lies behind, at each sample; row by row
};

/// Balls of glass and panes: each covers a share of what lies behind it. At every sample those that are nearer than
/// all that is solid lie over each other in the order of their depths there, also where they cut through each other.
class SeeThrough {
 public:
  /// All are used until the end. `solids` and `shading` know every ball, of glass or not.
  SeeThrough(const SolidContent& content, const std::vector<SeenBall>& balls, const Shading& shading,
             const Eye& eye);

  bool is_empty() const { return panes_.empty() && !has_glass_; }
  /// A tile's first pixel. Then come the balls of glass that may be seen in it.
  void start(int left, int top);
  void add(std::uint32_t ball);
  /// `solid`: depths of the nearest solid thing at the samples of a pixel of the tile.
  Veil at(int x, int y, const std::array<float, samples_of_pixel>& solid);

 private:
  static constexpr float far = std::numeric_limits<float>::infinity();
  /// A pane as the eye has it.
  struct SeenPane {
    std::vector<Eigen::Vector2d> corners;  ///< pixels, y down
    Eigen::Vector3d normal;                ///< right, up, depth; inside the pane, normal . place = offset
    double offset;
    Eigen::Vector3f color;
    float alpha;

    SeenPane(const Pane& pane, const Eye& eye);
    /// Depth beyond that of the eye's centre where the line of sight meets it, `far` where it does not.
    float at(const Eye& eye, double x, double y) const;
  };
  /// A pane or a ball in one pixel.
  struct Layer {
    std::array<float, samples_of_pixel> depths;
    float alpha;
    std::uint32_t ball;  ///< Tile::nothing: a pane
    bool whole;          ///< hit by all samples: one colour is enough
    bool has_color;
    Eigen::Vector3f color;
  };

  const SolidContent& content_;
  const std::vector<SeenBall>& balls_;
  const Shading& shading_;
  const Eye& eye_;
  bool has_glass_ = false;
  std::vector<SeenPane> panes_;
  int left_ = 0, top_ = 0;
  std::vector<std::vector<std::uint32_t>>
      near_;  ///< of each pixel of the tile, the balls whose square it is in
  std::vector<Layer> layers_;
  std::vector<std::uint32_t> order_, bodies_;

  void find_layers(int x, int y);
  Eigen::Vector3f color_of(Layer& layer, int x, int y, std::size_t sample) const;
};

}  // namespace chute::view
