#include "view/solid_scene.hpp"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCameraPass.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkLight.h>
#include <vtkLightsPass.h>
#include <vtkNew.h>
#include <vtkOpaquePass.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkOpenGLRenderer.h>
#include <vtkOpenGLSphereMapper.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderPassCollection.h>
#include <vtkRenderStepsPass.h>
#include <vtkRenderWindow.h>
#include <vtkSSAOPass.h>
#include <vtkSequencePass.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "view/offscreen.hpp"

namespace chute::view {
namespace {

unsigned char byte(double x) {
  return static_cast<unsigned char>(std::lround(255 * std::clamp(x, 0.0, 1.0)));
}

/// Points with a colour each, and whatever is drawn on them.
struct Colored {
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPoints> points;
  vtkNew<vtkUnsignedCharArray> colors;
  vtkNew<vtkActor> actor;

  Colored() {
    points->SetDataTypeToFloat();
    colors->SetNumberOfComponents(3);
    colors->SetName("color");
    data->SetPoints(points);
    data->GetPointData()->SetScalars(colors);
    auto* look = actor->GetProperty();
    look->SetAmbient(0.26);
    look->SetDiffuse(0.82);
    look->SetSpecular(0.12);
    look->SetSpecularPower(24);
  }
  vtkIdType add(const Vector& p, const Rgb& c) {
    const unsigned char rgb[3] = {byte(c.r), byte(c.g), byte(c.b)};
    colors->InsertNextTypedTuple(rgb);
    return points->InsertNextPoint(p.data());
  }
  void clear() {
    points->Reset();
    colors->Reset();
  }
  void changed() {
    points->Modified();
    colors->Modified();
    data->Modified();
    actor->SetVisibility(points->GetNumberOfPoints() > 0);
  }
};

/// Averages blocks of samples x samples; alpha is multiplied in, so a plain mean is right.
void shrink(const image::Image& large, image::Image& small, int samples) {
  const int count = samples * samples;
  for (int y = 0; y < small.height; ++y) {
    std::uint8_t* to = small.pixel(0, y);
    for (int x = 0; x < small.width; ++x, to += 4)
      for (int c = 0; c < 4; ++c) {
        int sum = count / 2;
        for (int j = 0; j < samples; ++j) {
          const std::uint8_t* from = large.pixel(samples * x, samples * y + j) + c;
          for (int i = 0; i < samples; ++i) sum += from[4 * i];
        }
        to[c] = static_cast<std::uint8_t>(sum / count);
      }
  }
}

}  // namespace

struct SolidScene::Inside {
  OffscreenContext& context;
  int width, height;
  vtkNew<vtkOpenGLRenderer> renderer;
  Colored balls, rods;
  vtkNew<vtkOpenGLSphereMapper> ball_mapper;
  vtkNew<vtkFloatArray> radii, normals;
  vtkNew<vtkOpenGLPolyDataMapper> rod_mapper;
  image::Image large;

  Inside(OffscreenContext& c, int w, int h) : context(c), width(w), height(h) {}

