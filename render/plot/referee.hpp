#pragma once
#include <string>
#include <vector>

#include "plot/figure.hpp"
#include "plot/layout.hpp"

/// Reads a finished picture as a referee would, from its display list.
namespace chute::plot {

struct Finding {
  enum class Kind {
    text_overlap,     ///< two texts, a text and a frame, or a text that leaves the page
    text_on_data,     ///< a legend, note or name over a marker or a curve
    marker_on_frame,  ///< one that touches the frame
    point_lost,       ///< a point without marker, dot or arrow
    mostly_outside,   ///< a panel of which more than half of the points are arrows at its frame
    color_alone,      ///< two series that only colour tells apart
    alike,            ///< two that nothing does
    no_parameters     ///< a panel that does not say what was held fixed
  } kind;
  int panel;         ///< counted from 0; -1: of the whole figure
  std::string what;  ///< in words
};
const char* name(Finding::Kind kind);

/// All that is wrong with it; the layout must be of this figure.
std::vector<Finding> review(const Figure& figure, const Layout& layout);

}  // namespace chute::plot
