#pragma once
#include <array>
#include <optional>
#include <string>

#include "image/image.hpp"
#include "plot/display_list.hpp"
#include "plot/mathtext.hpp"
#include "view/arrangement.hpp"
#include "view/painter.hpp"
#include "view/series_plot.hpp"

namespace chute::view {

/// Directions as they are seen in the picture: x to the right, y down, lengths up to 1.
struct Directions {
  plot::Point gravity{0, 0}, normal{0, 0};  ///< where gravity points; into the incline
  Eigen::Matrix<double, 2, 3> axes = Eigen::Matrix<double, 2, 3>::Zero();  ///< 3D: the coordinate axes
};

/// A line of known length in the scene, pixels. Its label stands at its end, or below it.
struct ScaleBar {
  plot::Point from{0, 0}, to{0, 0};
  double length = 1;  ///< in the files' unit
  bool label_below = false;
};

/// All that is not grains: colour bar, time, scale bar, gravity, a plot beside them. What stays the same is
/// drawn once.
class Furniture {
 public:
  /// `aspect` of the scene, see arrange(). The studio must live longer.
  Furniture(const Studio& studio, double aspect);

  const Arrangement& places() const { return places_; }

  /// A horizontal scale bar below the scene, if one unit is that many pixels long everywhere.
  ScaleBar flat_scale(double pixels_per_unit) const;

  /// Draws the standing part. `arrow_pixels` is the length of an arrow for speed 1, `chain_pixels` the width of the chain of
  /// nearly the largest force.
  void stand(const ScaleBar& scale, const Directions& directions, double arrow_pixels, double chain_pixels);

  /// Puts everything on a frame whose time is `time`.
  void put_on(image::Image& frame, double time) const;
  /// The same on a page whose unit is a pixel.
  void add_to(plot::DisplayList& page, double time) const;

 private:
  const Studio& studio_;
  const FrameStyle& style_;
  const Survey& survey_;
  const Palette& palette_;
  std::string title_;
  Arrangement places_;
  std::optional<SeriesPlot> plot_;
  plot::DisplayList standing_list_;
  image::Image standing_;

  void draw_headline(plot::DisplayList& list) const;
  void draw_bar(plot::DisplayList& list) const;
  void draw_kinds(plot::DisplayList& list) const;
  /// Text of each kind, and of what has no colour of its own.
  std::vector<std::string> kind_labels() const;
  ScaleBar kept_inside(ScaleBar scale) const;
  void draw_scale(plot::DisplayList& list, const ScaleBar& scale) const;
  void draw_key(plot::DisplayList& list, double arrow_pixels, double chain_pixels) const;
  /// What tells how long an arrow, or how wide a chain, is for how much: a mark `length` pixels long, and a text behind it.
  struct Key {
    double length, thickness;
    bool is_arrow;
    plot::TextBox text;
    Rgb color;
    double width(double em) const { return length + 0.5 * em + text.width; }
  };
  Key speed_key(double arrow_pixels) const;
  Key force_key(double chain_pixels) const;
  void draw_gravity(plot::DisplayList& list, const Directions& directions) const;
  plot::Color ink() const { return {palette_.ink.r, palette_.ink.g, palette_.ink.b, 1}; }
  plot::Color quiet() const { return {palette_.quiet.r, palette_.quiet.g, palette_.quiet.b, 1}; }
};

/// "t = 12.50 √(d/g)", "t = 0.125 s", or as the style has it: the time label in the plots' TeX.
std::string time_text(const FrameStyle& style, const Survey& survey, double time);

/// A length of 1, 2 or 5 times a power of ten, at most `longest`; and its label with unit.
double plain_length(double longest);
/// The largest of 1, 1.5, 2, 2.5, 3, 4, 5, 6, 8 times a power of ten that is not above `largest` > 0: for keys.
double plain_below(double largest);
std::string length_text(double length, const std::string& units);

}  // namespace chute::view
