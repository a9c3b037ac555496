#include "plot/style.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace chute::plot {
namespace {

Look journal() {
  Look look;
  look.ink = Color::hex(0x000000), look.paper = Color::hex(0xffffff), look.quiet = Color::hex(0x707070);
  // blue, vermillion, green, purple, orange, sky, yellow, black
  look.colors = {Color::hex(0x0A457C), Color::hex(0xB32300), Color::hex(0x0B865E), Color::hex(0x4F104A),
                 Color::hex(0xD8972A), Color::hex(0x55CBFB), Color::hex(0x9A8D42), Color::hex(0x000000)};
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
  look.colors = {Color::hex(0x096EC4), Color::hex(0xEC9275), Color::hex(0x51EAC5), Color::hex(0xA96FA2),
                 Color::hex(0xF3B232), Color::hex(0x349EDA), Color::hex(0xFFEC2F), Color::hex(0xFFFFFF)};
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

namespace {

/// The part of a convex outline left of the middle.
Path left_half(const Path& outline, double size) {
  std::vector<Point> ring;
  if (outline.verbs.size() > 1 && outline.verbs[1] == Path::Verb::cubic) {
    constexpr int steps = 32;
    for (int k = 0; k <= steps; ++k) {
      const double angle = std::numbers::pi * (0.5 + static_cast<double>(k) / steps);
      ring.push_back({size / 2 * std::cos(angle), -size / 2 * std::sin(angle)});
    }
  } else {
    const auto& p = outline.points;
    for (std::size_t k = 0; k < p.size(); ++k) {
      const Point a = p[k], b = p[(k + 1) % p.size()];
      if (a.x() <= 1e-9) ring.push_back(a);
      if ((a.x() < -1e-9 && b.x() > 1e-9) || (a.x() > 1e-9 && b.x() < -1e-9))
        ring.push_back(a + a.x() / (a.x() - b.x()) * (b - a));
    }
  }
  Path half;
  for (const Point& p : ring) half.empty() ? half.move(p) : half.line(p);
  return half.close();
}

}  // namespace

MarkerShape marker_shape(int index, double size, Fill fill) {
  auto shape = marker_shape(index, size);
  if (fill == Fill::own || shape.paint == MarkerShape::Paint::strokes) return shape;
  shape.paint = fill == Fill::filled ? MarkerShape::Paint::filled : MarkerShape::Paint::hollow;
  if (fill == Fill::half) shape.inside = left_half(shape.path, size);
  if (fill == Fill::dotted) shape.inside.circle(shape.path.bounds().centre(), 0.19 * size);
  return shape;
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
  if (changes.tick_size) look.tick_size = *changes.tick_size;
  if (changes.legend_size) look.legend_size = *changes.legend_size;
  look.markers = changes.markers, look.dashes = changes.dashes;
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
      return {path.circle({0, 0}, r), Paint::filled, {}};
    case 1:
      return {polygon(4, 1.25 * r, quarter), Paint::hollow, {}};  // squares of the circle's area
    case 2:
      return {polygon(3, 1.5 * r, half), Paint::filled, {}};
    case 3:
      return {polygon(4, 1.35 * r, half), Paint::hollow, {}};
    case 4:
      return {polygon(3, 1.5 * r, -half), Paint::filled, {}};
    case 5:
      return {path.circle({0, 0}, r), Paint::hollow, {}};
    case 6:
      return {polygon(4, 1.25 * r, quarter), Paint::filled, {}};
    case 7:
      return {polygon(3, 1.5 * r, half), Paint::hollow, {}};
    case 8:
      return {polygon(4, 1.35 * r, half), Paint::filled, {}};
    default: {
      const double d = 0.95 * r;
      return {path.move({-d, -d}).line({d, d}).move({-d, d}).line({d, -d}), Paint::strokes, {}};
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
