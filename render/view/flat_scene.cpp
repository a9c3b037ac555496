#include "view/flat_scene.hpp"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkShaderProperty.h>
#include <vtkTypeInt64Array.h>
#include <vtkUniforms.h>

#include <algorithm>
#include <cmath>

#include "view/offscreen.hpp"

namespace chute::view {
namespace {

// Every shape is a rectangle of two triangles. Its corners carry:
//   place  disc: pixels from the centre; bar: pixels along and across, from the start
//   shape  disc: radius, width of the edge, mark x, mark y; bar: length, half widths at the start and the
//   end, -1 paint  colour and alpha at that corner extra  disc: colour of the edge, radius of the mark mark
//   colour of the mark, 1 for a disc or 0 for a bar
struct Attribute {
  const char* name;
  int components;
};
constexpr Attribute attributes[] = {{"place", 2}, {"shape", 4}, {"paint", 4}, {"extra", 4}, {"mark", 4}};

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

}  // namespace

struct FlatScene::Inside {
  OffscreenContext& context;
  int width, height;
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkActor> actor;
  vtkNew<vtkOpenGLPolyDataMapper> mapper;
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> corners;
  vtkNew<vtkFloatArray> arrays[std::size(attributes)];
  std::vector<float> values[std::size(attributes)], places;

  Inside(OffscreenContext& c, int w, int h) : context(c), width(w), height(h) {}

  /// Shapes that are not in the picture are left out: one that is far away would spoil the precision of all,
  /// for VTK scales coordinates by their bounds.
  bool shows(double left, double right, double low, double high) const {
    return right > 0 && left < width && high > 0 && low < height;
  }

