#pragma once
#include <string>
#include <vector>

#include "report/film.hpp"
#include "report/gallery.hpp"

namespace chute::report {

/// All that a page tells.
struct Contents {
  std::vector<RunFiles> runs;
  std::vector<Film> films;  ///< one a run, or none at all
  Gallery gallery;
  std::string made_by;
};

/// The page as HTML. What of the gallery cannot be drawn is told in it.
std::string page_of(const Contents& contents);

}  // namespace chute::report
