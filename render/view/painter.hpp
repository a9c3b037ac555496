#pragma once
#include <memory>
#include <vector>

#include "image/image.hpp"
#include "read/contacts.hpp"
#include "read/grain_frame.hpp"
#include "view/frame_style.hpp"
#include "view/furniture.hpp"
#include "view/survey.hpp"

namespace chute::view {

/// What one frame is drawn from.
struct FrameData {
  const read::GrainFrame& frame;
  const std::vector<read::Contact>& contacts;
  const std::vector<const read::GrainFrame*>& earlier;  ///< the oldest first
};

/// Turns grains into a picture: FlatPainter in the plane, SolidPainter in space.
class Painter {
 public:
  virtual ~Painter() = default;
  virtual void paint(const FrameData& data, image::Image& into) = 0;
};

/// What both painters work with.
struct Studio {
  FrameStyle style;
  Survey survey;
  Palette palette;
  ColorMap map;

  Studio(const FrameStyle& style, const Survey& survey);
  std::vector<Rgb> colors(const read::GrainFrame& frame) const;  ///< one per grain; fixed ones get the bed's
  bool is_bed(const read::GrainFrame& frame, std::size_t grain) const {
    return survey.has_fixed && frame.is_fixed(grain);
  }
  /// Length of a velocity arrow for speed 1, in the files' unit.
  double arrow_length() const { return survey.speed > 0 ? 1.6 * survey.diameter / survey.speed : 0; }
};

/// They also draw the standing furniture, whose places depend on how the scene is seen.
std::unique_ptr<Painter> make_flat_painter(const Studio& studio, std::unique_ptr<Furniture>& furniture);
std::unique_ptr<Painter> make_solid_painter(const Studio& studio, std::unique_ptr<Furniture>& furniture);

/// A grain's place at an earlier time, taken to the periodic copy nearest to `now`.
struct Trail {
  std::vector<std::vector<std::array<double, 3>>>
      paths;  ///< per grain of the newest frame, the newest place first
};
Trail trails(const FrameData& data);

}  // namespace chute::view
