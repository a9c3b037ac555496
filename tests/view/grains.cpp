#include "grains.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/atomic_file.hpp"

namespace grains {

using namespace chute;

read::GrainFrame one_disc() {
  read::GrainFrame frame;
  frame.file = "made by hand";
  frame.dimensions = 2;
  frame.units = "reduced";
  frame.own = true;
  frame.time = 1.5;
  for (const char* name : {"id", "type", "angle"}) frame.arrays.push_back({name, 1, {}});
  frame.arrays.push_back({"velocity", 3, {}});
  add(frame, 0, 0, 0, 1, 2);
  return frame;
}

void add(read::GrainFrame& frame, double x, double y, double z, double radius, double velocity, double angle,
         int type) {
  frame.arrays[0].values.push_back(static_cast<double>(frame.size()));
  frame.arrays[1].values.push_back(type);
  frame.arrays[2].values.push_back(angle);
  frame.arrays[3].values.insert(frame.arrays[3].values.end(), {velocity, 0.0, 0.0});
  frame.x.push_back(x), frame.y.push_back(y), frame.z.push_back(z);
  frame.radius.push_back(radius);
}

read::GrainFrame small_chute() {
  auto frame = one_disc();
  frame.x.clear(), frame.y.clear(), frame.z.clear(), frame.radius.clear();
  for (auto& array : frame.arrays) array.values.clear();
  frame.domain.max() = {10, 0, 0};
  const double slope = 20 * std::acos(-1.0) / 180;
  frame.gravity = {std::sin(slope), -std::cos(slope), 0};
  for (int i = 0; i < 10; ++i) add(frame, i + 0.5, 0, 0, 0.5, 0, 0, 0);
  for (int i = 0; i < 20; ++i)
    add(frame, i % 10 + (i < 10 ? 0.1 : 0.6), i < 10 ? 0.9 : 1.8, 0, 0.45 + 0.002 * i, 0.1 * i, 0.3 * i);
  return frame;
}

read::GrainFrame cube(int n) {
  auto frame = small_chute();
  frame.dimensions = 3;
  frame.gravity = {0.3, 0, -0.95};
  frame.x.clear(), frame.y.clear(), frame.z.clear(), frame.radius.clear();
  for (auto& array : frame.arrays) array.values.clear();
  for (int i = 0; i < n * n * n; ++i) {
    const int a = i % n, b = i / n % n, c = i / n / n;
    add(frame, a + 0.03 * (c % 3), b + 0.05 * (c % 2), c, 0.5, 0.2 * c, 0, c > 0);
  }
  return frame;
}

image::Image picture(const read::GrainFrame& frame, const view::FrameStyle& style) {
  view::Surveyor surveyor(style);
  surveyor.see(frame);
  view::FrameRenderer renderer(style, surveyor.finish());
  return renderer.draw({.frame = frame, .time = frame.time.value_or(0)});
}

view::FrameStyle bare(int side) {
  view::FrameStyle style;
  style.width = style.height = side;
  style.furniture = false;
  style.camera.window = {-2, 2, -2, 2};
  style.range = {0, 4};
  return style;
}

void write(const read::GrainFrame& frame, const std::filesystem::path& path) {
  std::string text = "# vtk DataFile Version 3.0\ngrains\nASCII\nDATASET POLYDATA\n";
  text +=
      fmt::format("FIELD FieldData 3\nTimeValue 1 1 double\n{}\ndomain 6 1 double\n", frame.time.value_or(0));
  for (int c = 0; c < 3; ++c) text += fmt::format("{} {} ", frame.domain.min()[c], frame.domain.max()[c]);
  text += "\ngravity 3 1 double\n";
  for (double x : frame.gravity) text += fmt::format("{} ", x);
  text += fmt::format("\nPOINTS {} double\n", frame.size());
  for (std::size_t i = 0; i < frame.size(); ++i)
    text += fmt::format("{} {} {}\n", frame.x[i], frame.y[i], frame.z[i]);
  text += fmt::format("POINT_DATA {}\nFIELD FieldData {}\nradius 1 {} double\n", frame.size(),
                      frame.arrays.size() + 1, frame.size());
  for (double r : frame.radius) text += fmt::format("{}\n", r);
  for (const auto& array : frame.arrays) {
    text += fmt::format("{} {} {} double\n", array.name, array.components, frame.size());
    for (double value : array.values) text += fmt::format("{}\n", value);
  }
  std::filesystem::create_directories(path.parent_path());
  write_atomically(path, text);
}

}  // namespace grains
