#pragma once
#include <string>
#include <vector>

#include "plot/layout.hpp"
#include "plot/marks.hpp"

namespace chute::plot {

/// A name that stands at the curves that it is of, in their colour, in place of an entry in a legend.
struct CurveName {
  std::string text;
  std::vector<const Series*> curves;
};

/// Puts each name where it covers nothing, beside one of its curves and farther from all others, rather near their right ends.
/// False, and nothing is drawn, if one finds no such place.
bool put_names(Layout& out, const std::vector<CurveName>& names, const Frame& frame, const Plot& plot,
               const std::map<std::string, SeriesLook>& looks, Occupancy& occupied, const Look& look,
               int panel);

}  // namespace chute::plot
