#include "view/offscreen.hpp"

// clang-format off: GLEW insists on coming before anything else of OpenGL
#include <vtk_glew.h>
// clang-format on
#include <vtkCallbackCommand.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLState.h>

#include <algorithm>

#include "gl/context.hpp"

namespace chute::view {
namespace {

void answer_yes(vtkObject*, unsigned long, void*, void* answer) { *static_cast<bool*>(answer) = true; }

}  // namespace

struct OffscreenContext::Inside {
  gl::Context context;
  vtkNew<vtkCallbackCommand> is_current;
  vtkNew<vtkGenericOpenGLRenderWindow> window;

  Inside(int width, int height) : context(width, height, 24) {}
};

OffscreenContext::OffscreenContext(int width, int height) : inside_(std::make_unique<Inside>(width, height)) {
  inside_->is_current->SetCallback(answer_yes);
  auto* window = inside_->window.Get();
  window->AddObserver(vtkCommand::WindowIsCurrentEvent, inside_->is_current);
  window->SetOwnContext(0);
  window->SetReadyForRendering(true);
  window->SetSupportsOpenGL(1);
  window->SetIsDirect(1);
  window->SetShowWindow(false);
  window->SetUseOffScreenBuffers(true);
  window->SetMultiSamples(0);
  window->SetAlphaBitPlanes(1);
  window->SetSwapBuffers(0);
  window->SetSize(width, height);
  window->OpenGLInit();
}

OffscreenContext::~OffscreenContext() {
  inside_->context.make_current();  // VTK lets go of its buffers and shaders while they exist
  inside_->window->Finalize();
}

vtkRenderWindow* OffscreenContext::window() const { return inside_->window; }

void OffscreenContext::draw(image::Image& into) {
  auto* window = inside_->window.Get();
  inside_->context.make_current();
  window->Render();
  const int width = window->GetSize()[0], height = window->GetSize()[1];
  if (into.width != width || into.height != height) into = image::Image(width, height);
  auto* state = window->GetState();
  state->PushReadFramebufferBinding();
  window->GetRenderFramebuffer()->Bind(GL_READ_FRAMEBUFFER);
  window->GetRenderFramebuffer()->ActivateReadBuffer(0);
  glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, into.rgba.data());
  state->PopReadFramebufferBinding();
  // OpenGL's rows start at the bottom
  const std::size_t row = 4 * static_cast<std::size_t>(width);
  for (int top = 0, bottom = height - 1; top < bottom; ++top, --bottom)
    std::swap_ranges(into.pixel(0, top), into.pixel(0, top) + row, into.pixel(0, bottom));
}

}  // namespace chute::view