  /// How near the next shape is: each a little nearer than the one before, for the depth test. One step is
  /// about ten of the depth buffer's, and half a million shapes fit before the eye.
  float height_of_next() const {
    return 1e-5f * static_cast<float>(std::min<std::size_t>(places.size() / 12, 800'000));
  }

  /// One corner: pixel place (y up) and its attributes.
  void corner(double x, double y, float z, const float (&a)[2], const float (&shape)[4],
              const float (&paint)[4], const float (&extra)[4], const float (&mark)[4]) {
    places.insert(places.end(), {static_cast<float>(x), static_cast<float>(y), z});
    values[0].insert(values[0].end(), a, a + 2);
    values[1].insert(values[1].end(), shape, shape + 4);
    values[2].insert(values[2].end(), paint, paint + 4);
    values[3].insert(values[3].end(), extra, extra + 4);
    values[4].insert(values[4].end(), mark, mark + 4);
  }
};

FlatScene::FlatScene(OffscreenContext& context, int width, int height, Rgb ground, double ground_alpha)
    : inside_(std::make_unique<Inside>(context, width, height)),
      ground_(ground),
      ground_alpha_(ground_alpha) {
  auto& in = *inside_;
  in.corners->SetNumberOfComponents(3);
  in.points->SetData(in.corners);
  in.data->SetPoints(in.points);
  for (std::size_t i = 0; i < std::size(attributes); ++i) {
    in.arrays[i]->SetName(attributes[i].name);
    in.arrays[i]->SetNumberOfComponents(attributes[i].components);
    in.data->GetPointData()->AddArray(in.arrays[i]);
    in.mapper->MapDataArrayToVertexAttribute(attributes[i].name, attributes[i].name,
                                             vtkDataObject::FIELD_ASSOCIATION_POINTS);
  }
  in.mapper->SetInputData(in.data);
  in.mapper->ScalarVisibilityOff();
  in.actor->SetMapper(in.mapper);
  in.actor->GetProperty()->LightingOff();
  in.actor->ForceOpaqueOn();  // blending stays on; the order of the shapes is the order of drawing
  auto* shader = in.actor->GetShaderProperty();
  shader->AddVertexShaderReplacement("//VTK::Normal::Dec", true, vertex_declarations, false);
  shader->AddVertexShaderReplacement("//VTK::Normal::Impl", true, vertex_body, false);
  shader->AddFragmentShaderReplacement("//VTK::Normal::Dec", true, fragment_declarations, false);
  shader->AddFragmentShaderReplacement("//VTK::Light::Impl", true, fragment_body, false);
  clip({0, 0, static_cast<double>(width), static_cast<double>(height)});

  // one unit is one pixel
  auto* camera = in.renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetParallelScale(height / 2.0);
  camera->SetPosition(width / 2.0, height / 2.0, 10);
  camera->SetFocalPoint(width / 2.0, height / 2.0, 0);
  camera->SetViewUp(0, 1, 0);
  camera->SetClippingRange(1, 20);
  in.renderer->SetBackground(ground.r * ground_alpha, ground.g * ground_alpha, ground.b * ground_alpha);
  in.renderer->SetBackgroundAlpha(ground_alpha);
  in.renderer->AddActor(in.actor);
  context.window()->AddRenderer(in.renderer);
}

FlatScene::~FlatScene() = default;

void FlatScene::clip(const plot::Rect& rect) {
  clip_ = rect;
  const float edges[4] = {static_cast<float>(rect.left), static_cast<float>(inside_->height - rect.bottom),
                          static_cast<float>(rect.right), static_cast<float>(inside_->height - rect.top)};
  inside_->actor->GetShaderProperty()->GetFragmentCustomUniforms()->SetUniform4f("clip_rect", edges);
}

void FlatScene::clear() {
  inside_->places.clear();
  for (auto& values : inside_->values) values.clear();
  remembered_.clear();
}

void FlatScene::add(const Disc& disc) {
  const auto f = [](double x) { return static_cast<float>(x); };
  const double x = disc.centre.x(), y = inside_->height - disc.centre.y(), reach = disc.radius + 1;
  if (!inside_->shows(x - reach, x + reach, y - reach, y + reach)) return;
  if (remembers_) remembered_.emplace_back(disc);
  const float shape[4] = {f(disc.radius), f(disc.edge_width), f(disc.mark.x()), f(-disc.mark.y())};
  const float paint[4] = {f(disc.fill.r), f(disc.fill.g), f(disc.fill.b), f(disc.alpha)};
  const float extra[4] = {f(disc.edge.r), f(disc.edge.g), f(disc.edge.b), f(disc.mark_radius)};
  const float mark[4] = {f(disc.mark_color.r), f(disc.mark_color.g), f(disc.mark_color.b), 1};
  const float z = inside_->height_of_next();
  for (const auto& [u, v] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
    inside_->corner(x + u * reach, y + v * reach, z, {f(u * reach), f(v * reach)}, shape, paint, extra, mark);
}

void FlatScene::add(const Bar& bar) {
  const auto f = [](double x) { return static_cast<float>(x); };
  const plot::Point a{bar.from.x(), inside_->height - bar.from.y()},
      b{bar.to.x(), inside_->height - bar.to.y()};
  const double length = (b - a).norm();
  if (!(length > 0)) return;
  const plot::Point u = (b - a) / length, n = u.unitOrthogonal();
  const double reach = std::max(bar.width_from, bar.width_to) / 2 + 1.5;
  if (!inside_->shows(std::min(a.x(), b.x()) - reach, std::max(a.x(), b.x()) + reach,
                      std::min(a.y(), b.y()) - reach, std::max(a.y(), b.y()) + reach))
    return;
  if (remembers_) remembered_.emplace_back(bar);
  const float shape[4] = {f(length), f(bar.width_from / 2), f(bar.width_to / 2), -1};
  const float none[4] = {0, 0, 0, 0};
  const float z = inside_->height_of_next();
  for (const auto& [end, side] : {std::pair{0, -1}, {1, -1}, {1, 1}, {0, 1}}) {
    const double along = end ? length + 1 : -1, across = side * reach;
    const float paint[4] = {f(bar.color.r), f(bar.color.g), f(bar.color.b),
                            f(end ? bar.alpha_to : bar.alpha_from)};
    inside_->corner(a.x() + along * u.x() + across * n.x(), a.y() + along * u.y() + across * n.y(), z,
                    {f(along), f(across)}, shape, paint, none, none);
  }
}

namespace {

plot::Color color_of(Rgb c, double alpha) { return {c.r, c.g, c.b, alpha}; }

/// The rim lies around the filled inside, not over it, so that both have the disc's alpha.
void add_curves(plot::DisplayList& list, const Disc& disc) {
  const double rim = std::min(disc.edge_width, disc.radius);
  list.fill(plot::Path().circle(disc.centre, disc.radius - rim), color_of(disc.fill, disc.alpha));
  if (disc.mark_radius > 0)
    list.fill(plot::Path().circle(disc.centre + disc.mark, disc.mark_radius),
              color_of(disc.mark_color, disc.alpha));
  if (rim > 0)
    list.stroke(plot::Path().circle(disc.centre, disc.radius - rim / 2),
                {rim, {}, plot::Cap::butt, plot::Join::round}, color_of(disc.edge, disc.alpha));
}

/// A bar that fades is so many pieces of one alpha each.
void add_curves(plot::DisplayList& list, const Bar& bar) {
  const int pieces = bar.alpha_from == bar.alpha_to ? 1 : 6;
  const plot::Point way = bar.to - bar.from;
  const plot::Point across = way.norm() > 0 ? way.unitOrthogonal() : plot::Point{0, 0};
  for (int k = 0; k < pieces; ++k) {
    const double t0 = static_cast<double>(k) / pieces, t1 = static_cast<double>(k + 1) / pieces;
    const auto corner = [&](double t, double side) -> plot::Point {
      return bar.from + t * way + side / 2 * (bar.width_from + t * (bar.width_to - bar.width_from)) * across;
    };
    list.fill(plot::Path()
                  .move(corner(t0, 1))
                  .line(corner(t1, 1))
                  .line(corner(t1, -1))
                  .line(corner(t0, -1))
                  .close(),
              color_of(bar.color, bar.alpha_from + (t0 + t1) / 2 * (bar.alpha_to - bar.alpha_from)));
  }
}

}  // namespace

plot::DisplayList FlatScene::page() const {
  plot::DisplayList list;
  list.width = inside_->width, list.height = inside_->height;
  list.background = color_of(ground_, ground_alpha_);
  list.items.emplace_back(plot::ClipBegin{clip_});
  for (const auto& shape : remembered_) std::visit([&](const auto& one) { add_curves(list, one); }, shape);
  list.items.emplace_back(plot::ClipEnd{});
  return list;
}

void FlatScene::draw(image::Image& into) {
  auto& in = *inside_;
  const auto count = static_cast<vtkIdType>(in.places.size() / 3);
  const auto fill = [&](vtkFloatArray* array, std::vector<float>& values) {
    array->SetArray(values.data(), static_cast<vtkIdType>(values.size()), 1);  // VTK does not own it
    array->Modified();
  };
  fill(in.corners, in.places);
  for (std::size_t i = 0; i < std::size(attributes); ++i) fill(in.arrays[i], in.values[i]);
  vtkNew<vtkTypeInt64Array> offsets, corners;
  offsets->SetNumberOfValues(count / 2 + 1);
  corners->SetNumberOfValues(count / 2 * 3);
  for (vtkIdType i = 0; i <= count / 2; ++i) offsets->SetValue(i, 3 * i);
  for (vtkIdType i = 0; i < count / 4; ++i)
    for (vtkIdType k = 0; k < 6; ++k) corners->SetValue(6 * i + k, 4 * i + (k < 3 ? k : (k - 1) % 4));
  vtkNew<vtkCellArray> triangles;
  triangles->SetData(offsets, corners);
  in.data->SetPolys(triangles);
  in.points->Modified();
  in.data->Modified();
  in.actor->SetVisibility(count > 0);
  in.context.draw(into);
}

}  // namespace chute::view
