#include <catch2/catch.hpp>
#include <vector>

#include "experiments/column.hpp"

using namespace chute::experiments;

namespace column_tests {

namespace {

/// The same column of hard grains, event by event: the truth for t_0 ≫ t_n. Places less the diameters.
double hard_column(int count, double e_n, double gap) {
  std::vector<double> x, v(static_cast<std::size_t>(count) + 1, -1.0);
  for (int k = 0; k <= count; ++k) x.push_back(k * gap);
  v[0] = 0;  // the wall
  for (;;) {
    double soonest = INFINITY;
    std::size_t next = 0;
    for (std::size_t k = 0; k + 1 < x.size(); ++k) {
      const double closing = v[k] - v[k + 1];
      if (closing <= 0) continue;
      const double t = (x[k + 1] - x[k]) / closing;
      if (t < soonest) soonest = t, next = k;
    }
    if (soonest == INFINITY) break;
    for (std::size_t k = 0; k < x.size(); ++k) x[k] += v[k] * soonest;
    x[next + 1] = x[next];
    const double relative = v[next + 1] - v[next];
    if (next == 0) {
      v[1] = -e_n * v[1];
    } else {
      const double mean = 0.5 * (v[next] + v[next + 1]);
      v[next] = mean + 0.5 * e_n * relative, v[next + 1] = mean - 0.5 * e_n * relative;
    }
  }
  double sum = 0;
  for (const double u : v) sum += u;
  return sum / count;
}

}  // namespace

namespace {
double soft_column(int count, double e_n, double gap_time, double steps) {
  // Linear forces: only t_0/t_n matters, as long as overlaps are small against the grains.
  Column column;
  column.laws = {chute::laws::SpringDashpot::from_restitution(1e8, e_n), chute::laws::Frictionless{}};
  column.grain.radius = 0.5;
  column.count = count, column.gap_time = gap_time, column.steps_per_contact = steps;
  return hit_wall(column).total_restitution;
}
}  // namespace

TEST_CASE("A column of one grain has e_tot = e_n; hard columns are those of the event-driven limit") {
  CHECK(soft_column(1, 0.87, 1, 2000) == Approx(0.87).epsilon(1e-4));
  for (const int count : {2, 5, 10}) {
    const double soft = soft_column(count, 0.87, 100, 400), hard = hard_column(count, 0.87, 1);
    INFO(count << " grains: soft " << soft << ", hard " << hard);
    CHECK(soft == Approx(hard).epsilon(2e-3));
  }
}

}  // namespace column_tests
