#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "image/image.hpp"
#include "view/color_map.hpp"
#include "view/eye.hpp"

namespace chute::view {

struct Ball {
  static constexpr std::uint32_t alone = std::numeric_limits<std::uint32_t>::max();

  Eigen::Vector3d centre;
  double radius;
  Rgb color;
  /// From the ball's own axes to the files'. Bands on three great circles show it; the zero quaternion: none.
  Eigen::Quaternionf orientation{0, 0, 0, 0};
  double opacity = 1;          ///< below 1 it is glass, which covers this share of what lies behind it
  std::uint32_t body = alone;  ///< balls of one body are one layer of glass
  bool has_shadow = true;      ///< on the floor

  bool is_glass() const { return opacity < 1; }
};

/// A small round mark on the surface of a ball, in `direction` from its centre.
struct Spot {
  std::size_t ball;
  Eigen::Vector3d direction;
};

/// A round rod that may taper: a force, an arrow's shaft or head, a trail, an edge of the box.
struct Rod {
  Eigen::Vector3d from, to;
  double radius_from, radius_to;
  Rgb color;
};

/// A flat convex polygon through which one sees what is behind it.
struct Pane {
  std::vector<Eigen::Vector3d> corners;
  Rgb color;
  double alpha;
};

/// A plane under everything that shows nothing but the shadow of the balls, out to where it fades.
struct Floor {
  Eigen::Vector3d centre, normal;  ///< of length 1
  double radius;                   ///< beyond it, nothing
  /// How far the shadow of something falls to the side, at most, for its height.
  double reach = std::numeric_limits<double>::infinity();
};

struct SolidContent {
  std::vector<Ball> balls = {};
  std::vector<Spot> spots = {};  ///< in the order of their balls
  std::vector<Rod> rods = {};
  std::vector<Pane> panes = {};
  std::optional<Floor> floor = {};
};

/// How solids look, the same in all frames.
struct SolidLook {
  Rgb ground, ink;  ///< ink: of outlines and spots
  double ground_alpha = 1;
  double occlusion = 0;   ///< radius of a grain, whose neighbours darken it; 0: nothing is darkened
  bool outlines = false;  ///< a dark line inside the rim of every ball and rod
  Rgb spot{.84, .37, 0};
};

/// Balls, rods and panes in space, lit from above the eye, drawn by the processor: every pixel has four samples,
/// every sample knows the nearest solid thing that it hits and what of glass lies before it, and colours are worked
/// out only for what is seen, once where all four hit the same. Occlusion darkens what is solid. Arithmetic in a fixed order, so the same bytes on every machine.
class SolidScene {
 public:
  SolidScene(int width, int height, const SolidLook& look) : width_(width), height_(height), look_(look) {}

  void look(const Eye& eye) { eye_ = eye; }
  /// Pixels with alpha multiplied in. `all`: look at every ball in every tile, also those that nearer ones hide;
  /// the plain way, which gives the same picture and is there for tests.
  void draw(const SolidContent& content, image::Image& into, bool all = false) const;

 private:
  int width_, height_;
  SolidLook look_;
  Eye eye_;
};

}  // namespace chute::view
