#include "plot/style.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace chute::plot {
namespace {

Look journal() {
  Look look;
  look.ink = Color::hex(0x000000), look.paper = Color::hex(0xffffff), look.quiet = Color::hex(0x707070);
  // blue, vermillion, bluish green, reddish purple, orange, sky blue, yellow (darkened), black
  look.colors = {Color::hex(0x0072B2), Color::hex(0xD55E00), Color::hex(0x009E73), Color::hex(0xCC79A7),
                 Color::hex(0xE69F00), Color::hex(0x56B4E9), Color::hex(0x9C8A00), Color::hex(0x000000)};
  look.shades = {Color::hex(0xDCEBF6), Color::hex(0xFBE6D2), Color::hex(0xDDF1E7), Color::hex(0xF3E3EC)};
  return look;
}

Look slides() {
  Look look = journal();
  look.label_size = 16, look.tick_size = 14, look.legend_size = 14, look.panel_size = 16;
  look.hairline = 0.9, look.line_width = 2, look.marker_size = 7.5, look.dot_radius = 0.9;
  look.major_tick = 6, look.minor_tick = 3.5, look.cap = 5, look.margin = 4;
  return look;
}

Look dark() {
  Look look = journal();
  look.ink = Color::hex(0xE8E8E8), look.paper = Color::hex(0x16181D), look.quiet = Color::hex(0x9A9A9A);
  look.colors = {Color::hex(0x56B4E9), Color::hex(0xF0883E), Color::hex(0x2CC79B), Color::hex(0xE39BC5),
                 Color::hex(0xE69F00), Color::hex(0x7FA6FF), Color::hex(0xF0E442), Color::hex(0xFFFFFF)};
  look.shades = {Color::hex(0x1E3347), Color::hex(0x45301F), Color::hex(0x1D3D33), Color::hex(0x40293A)};
  return look;
}

Path polygon(int corners, double radius, double first_angle) {
  Path path;
  for (int i = 0; i < corners; ++i) {
    const double angle = first_angle + 2 * std::numbers::pi * i / corners;
    const Point p{radius * std::cos(angle), -radius * std::sin(angle)};
    i ? path.line(p) : path.move(p);
  }
  return path.close();
}

}  // namespace

const Look& look_of(Style style) {
  static const std::array looks{journal(), slides(), dark()};
  return looks[static_cast<std::size_t>(style)];
}

Look look_of(const Figure& figure) {
  Look look = look_of(figure.style);
  const auto& changes = figure.changes;
  if (!changes.colors.empty()) look.colors = changes.colors;
  if (changes.ink) look.ink = *changes.ink;
  if (changes.paper) look.paper = *changes.paper;
  if (changes.font_size) {
    const double part = *changes.font_size / look.label_size;
    for (double* size : {&look.label_size, &look.tick_size, &look.legend_size, &look.panel_size})
      *size *= part;
  }
  if (changes.line_width) look.line_width = *changes.line_width;
  if (changes.marker_size) look.marker_size = *changes.marker_size;
  if (changes.hairline) look.hairline = *changes.hairline;
  return look;
}

MarkerShape marker_shape(int index, double size) {
  using Paint = MarkerShape::Paint;
  constexpr double quarter = std::numbers::pi / 4, half = std::numbers::pi / 2;
  const double r = size / 2;
  Path path;
  switch (((index % marker_count) + marker_count) % marker_count) {
    case 0:
      return {path.circle({0, 0}, r), Paint::filled};
    case 1:
      return {polygon(4, 1.25 * r, quarter), Paint::hollow};  // squares of the circle's area
    case 2:
      return {polygon(3, 1.5 * r, half), Paint::filled};
    case 3:
      return {polygon(4, 1.35 * r, half), Paint::hollow};
    case 4:
      return {polygon(3, 1.5 * r, -half), Paint::filled};
    case 5:
      return {path.circle({0, 0}, r), Paint::hollow};
    case 6:
      return {polygon(4, 1.25 * r, quarter), Paint::filled};
    case 7:
      return {polygon(3, 1.5 * r, half), Paint::hollow};
    case 8:
      return {polygon(4, 1.35 * r, half), Paint::filled};
    default: {
      const double d = 0.95 * r;
      return {path.move({-d, -d}).line({d, d}).move({-d, d}).line({d, -d}), Paint::strokes};
    }
  }
}

std::vector<double> dash_pattern(int index, double width) {
  static const std::array<std::vector<double>, dash_count> patterns{
      {{}, {4.5, 2}, {1.2, 1.6}, {6, 1.8, 1.2, 1.8}, {9, 2.5}, {5, 1.6, 1.2, 1.6, 1.2, 1.6}}};
  auto dash = patterns[static_cast<std::size_t>(((index % dash_count) + dash_count) % dash_count)];
  for (double& d : dash) d *= width;
  return dash;
}

}  // namespace chute::plot
