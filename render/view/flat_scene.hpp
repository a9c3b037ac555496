#pragma once
#include <memory>
#include <variant>
#include <vector>

#include "flat/flat_surface.hpp"
#include "image/image.hpp"
#include "plot/display_list.hpp"
#include "view/color_map.hpp"

namespace chute::view {

/// A disc in the picture; lengths and places in pixels, y down.
struct Disc {
  plot::Point centre{0, 0};
  double radius = 1;
  Rgb fill, edge;
  double alpha = 1;
  double edge_width = 0;   ///< of the line inside the rim, 0: none
  plot::Point mark{0, 0};  ///< centre of the spin mark, from the disc's centre
  double mark_radius = 0;  ///< 0: none
  Rgb mark_color;
};

/// A straight line with square ends whose width may change evenly: a line, an arrow's head, a force.
struct Bar {
  plot::Point from{0, 0}, to{0, 0};
  double width_from = 1, width_to = 1;
  Rgb color;
  double alpha_from = 1, alpha_to = 1;
};

/// Discs and bars in a plane, each drawn over those before it. Their edges are exact: a shader works out how
/// much of every pixel a shape covers, so nothing is sampled more than once.
class FlatScene {
 public:
  /// `width` x `height` pixels. WorkError if they cannot be drawn on.
  FlatScene(int width, int height, Rgb ground, double ground_alpha);

  void clear();
  void add(const Disc& disc);
  void add(const Bar& bar);
  /// Nothing shows outside; pixels.
  void clip(const plot::Rect& rect);
  void draw(image::Image& into);

  /// From here on shapes are remembered, for page().
  void remember() { remembers_ = true; }
  /// What was added, as curves: one unit is one pixel.
  plot::DisplayList page() const;

 private:
  bool shows(double left, double right, double low, double high) const;
  float height_of_next() const;

  std::unique_ptr<flat::Surface> surface_;
  flat::Corners corners_;
  int width_, height_;
  bool remembers_ = false;
  std::vector<std::variant<Disc, Bar>> remembered_;
  plot::Rect clip_;
  Rgb ground_;
  double ground_alpha_;
};

}  // namespace chute::view
