#pragma once
#include <memory>

namespace chute::view {

/// An OpenGL 3.3 core context without a display, current on the thread that made it. Who makes contexts
/// otherwise (EGL without a surface, say) adds a function like make_osmesa_context.
struct GlContext {
  virtual ~GlContext() = default;
  virtual void make_current() = 0;
};

/// In memory, through OSMesa. WorkError if it cannot be had in this size (pixels).
std::unique_ptr<GlContext> make_osmesa_context(int width, int height);

/// What pixels depend on beside the data: the renderer's vector width and the C locale. make_osmesa_context
/// pins them first; other code that makes contexts by itself calls this before.
void pin_environment();

}  // namespace chute::view
