#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "view/solid_scene.hpp"

/// What the eye sees where: spheres and cones against the lines of sight of a picture's samples.
namespace chute::view {

/// Samples along each side of a pixel.
inline constexpr int samples = 2;

/// A ball as the eye has it: right, up and depth of its centre, and where that is in the picture.
struct SeenBall {
  Eigen::Vector3d centre;
  double radius;
  plot::Point at{0, 0};    ///< pixels
  float nearest;           ///< depth of its nearest point, from the eye's centre
  std::array<int, 4> box;  ///< samples it may cover: left, top, right, bottom; the last two not included

  SeenBall(const Ball& ball, const Eye& eye, int width, int height);
  bool is_in_view() const { return box[0] < box[2] && box[1] < box[3]; }
};

/// A rod as the eye has it: a cone between two flat ends.
struct SeenRod {
  Eigen::Vector3d from, to;  ///< right, up, depth
  double radius_from, radius_to;
  std::array<int, 4> box;

  SeenRod(const Rod& rod, const Eye& eye, int width, int height);
  bool is_in_view() const { return box[0] < box[2] && box[1] < box[3]; }
};

/// Where a line of sight meets a surface.
struct Hit {
  double depth;            ///< beyond that of the eye's centre
  Eigen::Vector3d normal;  ///< outwards; right, up, depth
};

/// The line through the eye and a place of the picture is direction * depth.
inline Eigen::Vector3d sight(const Eye& eye, double x, double y) {
  return {(x - eye.at.x()) / eye.focal, (eye.at.y() - y) / eye.focal, 1};
}
/// The line is known to meet it, or nearly so.
Hit hit(const SeenBall& ball, const Eye& eye, double x, double y);
/// Where the line meets it, beyond the depth of the eye's centre; nothing where it passes.
std::optional<double> depth_at(const SeenBall& ball, const Eye& eye, double x, double y);
std::optional<Hit> hit(const SeenRod& rod, const Eye& eye, double x, double y);

/// A rectangle of the picture whose samples know what is nearest. Blocks of them know how far their farthest
/// sample is: what is farther than that is hidden there.
class Tile {
 public:
  static constexpr int width = 256, height = 128;  ///< samples: 256 KiB, which stay in a core's cache
  static constexpr std::uint32_t nothing = std::numeric_limits<std::uint32_t>::max();

  explicit Tile(const Eye& eye) : eye_(eye) {}

  void start(int left, int top);  ///< sample of the picture in the upper left corner
  /// True if nothing so far away can be seen any more in this tile.
  bool is_full(float nearest) const { return nearest >= farthest_; }
  /// `all`: also where blocks say that it is hidden.
  void add(const SeenBall& ball, std::uint32_t name, bool all);
  void add(const SeenRod& rod, std::uint32_t name);

  std::uint32_t name(int x, int y) const { return names_[index(x, y)]; }
  float depth(int x, int y) const { return depths_[index(x, y)]; }

 private:
  static constexpr int block = 8;
  static constexpr float far = std::numeric_limits<float>::infinity();
  const Eye& eye_;
  int left_ = 0, top_ = 0, added_ = 0;
  float farthest_ = far;
  std::array<float, width * height> depths_;
  std::array<std::uint32_t, width * height> names_;
  std::array<float, width / block * height / block> block_depths_;

  static std::size_t index(int x, int y) { return static_cast<std::size_t>(y * width + x); }
  float& block_depth(int x, int y) {
    return block_depths_[static_cast<std::size_t>(y * (width / block) + x)];
  }
  std::array<int, 4> inside(const std::array<int, 4>& box) const;
};

}  // namespace chute::view
