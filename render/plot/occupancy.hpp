#pragma once
#include <optional>
#include <string>
#include <vector>

#include "plot/figure.hpp"
#include "plot/geometry.hpp"

namespace chute::plot {

/// Where a frame already holds ink, as cells of 2 points: what legends, labels and insets look for room on.
class Occupancy {
 public:
  explicit Occupancy(const Rect& frame);

  void mark(const Rect& rect);
  void mark_segment(Point a, Point b, double width);
  /// A text, legend or inset: others may cover ink if they must, but never these. `contour`: the value that it is of one.
  void mark_text(const Rect& rect, const std::string& contour = "");
  struct Text {
    Rect rect;
    std::string contour;  ///< empty: another text
  };
  const std::vector<Text>& texts() const { return texts_; }
  /// Inside the frame and over no text.
  bool clear_of_texts(const Rect& rect) const;
  /// Share of the cells under `rect` that hold ink, 0 to 1; 1 if it leaves the frame.
  double covered(const Rect& rect) const;
  bool free(const Rect& rect) const { return covered(rect) == 0; }

  struct Room {
    Point at{0, 0};          ///< upper left corner of the block
    double from_corner = 0;  ///< how far it is from the best corner, points
  };
  /// Room for a block of this size, `inset` away from the frame, that covers nothing and sits as near to a
  /// corner as can be (`wanted`: at that corner or nowhere else). Nothing if there is none.
  std::optional<Room> room_for(double width, double height, double inset, Place wanted) const;
  /// The next best: over no text, as near as can be to the corner `wanted`, or where it covers least ink if
  /// none is wanted. Nothing if texts fill the frame.
  std::optional<Point> beside_texts(double width, double height, double inset, Place wanted) const;
  /// The corner place itself, taken or not.
  Point corner(double width, double height, double inset, Place place) const;

 private:
  Rect frame_;
  int columns_, rows_;
  std::vector<int> cells_;  // 1: ink
  std::vector<Text> texts_;
  mutable std::vector<int> summed_;  // of the cells above and to the left; empty: to be made

  static constexpr double cell = 2;
};

}  // namespace chute::plot
