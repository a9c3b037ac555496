// What a frame costs: render_bench [--benchmark_filter=…]. Spheres in a dense packing over a bed, 1920 x 1080, one
// processor core: reading the file as chute writes it, drawing, and encoding the picture.
#include <benchmark/benchmark.h>
#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

#include <cmath>
#include <filesystem>
#include <random>

#include "image/png.hpp"
#include "read/grain_frame.hpp"
#include "view/frame_renderer.hpp"

namespace {
using namespace chute;

/// Layers of a lattice, shaken; the lowest is fixed.
read::GrainFrame packing(std::size_t count) {
  read::GrainFrame frame;
  frame.file = "packing", frame.units = "reduced", frame.time = 1;
  const auto side = static_cast<std::size_t>(std::cbrt(static_cast<double>(count) / 0.8));
  frame.domain.max() = {static_cast<double>(side), static_cast<double>(side), 0};
  frame.gravity = {std::sin(0.35), 0, -std::cos(0.35)};
  frame.arrays = {{"id", 1, {}},          {"type", 1, {}},  {"velocity", 3, {}},
                  {"orientation", 4, {}}, {"force", 3, {}}, {"angular_velocity", 3, {}},
                  {"mass", 1, {}}};
  std::mt19937 dice(1);
  std::uniform_real_distribution<double> shake(-0.08, 0.08);
  for (std::size_t i = 0; i < count; ++i) {
    const auto layer = static_cast<double>(i / side / side);
    frame.x.push_back(static_cast<double>(i % side) + shake(dice));
    frame.y.push_back(static_cast<double>(i / side % side) + shake(dice));
    frame.z.push_back(0.8 * layer + shake(dice));
    frame.radius.push_back(0.46 + shake(dice) / 2);
    for (auto& array : frame.arrays)
      for (int c = 0; c < array.components; ++c) array.values.push_back(0.1 * layer + shake(dice));
    frame.arrays[0].values.back() = static_cast<double>(i), frame.arrays[1].values.back() = layer > 0;
  }
  return frame;
}

read::GrainFrame discs(std::size_t count) {
  auto frame = packing(count);
  frame.dimensions = 2;
  const auto side = static_cast<std::size_t>(std::sqrt(3.0 * static_cast<double>(count)));
  for (std::size_t i = 0; i < count; ++i)
    frame.x[i] = static_cast<double>(i % side), frame.y[i] = static_cast<double>(i / side), frame.z[i] = 0;
  frame.gravity = {std::sin(0.35), -std::cos(0.35), 0};
  return frame;
}

void draw(benchmark::State& state, const read::GrainFrame& frame, const view::FrameStyle& style) {
  view::Surveyor surveyor(style);
  surveyor.see(frame);
  view::FrameRenderer renderer(style, surveyor.finish());
  for (auto _ : state) benchmark::DoNotOptimize(renderer.draw({.frame = frame, .time = 1}).rgba.data());
}

void draw_discs(benchmark::State& state) { draw(state, discs(static_cast<std::size_t>(state.range(0))), {}); }
void draw_spheres(benchmark::State& state) {
  draw(state, packing(static_cast<std::size_t>(state.range(0))), {});
}
void draw_all_options(benchmark::State& state) {
  view::FrameStyle style;
  style.occlusion = true, style.outlines = style.floor = style.box = true;
  draw(state, packing(static_cast<std::size_t>(state.range(0))), style);
}

/// As chute writes it: appended raw data, zlib.
void read_spheres(benchmark::State& state) {
  const auto frame = packing(static_cast<std::size_t>(state.range(0)));
  const auto path = std::filesystem::temp_directory_path() / "chute-render-bench.vtp";
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> vertices;
  for (vtkIdType i = 0; i < static_cast<vtkIdType>(frame.size()); ++i) {
    points->InsertNextPoint(frame.centre(static_cast<std::size_t>(i)).data());
    vertices->InsertNextCell(1, &i);
  }
  data->SetPoints(points), data->SetVerts(vertices);
  const auto add = [&](const std::string& name, int components, const std::vector<double>& values) {
    vtkNew<vtkDoubleArray> array;
    array->SetName(name.c_str());
    array->SetNumberOfComponents(components);
    for (const double value : values) array->InsertNextValue(value);
    data->GetPointData()->AddArray(array);
  };
  add("radius", 1, frame.radius);
  for (const auto& array : frame.arrays) add(array.name, array.components, array.values);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(data);
  writer->SetFileName(path.c_str());
  writer->SetDataModeToAppended(), writer->EncodeAppendedDataOff(), writer->SetCompressorTypeToZLib();
  writer->Write();
  for (auto _ : state)
    benchmark::DoNotOptimize(read::read_frame(path, {}, {"velocity", "orientation"}).size());
  std::filesystem::remove(path);
}

void encode(benchmark::State& state) {
  const auto frame = packing(100'000);
  view::FrameStyle style;
  view::Surveyor surveyor(style);
  surveyor.see(frame);
  view::FrameRenderer renderer(style, surveyor.finish());
  const auto& picture = renderer.draw({.frame = frame, .time = 1});
  for (auto _ : state) benchmark::DoNotOptimize(image::encode_png(picture).size());
}

BENCHMARK(draw_discs)->Arg(300)->Unit(benchmark::kMillisecond);
BENCHMARK(draw_spheres)->Arg(1'000)->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);
BENCHMARK(draw_all_options)->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);
BENCHMARK(read_spheres)->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);
BENCHMARK(encode)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
