#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace chute::figures {

/// One row of a figure's CSV. An error that is not known is empty, never 0.
struct FigureRow {
  std::string panel, series;
  double x, y;
  std::optional<double> x_err{}, y_err{};
};

/// The numbers of a figure: rows, and comments that say what x and y are, with units, and how they were made.
struct FigureTable {
  std::vector<std::string> comments;
  std::vector<FigureRow> rows;
  bool x_times = false, y_times = false;  ///< dates and times of day, in seconds since the begin of 1970
  std::map<std::string, std::string>
      labels{};  ///< in the legend, of series whose label is not that of their name
};

struct FigureContext {
  bool quick = false;              ///< a cheaper computation: shorter, fewer points
  int jobs = 1;                    ///< how many may run side by side
  std::vector<std::string> set{};  ///< key=value for every scene, on top of all that recipes set
};

}  // namespace chute::figures
