#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "image/image.hpp"
#include "read/contacts.hpp"
#include "read/grain_frame.hpp"
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

  /// `contacts` for style.chains; `earlier` frames, the oldest first, for style.trail. WorkError if the
  /// picture came out blank, which only a broken graphics library does. The picture is valid until the next
  /// call.
  const image::Image& draw(const read::GrainFrame& frame, double time,
                           const std::vector<read::Contact>& contacts = {},
                           const std::vector<const read::GrainFrame*>& earlier = {});

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace chute::view
