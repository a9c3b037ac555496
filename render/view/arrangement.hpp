#pragma once
#include <optional>
#include <span>
#include <vector>

#include "plot/geometry.hpp"
#include "view/survey.hpp"

namespace chute::view {

/// Where everything stands in a frame, in pixels from the top left. The same in all frames of a run; nothing
/// overlaps.
struct Arrangement {
  double em = 16;    ///< size of the type
  plot::Rect scene;  ///< the grains
  bool has_bar = false, has_gravity = false, has_scale = false, has_time = false, has_key = false,
       has_plot = false;
  double foot = 0;             ///< room below the scene, em
  bool upright_bar = true;     ///< colour bar beside the scene; else below it
  plot::Rect bar;              ///< the colours themselves
  plot::Point title{0, 0};     ///< left end of the colour bar's title
  plot::Point time{0, 0};      ///< left end of the time's line
  plot::Point key{0, 0};       ///< right end of the line that explains the arrows, above the scene
  plot::Point scale{0, 0};     ///< left end of the scale bar
  plot::Point headline{0, 0};  ///< middle of the picture's title
  plot::Rect plot;             ///< the plot of a time series, its texts included
  plot::Rect gravity;          ///< the arrows that show where gravity points
};

/// Widths of the colour bar's texts, in em.
struct BarTexts {
  double title = 0, longest_label = 0;
  double kinds = 0;  ///< of all patches and names in one row, where kinds stand in place of the bar
  double rows = 0;   ///< how many these are: one below the other beside the scene
};

/// `aspect` = width / height of what is to be seen. InputError if the picture is too small for the plot that is wanted.
Arrangement arrange(const FrameStyle& style, const Survey& survey, double aspect, const BarTexts& texts);

/// Right ends of keys of these widths (pixels), above the scene's right end: in a row beside the time's line, which is `time_width`
/// long, as many as fit, and the others in a row above that, if it stays below `top`. Nothing for one that has no room.
std::vector<std::optional<plot::Point>> key_places(const Arrangement& places, std::span<const double> widths,
                                                   double time_width, double top);

/// The room for a scale bar below the scene, pixels; its label stands to the right of it.
double longest_scale(const plot::Rect& scene, double em);

}  // namespace chute::view
