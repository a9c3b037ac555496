#include "experiments/curves.hpp"

#include <cmath>

#include "common/side_by_side.hpp"

namespace chute::experiments {

std::vector<figures::FigureRow> evaluate(const std::vector<ComputedCurve>& curves, int jobs,
                                         const std::function<bool(double)>& progress) {
  std::vector<figures::FigureRow> rows;
  std::vector<const ComputedCurve*> of_row;
  for (const auto& curve : curves)
    for (const double x : curve.x)
      rows.push_back({curve.panel, curve.series, x, 0}), of_row.push_back(&curve);
  const auto on = [&](double part) { return !progress || progress(part); };
  side_by_side(rows.size(), jobs, on,
               [&](std::size_t k, const Report&) { rows[k].y = of_row[k]->y(rows[k].x); });
  return rows;
}

std::vector<double> evenly(double low, double high, int count) {
  std::vector<double> x;
  for (int k = 0; k < count; ++k) x.push_back(low + (high - low) * k / (count - 1));
  return x;
}

std::vector<double> logarithmically(double low, double high, int count) {
  std::vector<double> x;
  for (const double e : evenly(std::log(low), std::log(high), count)) x.push_back(std::exp(e));
  return x;
}

void note_quick(FigureTable& table, const FigureContext& context, const std::string& how) {
  if (context.quick) table.comments.push_back("quick: a cheaper computation than the full figure's: " + how);
}

}  // namespace chute::experiments
