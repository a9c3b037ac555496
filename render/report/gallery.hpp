#pragma once
#include <span>
#include <string>
#include <vector>

#include "plot/figure.hpp"
#include "report/run_files.hpp"

namespace chute::report {

/// A figure of the page, with its numbers.
struct Exhibit {
  std::string id, title, caption;
  plot::Figure figure;
  std::string csv;  ///< panel,series,x,y,x_err,y_err of all that is drawn
};

/// What the page cannot show, and what a scene must say to have it.
struct Missing {
  std::string what, how;
};

struct Gallery {
  std::vector<Exhibit> exhibits;
  std::vector<Missing> missing;
};

/// All figures that the runs have tables for. Of one run each figure shows its quantities; of several each quantity has a frame
/// with a curve a run, in the run's colour (its number, see plot/style.hpp). InputError if a table is damaged.
Gallery make_gallery(std::span<const RunFiles> runs);

}  // namespace chute::report
