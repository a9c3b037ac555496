#pragma once
#include <string>
#include <vector>

#include "plot/layout.hpp"
#include "plot/marks.hpp"

/// The frame of a plot with its ticks and texts: first how much room they need, then where they stand.
namespace chute::plot {

/// Sizes in points that a plot's texts are set at; an inset's are smaller.
struct TextSizes {
  double tick, label, gap;  ///< gap: between the frame, tick labels and axis label
};

struct Margins {
  double left = 0, right = 0, top = 0, bottom = 0;
  double x_gap = 0;  ///< part of `bottom`: between the frame and the x tick labels
  void widen(const Margins& m);
};

/// Text of at most `room` points: set at `size`, or smaller down to the smallest type. InputError if that is
/// not enough.
TextBox set_to_fit(const std::string& text, double size, double room);

/// A plot prepared for a frame of a certain size.
class Axes {
 public:
  /// `show_x`, `show_y`: whether tick labels and axis label are drawn there. InputError if a label is longer
  /// than the frame allows even at the smallest type.
  Axes(const Plot& plot, const Span& x, const Span& y, const TextSizes& sizes, bool show_x, bool show_y);

  /// The axis on the right has this range; `color` is that of its ticks and texts, such as of its only series.
  void set_right(const Span& right, std::optional<Color> color) { right_ = right, right_color_ = color; }
  /// The same of the axis above.
  void set_top(const Span& top, std::optional<Color> color) { top_ = top, top_color_ = color; }

  /// Chooses ticks for a frame of this size and says what room they and the labels need around it.
  Margins fit(double width, double height);

  /// Draws ticks, frame and texts. `common` are the widest margins of the panel's column (left, right) and
  /// row (x_gap), so that axis labels of a column and tick labels of a row stand in line.
  void draw(DisplayList& list, const Look& look, const Rect& frame, const Margins& common, int panel,
            std::vector<Box>& boxes) const;

  const Span& x() const { return x_; }
  const Span& y() const { return y_; }
  const std::optional<Span>& right() const { return right_; }
  const std::optional<Span>& top() const { return top_; }

 private:
  const Plot& plot_;
  Span x_, y_;
  TextSizes sizes_;
  bool show_x_, show_y_;
  Ticks x_ticks_, y_ticks_;
  TextBox x_label_, y_label_, x_factor_, y_factor_;
  TextBox x_line_;  ///< height of the line that the axis label, and the factor if it is beside it, stand on
  std::vector<TextBox> x_texts_, y_texts_;
  double tick_ascent_ = 0, tick_descent_ = 0;  ///< of the x tick labels: one baseline
  bool x_factor_below_ = false;                ///< in a row of its own, beneath the axis label
  std::optional<Span> right_;
  std::optional<Color> right_color_;
  Ticks right_ticks_;
  TextBox right_label_, right_factor_;
  std::vector<TextBox> right_texts_;
  double right_widest_ = 0;  ///< of its tick labels
  std::optional<Span> top_;
  std::optional<Color> top_color_;
  Ticks top_ticks_;
  TextBox top_label_, top_factor_;
  std::vector<TextBox> top_texts_;
  double top_ascent_ = 0, top_descent_ = 0;  ///< of its tick labels
  double above_ = 0;                         ///< how far the axis above and its texts reach above the frame

  void fit_top(double width, Margins& m);
  void draw_top(DisplayList& list, const Look& look, const Rect& frame, int panel, double shrink,
                std::vector<Box>& boxes) const;
  void fit_right(double height, Margins& m);
  void draw_right(DisplayList& list, const Look& look, const Rect& frame, int panel, double shrink,
                  std::vector<Box>& boxes) const;
  double row() const { return tick_ascent_ + tick_descent_; }
};

}  // namespace chute::plot
