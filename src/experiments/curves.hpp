#pragma once
#include <functional>
#include <string>
#include <vector>

#include "experiments/computed_figures.hpp"

namespace chute::experiments {

/// One curve of a figure: y at each x.
struct ComputedCurve {
  std::string panel, series;
  std::vector<double> x;
  std::function<double(double)> y;
  bool by_curvature = false;  ///< further points wherever it bends
  bool log = false;           ///< along a logarithmic axis
};

/// All points of all curves, up to `jobs` at a time, in the order of the curves. `progress` is told the part
/// that is done, and stops the work by returning false (WorkError).
std::vector<figures::FigureRow> evaluate(const std::vector<ComputedCurve>& curves, int jobs,
                                         const std::function<bool(double)>& progress = {});

/// `count` ≥ 2 numbers from `low` to `high`, evenly spaced or evenly in the logarithm.
std::vector<double> evenly(double low, double high, int count);
std::vector<double> logarithmically(double low, double high, int count);

/// `quick` figures say so.
void note_quick(FigureTable& table, const FigureContext& context, const std::string& how);

}  // namespace chute::experiments
