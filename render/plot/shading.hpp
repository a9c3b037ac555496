#pragma once
#include "plot/marks.hpp"

/// What a panel holds besides series: shaded regions, reference lines, notes.
namespace chute::plot {

void draw_region(Painter& painter, const Frame& frame, const Plot& plot, const Region& region);
void draw_reference(Painter& painter, const Frame& frame, const Reference& reference);
/// Its label, drawn above the data; tells the occupancy about the line too.
void draw_reference_label(Painter& painter, const Frame& frame, const Reference& reference);
/// Where its text stands.
Rect note_box(const Look& look, const Frame& frame, const Note& note);
void draw_note(Painter& painter, const Frame& frame, const Note& note);

}  // namespace chute::plot
