#pragma once
#include <memory>

#include "image/image.hpp"
#include "plot/display_list.hpp"
#include "view/frame_data.hpp"
#include "view/frame_style.hpp"
#include "view/survey.hpp"

namespace chute::view {

/// Draws the frames of one run, one after the other: everything that stays the same is made once. One
/// renderer per process or thread.
class FrameRenderer {
 public:
  /// `survey` says what is common to all frames. InputError if the style is wrong, WorkError if no context
  /// can be had.
  FrameRenderer(const FrameStyle& style, const Survey& survey);
  ~FrameRenderer();

  /// WorkError if the picture came out blank: nothing is in view. The picture is valid until the next call.
  const image::Image& draw(const FrameData& data);

  /// The same for a file: texts, and in the plane grains, as curves. One unit is one pixel.
  plot::DisplayList page(const FrameData& data);

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace chute::view
