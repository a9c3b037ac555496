#pragma once
#include <map>
#include <string>

#include "plot/layout.hpp"
#include "plot/marks.hpp"

namespace chute::plot {

/// Draws a small plot inside `frame` on its own ground: where it covers no data, or else in the corner where
/// it covers least. InputError if it is too small for its labels.
void draw_inset(Layout& out, const Inset& inset, const Rect& frame, int panel, const Look& look,
                const std::map<std::string, SeriesLook>& looks, Occupancy& occupied);

}  // namespace chute::plot
