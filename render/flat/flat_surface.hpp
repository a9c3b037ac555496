#pragma once
#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "image/image.hpp"

/// Shapes in a plane, drawn by VTK on an OpenGL context in memory. VTK's drawing libraries take half of the time in
/// which chute starts, so they stand in a library of their own, which is loaded when something is drawn.
namespace chute::flat {

/// What every corner of a shape carries besides its place, for the shader.
struct Attribute {
  const char* name;
  int components;
};
/// place  disc: pixels from the centre; bar: pixels along and across, from the start
/// shape  disc: radius, width of the edge, mark x, mark y; bar: length, half widths at the start and the end, -1
/// paint  colour and alpha at that corner
/// extra  disc: colour of the edge, radius of the mark
/// mark   colour of the mark, 1 for a disc or 0 for a bar
inline constexpr std::array<Attribute, 5> attributes{
    {{"place", 2}, {"shape", 4}, {"paint", 4}, {"extra", 4}, {"mark", 4}}};

/// Rectangles, four corners each, in the order in which they are drawn.
struct Corners {
  std::vector<float> places;  ///< x, y in pixels, y up, and z: how near
  std::array<std::vector<float>, attributes.size()> values;

  std::size_t count() const { return places.size() / 3; }
  void clear() {
    places.clear();
    for (auto& one : values) one.clear();
  }
};

/// A surface of pixels on which rectangles are drawn, each over those before it. One per thread; several may be used in
/// turn.
class Surface {
 public:
  virtual ~Surface() = default;
  /// Nothing shows outside; pixels, y up: left, low, right, high.
  virtual void clip(const std::array<float, 4>& edges) = 0;
  /// Draws the shapes alone on the ground. `into` gets the size of the surface, the top row first, alpha multiplied in.
  virtual void draw(Corners& corners, image::Image& into) = 0;
};

/// `ground` is red, green, blue, multiplied by alpha, and alpha. WorkError if no OpenGL can be had, or what draws is not
/// beside the program.
std::unique_ptr<Surface> make_surface(int width, int height, const std::array<double, 4>& ground);

}  // namespace chute::flat
