#pragma once
#include <array>
#include <cstdint>

#include "flat/flat_surface.hpp"

/// The door between the program and the library that holds VTK's drawing: nothing else of it is asked for by name, and
/// it asks the program for nothing but OpenGL (glx_shim.c).
namespace chute::flat {

/// What the library makes.
class VtkSurface {
 public:
  virtual ~VtkSurface() = default;
  virtual void clip(const std::array<float, 4>& edges) = 0;
  /// `rgba` takes 4 width height bytes, the top row first.
  virtual void draw(Corners& corners, std::uint8_t* rgba) = 0;
};

/// The library's only function, by its name in C. Makes a surface on the OpenGL context that is current, which must be
/// current again whenever the surface draws or goes. The caller owns it. `ground` is as make_surface() has it.
using MakeVtkSurface = VtkSurface*(int width, int height, const double* ground);
inline constexpr auto make_vtk_surface_name = "chute_make_vtk_surface";

}  // namespace chute::flat
