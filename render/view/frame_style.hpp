#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "view/color_map.hpp"

namespace chute::view {

enum class Background { white, dark, transparent };

/// A camera that goes along the slope with a grain, or with the mean of all that move.
struct Follow {
  std::optional<long long> id;  ///< of the grain; none: the mean
};

/// From where the grains are seen.
struct Camera {
  /// 2D: the part of the plane that is shown, x0 x1 y0 y1 in the files' unit; all of the run if not given.
  std::optional<std::array<double, 4>> window;
  /// 3D, degrees: the eye goes around the incline's normal, 0 looks across the flow with x to the right, 90
  /// looks up the slope at what comes down; elevation is above the incline's plane.
  double azimuth = 30, elevation = 22;
  bool all = false;  ///< every grain is in view, also one that was thrown far out
  double zoom = 1;   ///< 3D: > 1 is nearer than what shows the whole run
  /// Places then count from what is followed, along the slope and along what is periodic; else the camera stands.
  std::optional<Follow> follow;
};

/// Where the camera is at some time; between two of these it moves smoothly (camera_path.hpp).
struct CameraKey {
  double time = 0;  ///< of the frames
  Camera camera;
};

/// A half space in which nothing is drawn: what lies beyond `value` on an axis of the files.
struct Cut {
  int axis = 0;
  bool above = true;  ///< greater values are cut away, else smaller ones
  double value = 0;

  bool hides(const Eigen::Vector3d& place) const { return above ? place[axis] > value : place[axis] < value; }
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
  /// Which way is up, of any length; else against gravity, or what the survey finds.
  std::optional<Eigen::Vector3d> up;
  std::vector<std::string> species;  ///< names of kinds, in the order of their numbers
  bool tilt = false;                 ///< turn the picture so that gravity points down
  bool arrows = false;               ///< velocity arrows
  bool chains = false;               ///< contact forces as lines, wide where the force is large
  bool copies = false;               ///< faded copies beyond the periodic ends
  double copy_reach = 0.16;          ///< so many periods far to each side
  bool impacts = false;              ///< marks where grains of the bed were hit so far
  bool occlusion = false;            ///< 3D: ambient occlusion
  double opacity = 1;                ///< of grains that move: the share of what lies behind that each covers
  /// 3D: a dark line inside the rim of every grain; shadows on a plane below; edges of the periodic box, or of the box
  /// of all grains. Not told: not drawn, but see furnish_space in survey.hpp.
  std::optional<bool> outlines, floor, box;
  bool spin = true;       ///< marks that turn with the grains
  bool furniture = true;  ///< colour bar, time, scale bar, gravity
  std::string title;      ///< above everything, in the plots' TeX; empty: none
  /// The line that tells the time, in the plots' TeX, with one `{}` or `{:.2f}` (digits behind the point) where the time
  /// stands, times time_scale; `none`: no such line. Empty: t with the unit of the data.
  std::string time;
  double time_scale = 1;
  double font_size = 0;   ///< pixels, of all type; 0: by the size of the picture
  int trail = 0;          ///< earlier frames whose positions are drawn as a trail
  std::vector<Cut> cuts;  ///< grains whose centres lie in one of them are left out
  Camera camera;
  std::vector<CameraKey> camera_keys;  ///< by time; empty: the camera stands, or follows

  /// The forces of chains are what colours tell, and grains are plain.
  bool colors_forces() const { return color == "chains"; }

  /// InputError if a value is out of bounds (sizes from 64 to 8192, range LOW < HIGH …).
  void check() const;
  /// All of the above as text: part of what a frame is drawn from.
  std::string describe() const;
};

/// Where in a FrameStyle::time the number stands.
struct TimePlace {
  std::size_t at, length;
  std::optional<int> decimals;  ///< none: as many as tell the frames apart
};
/// Nothing if there is not exactly one place.
std::optional<TimePlace> time_place(const std::string& text);

/// Ground and inks that go with a background.
struct Palette {
  Rgb ground, ink, quiet, bed, plain;
  Rgb mark;   ///< of what is pointed at: where grains were hit
  Rgb chain;  ///< of contact forces, unlike arrows and unlike all colour maps
  double ground_alpha;
};
Palette palette_of(Background background);

inline constexpr std::size_t kind_color_count = 8;
/// Colours of kinds: told apart by all eyes, and from the bed and the ground.
const std::array<Rgb, kind_color_count>& kind_colors(Background background);

}  // namespace chute::view
