#include "flat/vtk_surface.hpp"

// clang-format off: GLEW insists on coming before anything else of OpenGL
#include <vtk_glew.h>
// clang-format on
#include <vtkActor.h>
#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkOpenGLState.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkShaderProperty.h>
#include <vtkTypeInt64Array.h>
#include <vtkUniforms.h>

#include <algorithm>
#include <iterator>

namespace chute::flat {
namespace {

// Every shape is a rectangle of two triangles; flat_surface.hpp tells what its corners carry.
constexpr const char* vertex_declarations = R"(//VTK::Normal::Dec
in vec2 place; in vec4 shape; in vec4 paint; in vec4 extra; in vec4 mark;
out vec2 at; flat out vec4 form; out vec4 colour; flat out vec4 rim; flat out vec4 dot_colour;
)";
constexpr const char* vertex_body = R"(//VTK::Normal::Impl
at = place; form = shape; colour = paint; rim = extra; dot_colour = mark;
)";
constexpr const char* fragment_declarations = R"(//VTK::Normal::Dec
in vec2 at; flat in vec4 form; in vec4 colour; flat in vec4 rim; flat in vec4 dot_colour;
)";
// The share of a pixel inside a straight edge at distance d is close to d + 1/2.
constexpr const char* fragment_body = R"(//VTK::Light::Impl
float cover;
vec3 rgb = colour.rgb;
if (dot_colour.a > 0.5) {
  float d = length(at);
  cover = clamp(form.x - d + 0.5, 0.0, 1.0) * min(1.0, 4.0 * form.x * form.x);
  rgb = mix(rgb, dot_colour.rgb, clamp(rim.a - distance(at, form.zw) + 0.5, 0.0, 1.0) * min(1.0, rim.a));
  rgb = mix(rgb, rim.rgb, clamp(d - form.x + form.y + 0.5, 0.0, 1.0) * min(1.0, form.y));
} else {
  float half_width = mix(form.y, form.z, clamp(at.x / form.x, 0.0, 1.0));
  float thin = min(1.0, 2.0 * half_width);
  cover = thin * clamp(max(half_width, 0.5) - abs(at.y) + 0.5, 0.0, 1.0) * clamp(at.x + 0.5, 0.0, 1.0)
        * clamp(form.x - at.x + 0.5, 0.0, 1.0);
}
vec2 outside = max(clip_rect.xy - gl_FragCoord.xy, gl_FragCoord.xy - clip_rect.zw);
if (max(outside.x, outside.y) > 0.0 || cover <= 0.0) discard;
fragOutput0 = vec4(rgb, colour.a * cover);
)";

void answer_yes(vtkObject*, unsigned long, void*, void* answer) { *static_cast<bool*>(answer) = true; }

/// VTK's render window on an OpenGL context in memory; no display is asked.
class VtkShapes : public VtkSurface {
 public:
  VtkShapes(int width, int height, const double* ground) : width_(width), height_(height) {
    set_up_window();
    set_up_shapes();
    // one unit is one pixel
    auto* camera = renderer_->GetActiveCamera();
    camera->ParallelProjectionOn();
    camera->SetParallelScale(height / 2.0);
    camera->SetPosition(width / 2.0, height / 2.0, 10);
    camera->SetFocalPoint(width / 2.0, height / 2.0, 0);
    camera->SetViewUp(0, 1, 0);
    camera->SetClippingRange(1, 20);
    renderer_->SetBackground(ground);
    renderer_->SetBackgroundAlpha(ground[3]);
    renderer_->AddActor(actor_);
    window_->AddRenderer(renderer_);
  }
  ~VtkShapes() override { window_->Finalize(); }
  VtkShapes(const VtkShapes&) = delete;
  VtkShapes& operator=(const VtkShapes&) = delete;

  void clip(const std::array<float, 4>& edges) override {
    actor_->GetShaderProperty()->GetFragmentCustomUniforms()->SetUniform4f("clip_rect", edges.data());
  }

