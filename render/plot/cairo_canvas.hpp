#pragma once
#include <cairo.h>

#include "plot/display_list.hpp"

/// Draws a display list on any Cairo surface. Included by the Cairo back end's sources only.
namespace chute::plot {

/// Unit of the surface: points times `scale`. `pixels_for_long_dots`: long scatter plots are put in as a
/// picture.
void draw_on_cairo(cairo_t* cairo, const DisplayList& list, double scale, bool pixels_for_long_dots);

/// WorkError if Cairo says that something went wrong.
void check_cairo(cairo_status_t status, const char* doing);

}  // namespace chute::plot
