#pragma once
#include <array>
#include <optional>
#include <string>
#include <utility>

#include "view/color_map.hpp"

namespace chute::view {

enum class Background { white, dark, transparent };

/// From where the grains are seen.
struct Camera {
  /// 2D: the part of the plane that is shown, x0 x1 y0 y1 in the files' unit; all of the run if not given.
  std::optional<std::array<double, 4>> window;
  /// 3D, degrees: the eye goes around the incline's normal, 0 looks across the flow with x to the right, 90
  /// looks up the slope at what comes down; elevation is above the incline's plane.
  double azimuth = 30, elevation = 22;
  double zoom = 1;  ///< 3D: > 1 is nearer than what shows the whole run
};

/// How frames look. The same style and data give the same pixels.
struct FrameStyle {
  int width = 1920, height = 1080;  ///< pixels
  /// Point array that colours the grains, with `:x`, `:y`, `:z` or `:magnitude` for one of three components;
  /// `none` for a plain colour. Empty: the speed if there is one.
  std::string color;
  std::string map;                                 ///< empty: viridis, or rdbu for values of both signs
  std::optional<std::pair<double, double>> range;  ///< of the colours; else from the whole run
  Background background = Background::white;
  bool tilt = false;       ///< turn the picture so that gravity points down
  bool arrows = false;     ///< velocity arrows
  bool chains = false;     ///< contact forces as lines, wide where the force is large
  bool copies = false;     ///< faded copies beyond the periodic ends
  bool occlusion = false;  ///< 3D: ambient occlusion
  bool spin = true;        ///< 2D: a mark on every disc that turns with it
  bool furniture = true;   ///< colour bar, time, scale bar, gravity
  int trail = 0;           ///< earlier frames whose positions are drawn as a trail
  Camera camera;

  /// InputError if a value is out of bounds (sizes from 64 to 8192, range LOW < HIGH …).
  void check() const;
  /// All of the above as text: part of what a frame is drawn from.
  std::string describe() const;
};

/// Ground and inks that go with a background.
struct Palette {
  Rgb ground, ink, quiet, bed, plain;
  double ground_alpha;
};
Palette palette_of(Background background);

}  // namespace chute::view
