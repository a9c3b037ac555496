#pragma once
#include <string>
#include <vector>

#include "view/frame_style.hpp"
#include "view/survey.hpp"

/// Options that do nothing for what is drawn: whoever asks for them expects something else.
namespace chute::view {

/// InputError naming an option that does nothing for these grains.
void check_options(const FrameStyle& style, const Survey& survey);
/// The same for maps of cells, which have axes and a bar, and of all that tells how grains look nothing but the colours'
/// range. `plot`: a curve is asked for beside the picture.
void check_map_options(const FrameStyle& style, bool plot);
/// A line for each option that does nothing in this run, but may do something in another of the same command.
std::vector<std::string> idle_options(const FrameStyle& style, const Survey& survey);

}  // namespace chute::view
