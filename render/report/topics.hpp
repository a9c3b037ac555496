#pragma once
#include <string>
#include <vector>

#include "plot/figure.hpp"

namespace chute::report {

/// A column of a table and what an axis or a legend says of it, in the plots' TeX.
struct Quantity {
  std::string column, label, si_unit{}, reduced_unit{};
  std::string si_in_space{}, reduced_in_space{};  ///< where the unit depends on the number of dimensions

  /// The label with the unit: "mean velocity $\\bar{v}_x$ (m/s)".
  std::string title(const std::string& units, int dimensions) const;
};

/// Quantities in one frame. Where several runs are compared, each gets a frame of its own.
struct Frame {
  std::vector<Quantity> lines;
  Quantity axis;  ///< what the axis says of several lines; of one: itself
  bool log_y = false;
};

/// What is drawn of a table with a row per x.
struct Topic {
  std::string id, title, file;
  std::string caption, how;  ///< what is seen; the key that makes a run keep it
  Quantity x;
  std::vector<Frame> frames;
  plot::Kind kind = plot::Kind::line;
  bool log_x = false;
};

/// One entry a topic, in the order of the page.
const std::vector<Topic>& topics();

}  // namespace chute::report
