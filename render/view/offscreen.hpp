#pragma once
#include <memory>

#include "image/image.hpp"

class vtkRenderWindow;

namespace chute::view {

/// VTK's render window on an OpenGL context in memory; no display is asked. One per thread; several may be
/// used in turn.
class OffscreenContext {
 public:
  /// `width` x `height` pixels. WorkError if no context can be had.
  OffscreenContext(int width, int height);
  ~OffscreenContext();
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;

  /// The window on which renderers are put.
  vtkRenderWindow* window() const;

  /// Draws the window's renderers and reads the pixels as they are in the buffer: the top row first, alpha
  /// multiplied in. `into` is reused if it has the size.
  void draw(image::Image& into);

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace chute::view