  void add_rod(const Rod& rod, vtkCellArray* triangles);
};

SolidScene::SolidScene(OffscreenContext& context, int width, int height, Rgb ground, double ground_alpha)
    : inside_(std::make_unique<Inside>(context, width, height)) {
  auto& in = *inside_;
  in.radii->SetName("radius");  // the mapper reads float whatever it is
  in.balls.data->GetPointData()->AddArray(in.radii);
  in.ball_mapper->SetInputData(in.balls.data);
  in.ball_mapper->SetScaleArray("radius");
  in.ball_mapper->SetColorModeToDirectScalars();
  in.balls.actor->SetMapper(in.ball_mapper);
  in.normals->SetNumberOfComponents(3);
  in.rods.data->GetPointData()->SetNormals(in.normals);
  in.rod_mapper->SetInputData(in.rods.data);
  in.rod_mapper->SetColorModeToDirectScalars();
  in.rods.actor->SetMapper(in.rod_mapper);

  auto* renderer = in.renderer.Get();
  renderer->SetBackground(ground.r * ground_alpha, ground.g * ground_alpha, ground.b * ground_alpha);
  renderer->SetBackgroundAlpha(ground_alpha);
  renderer->AutomaticLightCreationOff();
  // the key from the upper left behind the eye, and a weak one from the other side that opens the shadows
  const auto light = [&](double x, double y, double z, double intensity) {
    vtkNew<vtkLight> lamp;
    lamp->SetLightTypeToCameraLight();
    lamp->SetPosition(x, y, z);
    lamp->SetFocalPoint(0, 0, 0);
    lamp->SetIntensity(intensity);
    renderer->AddLight(lamp);
  };
  light(-0.55, 0.9, 1, 0.88);
  light(0.9, 0.1, 0.7, 0.25);
  renderer->AddActor(in.balls.actor);
  renderer->AddActor(in.rods.actor);
  context.window()->AddRenderer(renderer);
}

SolidScene::~SolidScene() = default;

void SolidScene::look(const Eye& eye, std::array<double, 2> depth) {
  auto* camera = inside_->renderer->GetActiveCamera();
  Vector position;
  for (std::size_t c = 0; c < 3; ++c) position[c] = eye.centre[c] + eye.distance * eye.towards[c];
  camera->SetPosition(position.data());
  camera->SetFocalPoint(eye.centre.data());
  camera->SetViewUp(eye.up.data());
  camera->SetViewAngle(2 * std::atan(inside_->height / 2.0 / eye.focal) * 180 / std::numbers::pi);
  camera->SetWindowCenter(1 - 2 * eye.at.x / inside_->width, 2 * eye.at.y / inside_->height - 1);
  camera->SetClippingRange(std::max(depth[0], 0.01 * eye.distance), depth[1]);
}

void SolidScene::occlude(double radius) {
  vtkNew<vtkLightsPass> lights;
  vtkNew<vtkOpaquePass> opaque;
  vtkNew<vtkRenderPassCollection> passes;
  passes->AddItem(lights);
  passes->AddItem(opaque);
  vtkNew<vtkSequencePass> sequence;
  sequence->SetPasses(passes);
  vtkNew<vtkCameraPass> camera;
  camera->SetDelegatePass(sequence);
  vtkNew<vtkSSAOPass> occlusion;
  occlusion->SetRadius(2.5 * radius);
  occlusion->SetBias(0.02 * radius);
  occlusion->SetKernelSize(32);
  occlusion->BlurOn();
  occlusion->SetDelegatePass(camera);
  inside_->renderer->SetPass(occlusion);
}

void SolidScene::Inside::add_rod(const Rod& rod, vtkCellArray* triangles) {
  constexpr int sides = 14;
  Vector along;
  double length = 0;
  for (std::size_t c = 0; c < 3; ++c) along[c] = rod.to[c] - rod.from[c], length += along[c] * along[c];
  length = std::sqrt(length);
  if (!(length > 0)) return;
  for (double& x : along) x /= length;
  // two directions across: the coordinate axis that is most across, made square
  std::size_t least = 0;
  for (std::size_t c = 1; c < 3; ++c)
    if (std::abs(along[c]) < std::abs(along[least])) least = c;
  Vector a{}, b;
  a[least] = 1;
  for (std::size_t c = 0; c < 3; ++c) a[c] -= along[least] * along[c];
  const double norm = std::sqrt(1 - along[least] * along[least]);
  for (double& x : a) x /= norm;
  for (std::size_t c = 0; c < 3; ++c)
    b[c] = along[(c + 1) % 3] * a[(c + 2) % 3] - along[(c + 2) % 3] * a[(c + 1) % 3];
  const double slope = (rod.radius_from - rod.radius_to) / length;
  vtkIdType first = 0;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    Vector out, from, to, normal;
    for (std::size_t c = 0; c < 3; ++c) {
      out[c] = std::cos(angle) * a[c] + std::sin(angle) * b[c];
      from[c] = rod.from[c] + rod.radius_from * out[c], to[c] = rod.to[c] + rod.radius_to * out[c];
      normal[c] = (out[c] + slope * along[c]) / std::hypot(1, slope);
    }
    const auto id = rods.add(from, rod.color);
    rods.add(to, rod.color);
    if (i == 0) first = id;
    for (int k = 0; k < 2; ++k) normals->InsertNextTuple(normal.data());
  }
  for (vtkIdType i = 0; i < sides; ++i) {
    const vtkIdType p = first + 2 * i, q = first + 2 * ((i + 1) % sides);
    const vtkIdType one[3] = {p, q, p + 1}, two[3] = {q, q + 1, p + 1};
    triangles->InsertNextCell(3, one);
    triangles->InsertNextCell(3, two);
    if (i >= 1 && i + 1 < sides) {  // the base, which an arrow's head shows
      const vtkIdType base[3] = {first, q, p};
      triangles->InsertNextCell(3, base);
    }
  }
}

void SolidScene::draw(const std::vector<Ball>& balls, const std::vector<Rod>& rods, image::Image& into) {
  auto& in = *inside_;
  in.balls.clear(), in.rods.clear();
  in.radii->Reset(), in.normals->Reset();
  vtkNew<vtkCellArray> vertices, triangles;
  for (const Ball& ball : balls) {
    const auto id = in.balls.add(ball.centre, ball.color);
    in.radii->InsertNextValue(static_cast<float>(ball.radius));
    vertices->InsertNextCell(1, &id);
  }
  for (const Rod& rod : rods) in.add_rod(rod, triangles);
  in.balls.data->SetVerts(vertices);
  in.rods.data->SetPolys(triangles);
  in.radii->Modified(), in.normals->Modified();
  in.balls.changed(), in.rods.changed();
  in.context.draw(in.large);
  if (into.width != in.width || into.height != in.height) into = image::Image(in.width, in.height);
  shrink(in.large, into, samples);
}

}  // namespace chute::view
