#pragma once
#include <string>

#include "plot/draw.hpp"

namespace chute::plot {

/// The list as an SVG file. Text stays text: a label is one `<text>` whose letters are placed one by one, set
/// in STIXGeneral, of which the file carries the letters that it uses (@font-face). Browsers take those;
/// editors that know no fonts in files (Inkscape) take the installed family of that name.
std::string svg_text(const DisplayList& list, const Metadata& metadata);

}  // namespace chute::plot
