#pragma once
#include <array>
#include <memory>
#include <vector>

#include "image/image.hpp"
#include "plot/geometry.hpp"
#include "view/color_map.hpp"

namespace chute::view {

class OffscreenContext;
using Vector = std::array<double, 3>;

/// How a space is seen: an eye that looks at `centre` with `up` upwards.
struct Eye {
  Vector centre{}, towards{0, -1, 0},
      up{0, 0, 1};      ///< `towards` points from the centre to the eye, unit length
  double distance = 1;  ///< from the centre, in the files' unit
  double focal = 1;     ///< pixels per unit slope: a length l at distance D is focal l / D long
  plot::Point at;       ///< where the centre is seen, pixels from the top left

  /// The eye that sees a box fill `rect` (pixels) as well as can be; `zoom` > 1 is larger.
  static Eye on_box(const std::array<double, 6>& box, Vector towards, Vector up, const plot::Rect& rect,
                    double zoom);
  /// Width / height of a box so seen.
  static double aspect(const std::array<double, 6>& box, Vector towards, Vector up);
  plot::Point seen(const Vector& point) const;
  /// A direction at the centre as it is seen: x right, y down, length up to 1.
  plot::Point seen_direction(const Vector& direction) const;
};

struct Ball {
  Vector centre;
  double radius;
  Rgb color;
};

/// A round rod that may taper: a force, an arrow's shaft or head, an edge of the box.
struct Rod {
  Vector from, to;
  double radius_from, radius_to;
  Rgb color;
};

/// Balls and rods in space, lit from above the eye; drawn at twice the size and averaged, for smooth edges.
class SolidScene {
 public:
  static constexpr int samples = 2;  ///< along each side of a pixel: the context must be that much larger

  SolidScene(OffscreenContext& context, int width, int height, Rgb ground, double ground_alpha);
  ~SolidScene();

  /// `depth` is how far the nearest and the farthest thing are from the eye.
  void look(const Eye& eye, std::array<double, 2> depth);
  /// Darkens where grains are close to each other; `radius` is about a grain's.
  void occlude(double radius);
  void draw(const std::vector<Ball>& balls, const std::vector<Rod>& rods, image::Image& into);

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace chute::view
