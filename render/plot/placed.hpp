#pragma once
#include "plot/display_list.hpp"

namespace chute::plot {

/// Adds what `part` shows to `page`: its lengths times `scale`, its upper left corner at `at`. Tags stay behind.
void place(DisplayList& page, const DisplayList& part, double scale, const Point& at);

}  // namespace chute::plot
