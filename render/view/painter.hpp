#pragma once
#include <memory>
#include <vector>

#include "image/image.hpp"
#include "plot/display_list.hpp"
#include "view/frame_data.hpp"
#include "view/frame_style.hpp"
#include "view/survey.hpp"

namespace chute::view {

class Furniture;

/// Turns grains into a picture: FlatPainter in the plane, SolidPainter in space.
class Painter {
 public:
  virtual ~Painter() = default;
  virtual void paint(const FrameData& data, image::Image& into) = 0;
  /// The same for a file: curves where there are some, else pixels. One unit is one pixel.
  virtual plot::DisplayList page(const FrameData& data) = 0;
};

/// Forces beyond nearly the largest are drawn wider only up to this, so that a single one does not fill the picture.
inline constexpr double strongest_link = 1.3;

/// What both painters work with.
struct Studio {
  FrameStyle style;
  Survey survey;
  Palette palette;
  ColorMap map;

  Studio(const FrameStyle& style, const Survey& survey);
  std::vector<Rgb> colors(const read::GrainFrame& frame) const;  ///< one per grain; fixed ones get the bed's
  /// In one of the half spaces in which nothing is drawn.
  bool is_cut(const Eigen::Vector3d& place) const;
  bool is_bed(const read::GrainFrame& frame, std::size_t grain) const {
    return survey.has_fixed && frame.is_fixed(grain);
  }
  Rgb kind_color(std::ptrdiff_t kind) const;  ///< of survey.categories
  Rgb chain_color(double force) const;
  /// Grains that are seen through need not shrink or fade for chains to show.
  bool is_glassy() const { return style.opacity < 1; }
  /// Width of the chain of nearly the largest force, in the files' unit.
  double widest_chain() const { return 0.42 * survey.diameter; }
  /// Length of a velocity arrow for speed 1, in the files' unit.
  double arrow_length() const { return survey.speed > 0 ? 1.6 * survey.diameter / survey.speed : 0; }
};

/// They also draw the standing furniture, whose places depend on how the scene is seen.
std::unique_ptr<Painter> make_flat_painter(const Studio& studio, std::unique_ptr<Furniture>& furniture);
std::unique_ptr<Painter> make_solid_painter(const Studio& studio, std::unique_ptr<Furniture>& furniture);

/// The end of the grain that begins with this point: of chute's own files those that follow and are of the same `body`.
std::size_t end_of_body(const read::GrainFrame& frame, std::size_t first);

/// Where grains have been: each earlier place in the periodic copy nearest to the one after it.
struct Trail {
  /// Per grain of the newest frame, the newest place first; empty for those that are fixed.
  std::vector<std::vector<Eigen::Vector3d>> paths;
};
Trail trails(const FrameData& data);

}  // namespace chute::view
