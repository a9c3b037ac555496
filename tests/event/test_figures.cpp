#include <catch2/catch.hpp>
#include <cmath>

#include "event/event_figures.hpp"

using namespace chute::event;

namespace {

struct Line {
  double slope, intercept;
};
/// Least squares of y against x.
Line fit(const std::vector<double>& x, const std::vector<double>& y) {
  double mx = 0, my = 0, xx = 0, xy = 0;
  const auto n = static_cast<double>(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) mx += x[i] / n, my += y[i] / n;
  for (std::size_t i = 0; i < x.size(); ++i) xx += (x[i] - mx) * (x[i] - mx), xy += (x[i] - mx) * (y[i] - my);
  return {xy / xx, my - xy / xx * mx};
}

}  // namespace

TEST_CASE("fig-4-21: in region C v_x grows without end, and v_z rises and falls on the way up") {
  const auto table = compute_fig_4_21({});
  for (const auto& [panel, sine] : {std::pair{"a", 0.15}, std::pair{"b", 0.3}}) {
    std::vector<double> t, v_x, v_z;
    for (const auto& row : table.rows) {
      if (row.panel != panel) continue;
      if (row.series == "v_x") t.push_back(row.x), v_x.push_back(row.y);
      if (row.series == "v_z") v_z.push_back(row.y);
    }
    REQUIRE(v_x.size() == v_z.size());
    REQUIRE(v_x.size() > 30);
    std::size_t half = 0;
    while (t[half] < 10) ++half;
    const std::vector<double> t1(t.begin(), t.begin() + static_cast<long>(half)),
        t2(t.begin() + static_cast<long>(half), t.end());
    const std::vector<double> v1(v_x.begin(), v_x.begin() + static_cast<long>(half)),
        v2(v_x.begin() + static_cast<long>(half), v_x.end());
    CHECK(fit(t1, v1).slope > 0.03 * 9.81 * sine);
    CHECK(fit(t2, v2).slope > 0.03 * 9.81 * sine);  // no sign of a terminal velocity
    CHECK(fit(t, v_x).slope < 9.81 * sine);
    CHECK(fit(t, v_z).slope > 0);
    std::size_t down = 0, jumps = 0;
    for (std::size_t k = 1; k < v_z.size(); ++k) {
      down += v_z[k] < v_z[k - 1];
      jumps += v_z[k] > 1.5 * v_z[k - 1];
    }
    CHECK(down > v_z.size() / 4);
    CHECK(jumps > 3);
  }
}