  void draw(Corners& corners, std::uint8_t* rgba) override {
    const auto count = static_cast<vtkIdType>(corners.count());
    const auto fill = [](vtkFloatArray* array, std::vector<float>& values) {
      array->SetArray(values.data(), static_cast<vtkIdType>(values.size()), 1);  // VTK does not own it
      array->Modified();
    };
    fill(places_, corners.places);
    for (std::size_t i = 0; i < attributes.size(); ++i) fill(arrays_[i], corners.values[i]);
    vtkNew<vtkTypeInt64Array> offsets, members;
    offsets->SetNumberOfValues(count / 2 + 1);
    members->SetNumberOfValues(count / 2 * 3);
    for (vtkIdType i = 0; i <= count / 2; ++i) offsets->SetValue(i, 3 * i);
    for (vtkIdType i = 0; i < count / 4; ++i)
      for (vtkIdType k = 0; k < 6; ++k) members->SetValue(6 * i + k, 4 * i + (k < 3 ? k : (k - 1) % 4));
    vtkNew<vtkCellArray> triangles;
    triangles->SetData(offsets, members);
    data_->SetPolys(triangles);
    points_->Modified();
    data_->Modified();
    actor_->SetVisibility(count > 0);
    window_->Render();
    read_pixels(rgba);
  }

 private:
  void set_up_window() {
    is_current_->SetCallback(answer_yes);
    window_->AddObserver(vtkCommand::WindowIsCurrentEvent, is_current_);
    window_->SetOwnContext(0);
    window_->SetReadyForRendering(true);
    window_->SetSupportsOpenGL(1);
    window_->SetIsDirect(1);
    window_->SetShowWindow(false);
    window_->SetUseOffScreenBuffers(true);
    window_->SetMultiSamples(0);
    window_->SetAlphaBitPlanes(1);
    window_->SetSwapBuffers(0);
    window_->SetSize(width_, height_);
    window_->OpenGLInit();
  }

  void set_up_shapes() {
    places_->SetNumberOfComponents(3);
    points_->SetData(places_);
    data_->SetPoints(points_);
    for (std::size_t i = 0; i < attributes.size(); ++i) {
      arrays_[i]->SetName(attributes[i].name);
      arrays_[i]->SetNumberOfComponents(attributes[i].components);
      data_->GetPointData()->AddArray(arrays_[i]);
      mapper_->MapDataArrayToVertexAttribute(attributes[i].name, attributes[i].name,
                                             vtkDataObject::FIELD_ASSOCIATION_POINTS);
    }
    mapper_->SetInputData(data_);
    mapper_->ScalarVisibilityOff();
    actor_->SetMapper(mapper_);
    actor_->GetProperty()->LightingOff();
    actor_->ForceOpaqueOn();  // blending stays on; the order of the shapes is the order of drawing
    auto* shader = actor_->GetShaderProperty();
    shader->AddVertexShaderReplacement("//VTK::Normal::Dec", true, vertex_declarations, false);
    shader->AddVertexShaderReplacement("//VTK::Normal::Impl", true, vertex_body, false);
    shader->AddFragmentShaderReplacement("//VTK::Normal::Dec", true, fragment_declarations, false);
    shader->AddFragmentShaderReplacement("//VTK::Light::Impl", true, fragment_body, false);
  }

  /// As they are in the buffer.
  void read_pixels(std::uint8_t* rgba) {
    auto* state = window_->GetState();
    state->PushReadFramebufferBinding();
    window_->GetRenderFramebuffer()->Bind(GL_READ_FRAMEBUFFER);
    window_->GetRenderFramebuffer()->ActivateReadBuffer(0);
    glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
    state->PopReadFramebufferBinding();
    // OpenGL's rows start at the bottom
    const auto row = 4 * static_cast<std::ptrdiff_t>(width_);
    for (std::ptrdiff_t top = 0, bottom = height_ - 1; top < bottom; ++top, --bottom)
      std::swap_ranges(rgba + top * row, rgba + (top + 1) * row, rgba + bottom * row);
  }

  int width_, height_;
  vtkNew<vtkCallbackCommand> is_current_;
  vtkNew<vtkGenericOpenGLRenderWindow> window_;
  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkActor> actor_;
  vtkNew<vtkOpenGLPolyDataMapper> mapper_;
  vtkNew<vtkPolyData> data_;
  vtkNew<vtkPoints> points_;
  vtkNew<vtkFloatArray> places_;
  std::array<vtkNew<vtkFloatArray>, attributes.size()> arrays_;
};

}  // namespace
}  // namespace chute::flat

extern "C" __attribute__((visibility("default"))) chute::flat::VtkSurface* chute_make_vtk_surface(
    int width, int height, const double* ground) {
  return new chute::flat::VtkShapes(width, height, ground);
}
