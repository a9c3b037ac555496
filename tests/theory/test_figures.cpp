#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <set>

#include "common/curvature.hpp"
#include "theory/theory_figures.hpp"

using namespace chute::theory;

namespace {

using Curve = std::map<double, double>;
std::map<std::string, Curve> curves(const FigureTable& table, const std::string& panel = "") {
  std::map<std::string, Curve> all;
  for (const auto& row : table.rows)
    if (row.panel == panel) all[row.series][row.x] = row.y;
  return all;
}
/// Value at x, between rows linearly.
double at(const Curve& curve, double x) {
  const auto above = curve.lower_bound(x);
  REQUIRE(above != curve.begin());
  REQUIRE(above != curve.end());
  const auto below = std::prev(above);
  return below->second + (above->second - below->second) * (x - below->first) / (above->first - below->first);
}

const FigureContext quick{true, 1};

}  // namespace

TEST_CASE(
    "every theory figure has rows, comments for x and y, and finite numbers; what is drawn in others has rows") {
  for (const auto& [id, compute] : theory_figures()) {
    const auto table = compute(quick);
    CAPTURE(id);
    const bool whole = !id.starts_with("theory-");
    CHECK(table.rows.size() > (whole ? 50 : 1));
    REQUIRE(table.comments.size() >= (whole ? 2 : 1));
    if (whole) {
      CHECK(table.comments[0].starts_with("x: "));
      CHECK(table.comments[1].starts_with("y: "));
    }
    for (const auto& row : table.rows) {
      CHECK(std::isfinite(row.x));
      CHECK(std::isfinite(row.y));
    }
  }
}

TEST_CASE(
    "fig-4-17, fig-4-18: the printed theory is a few percent above the corrected one, larger balls are "
    "faster") {
  const auto c = curves(compute_theory_4_17(quick));
  REQUIRE(c.size() == 6);
  for (const char* phi : {"Phi=1.75", "Phi=2.25", "Phi=3"}) {
    const double ratio =
        at(c.at(std::string("theory ") + phi), 0.1) / at(c.at(std::string("theory corrected ") + phi), 0.1);
    CHECK(ratio > 1.01);
    CHECK(ratio < 1.08);
  }
  CHECK(at(c.at("theory Phi=3"), 0.1) > at(c.at("theory Phi=2.25"), 0.1));
  CHECK(at(c.at("theory Phi=2.25"), 0.1) > at(c.at("theory Phi=1.75"), 0.1));
  const auto d = curves(compute_theory_4_18(quick));
  CHECK(d.size() == 2);
  CHECK(at(d.at("theory"), 0.1) < at(c.at("theory Phi=3"), 0.1));  // wider gaps brake
}

TEST_CASE("fig-4-19: the linear formula is the better the larger Φ") {
  const auto c = curves(compute_fig_4_19(quick));
  double before = 1;
  for (const char* phi : {"Phi=1.75", "Phi=2.25", "Phi=3"}) {
    const double off =
        at(c.at(std::string("linear ") + phi), 0.1) / at(c.at(std::string("exact ") + phi), 0.1) - 1;
    CHECK(off > 0);
    CHECK(off < before);
    before = off;
  }
}

TEST_CASE("fig-4-20: θ_AB falls with Φ, disorder raises it, and the corrected one is above the printed") {
  const auto a = curves(compute_theory_4_20(quick), "a"), b = curves(compute_theory_4_20(quick), "b");
  for (const double phi : {1.5, 2.0, 3.0, 4.0}) {
    CHECK(at(a.at("theory"), phi) > at(a.at("theory"), phi + 0.5));
    CHECK(at(a.at("theory corrected"), phi) > at(a.at("theory"), phi));
    CHECK(at(b.at("theory"), phi) > at(a.at("theory"), phi));
  }
}

TEST_CASE("fig-4-04: linear in the middle, over a wide range of angles, faster for larger balls") {
  const auto c = curves(compute_fig_4_04(quick));
  for (const char* series : {"R=3mm", "R=4mm", "R=5mm"}) {
    const auto& curve = c.at(series);
    CHECK(curve.begin()->first < 0.05);
    CHECK(curve.rbegin()->first > 0.4);
    const auto& fit = c.at(std::string(series) + " fit");
    const auto [x0, y0] = *fit.begin();
    const auto [x1, y1] = *fit.rbegin();
    for (const auto& [x, y] : curve)
      if (x > x0 && x < x1) CHECK(y == Approx(y0 + (y1 - y0) * (x - x0) / (x1 - x0)).epsilon(0.02));
  }
  CHECK(c.at("R=5mm").at(0.2) > c.at("R=4mm").at(0.2));
  CHECK(c.at("R=4mm").at(0.2) > c.at("R=3mm").at(0.2));
}

TEST_CASE("theory is smooth to the eye, whatever --quick says") {
  const auto& compute = theory_figures().at("theory-m-08");
  const auto table = compute(quick);
  REQUIRE(table.rows.size() == compute(FigureContext{false, 1}).rows.size());
  for (const char* panel : {"a", "b"})
    for (const auto& [series, curve] : curves(table, panel)) {
      std::vector<double> x, y;
      for (const auto& [a, b] : curve) x.push_back(a), y.push_back(b);
      INFO(series);
      REQUIRE(x.size() >= 25);
      // a bend of half a line's width would not be seen; the corners of these curves are a fifth of that
      REQUIRE(chute::where_bent(x, y, false, chute::smooth_bend).empty());
    }
}

TEST_CASE("a curve over decades is smooth where it is small, too") {
  // 1/(1 + x²) falls by four decades: on a linear axis its foot looks straight, on a logarithmic one it bends
  const auto points = chute::by_curvature([](double x) { return 1 / (1 + x * x); }, 0, 100);
  double worst = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const auto [a, ya] = points[i - 1];
    const auto [b, yb] = points[i];
    const double middle = 1 / (1 + (a + b) * (a + b) / 4);
    worst = std::max(worst, std::abs(std::log(middle) - (std::log(ya) + std::log(yb)) / 2));
  }
  REQUIRE(worst < 4 * chute::smooth_bend * std::log(1e4));
}
