#pragma once
#include <string>
#include <vector>

#include "plot/display_list.hpp"
#include "plot/figure.hpp"

namespace chute::plot {

/// Where a text or a frame came to stand: what tests check for overlaps.
struct Box {
  enum class Kind {
    frame,
    tick_label,
    axis_label,
    factor,
    title,
    panel_label,
    legend,
    inset,
    note,
    name,
    value
  };  ///< name: at a curve; value: on a contour
  Kind kind;
  Rect rect;  ///< page, points
  int panel;  ///< counted from 0; -1: the whole figure's
  std::string text;
};

struct Layout {
  DisplayList list;
  std::vector<Box> boxes;
};

/// Lays the figure out once for all back ends. InputError if a text cannot be set (mathtext.hpp), a range is
/// wrong, a label does not fit, or the page is too small for its panels.
Layout lay_out(const Figure& figure);

}  // namespace chute::plot
