#include "experiments/curves.hpp"

#include <algorithm>
#include <cmath>

#include "common/curvature.hpp"
#include "common/side_by_side.hpp"

namespace chute::experiments {

std::vector<figures::FigureRow> evaluate(const std::vector<ComputedCurve>& curves, int jobs,
                                         const std::function<bool(double)>& progress) {
  struct Job {
    std::size_t curve;
    double x, y = 0;
  };
  std::vector<std::vector<Job>> done(curves.size());
  std::vector<Job> jobs_now;
  for (std::size_t c = 0; c < curves.size(); ++c)
    for (const double x : curves[c].x) jobs_now.push_back({c, x});
  const auto on = [&](double part) { return !progress || progress(part); };
  for (int round = 0; !jobs_now.empty(); ++round) {
    side_by_side(jobs_now.size(), jobs, on, [&](std::size_t k, const Report&) {
      jobs_now[k].y = curves[jobs_now[k].curve].y(jobs_now[k].x);
    });
    for (const auto& job : jobs_now) done[job.curve].push_back(job);
    jobs_now.clear();
    if (round == most_halvings) break;
    for (std::size_t c = 0; c < curves.size(); ++c) {
      if (!curves[c].by_curvature) continue;
      std::sort(done[c].begin(), done[c].end(), [](const Job& a, const Job& b) { return a.x < b.x; });
      std::vector<double> x, y;
      for (const auto& job : done[c]) x.push_back(job.x), y.push_back(job.y);
      for (const double at : where_bent(x, y, curves[c].log)) jobs_now.push_back({c, at});
    }
  }
  std::vector<figures::FigureRow> rows;
  for (std::size_t c = 0; c < curves.size(); ++c) {
    if (curves[c].by_curvature)
      std::sort(done[c].begin(), done[c].end(), [](const Job& a, const Job& b) { return a.x < b.x; });
    for (const auto& job : done[c]) rows.push_back({curves[c].panel, curves[c].series, job.x, job.y});
  }
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
