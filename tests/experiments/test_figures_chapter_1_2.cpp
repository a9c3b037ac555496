#include "experiments/binary_impact.hpp"
#include "figure_rows.hpp"

using namespace chute;
using namespace chute::test;

namespace figures_chapter_1_2_tests {

// The full ones take a quarter of a minute: with --long.
TEST_CASE("Quick figures have the same panels and series as full ones", "[.exact]") {
  for (const auto& id : law_figures) {
    INFO(id);
    CHECK(Rows(id, true).names() == Rows(id, false).names());
  }
}

TEST_CASE("Figures do not depend on how many threads compute them") {
  for (const char* id : {"fig-2-15", "fig-3-04", "fig-3-08"}) {
    const auto one = make_figure(id, {true, 1}), three = make_figure(id, {true, 3});
    REQUIRE(one.rows.size() == three.rows.size());
    for (std::size_t k = 0; k < one.rows.size(); ++k) CHECK(one.rows[k].y == three.rows[k].y);
  }
}

TEST_CASE(
    "fig-1-06 sticks along -beta up to psi_0, then slides along a slope of 1 and crosses zero near 1.39") {
  const Rows rows("fig-1-06");
  const auto& walton = rows("walton");
  const double psi_0 = 3.5 * 0.21 * 1.89 / 1.39;
  for (std::size_t k = 0; k < walton.x.size(); ++k)
    CHECK(walton.y[k] ==
          Approx(walton.x[k] <= psi_0 ? -0.39 * walton.x[k] : walton.x[k] - 3.5 * 0.21 * 1.89).margin(1e-9));
  CHECK(walton.zero() == Approx(1.389).epsilon(1e-3));
}

TEST_CASE("fig-2-02 rises with v, turns near v_bf and at a tenth of it, then falls") {
  const Rows rows("fig-2-02");
  const auto& fast = rows("t_n=1e-5");
  const auto& slow = rows("t_n=1e-4");
  const auto& failure = rows("v_bf");
  REQUIRE(failure.x.size() == 2);
  CHECK(failure.x[0] == Approx(10 * failure.x[1]));
  int which = 0;
  for (const auto* curve : {&fast, &slow}) {
    const double v_bf = failure.x[static_cast<std::size_t>(which++)];
    CHECK(curve->at(0.2) / curve->at(0.1) == Approx(2).epsilon(0.03));
    const auto top =
        static_cast<std::size_t>(std::max_element(curve->y.begin(), curve->y.end()) - curve->y.begin());
    WARN("largest braking at " << curve->x[top] << " m/s; v_bf " << v_bf << " m/s");
    CHECK(curve->x[top] > 0.6 * v_bf);
    CHECK(curve->x[top] < 1.5 * v_bf);
    CHECK(curve->at(10 * v_bf) < 0.4 * curve->y[top]);
    for (std::size_t k = top + 1; k < curve->y.size(); ++k) CHECK(curve->y[k] < curve->y[k - 1]);
  }
  // The text's corner, 35 m/s, is where the curve leaves the straight line: it is then down to ...
  WARN("braking at 35 m/s over that of the straight line: " << fast.at(35) / (fast.at(0.1) * 350));
  CHECK(fast.at(35) / (fast.at(0.1) * 350) < 0.6);
  CHECK(fast.at(3.5) / (fast.at(0.1) * 35) > 0.8);
}

TEST_CASE("fig-2-02 falls as 1/v only without damping") {
  using namespace experiments;
  const auto braking = [](const laws::Normal& normal, double v) {
    const auto impact = Acetate::meet({normal, laws::Coulomb{0.25}}, v, 87.4 * std::numbers::pi / 180, 2000);
    const auto before = impact.j.velocity - impact.i.velocity;
    const auto outcome = collide(impact);
    return v - dot(outcome.j.velocity - outcome.i.velocity, before) / v;
  };
  const auto slope = [&](const laws::Normal& normal) {
    return std::log(braking(normal, 4000) / braking(normal, 2000)) / std::log(2.0);
  };
  const double undamped = slope(laws::SpringDashpot::from_restitution(Acetate::stiffness, 1));
  const double damped = slope(Acetate::spring_dashpot());
  WARN("exponent between 2000 and 4000 m/s: " << undamped << " without damping, " << damped << " with");
  CHECK(undamped == Approx(-1).epsilon(0.02));
  CHECK(damped > -0.5);
}

TEST_CASE("fig-2-15 shows detachment for small gaps and N^2 collisions for wide ones") {
  const Rows rows("fig-2-15");
  const auto& e = rows("e_tot");
  WARN("e_tot " << e.y.front() << " at t_0/t_n = 1e-3, " << e.at(1) << " at 1, " << e.y.back() << " at 100");
  CHECK(e.at(1e-3) > 0.93);  // N = 10 grains lose less than half of what one does: 1 − 0.87
  CHECK(e.at(1e-2) > 0.93);
  CHECK(e.at(1e-3) > 0.87);
  CHECK(e.at(10) < 0.25);
  CHECK(e.at(100) == Approx(e.at(10)).epsilon(1e-2));
}

}  // namespace figures_chapter_1_2_tests
