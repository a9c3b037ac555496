#pragma once
#include <cairo.h>

#include "plot/display_list.hpp"

/// Draws a display list on any Cairo surface. Included by the Cairo back end's sources only.
namespace chute::plot {

/// What the drawing becomes. In a file text stays text, and long scatter plots are put in as a picture; in
/// pixels letters are drawn as outlines, since Cairo moves letters made of pixels to whole ones.
enum class Target { file, pixels };

/// Unit of the surface: points times `scale`.
void draw_on_cairo(cairo_t* cairo, const DisplayList& list, double scale, Target target);

/// Pixels per inch of scatter plots that are put into a file as a picture.
inline constexpr double dots_dpi = 450;
/// What of the dots shows inside `clip`; turned inside out if nothing does.
Rect visible_box(const DotsItem& item, const Rect& clip);

/// WorkError if Cairo says that something went wrong.
void check_cairo(cairo_status_t status, const char* doing);

}  // namespace chute::plot
