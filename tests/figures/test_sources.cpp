// Formulas, and tables whose columns are named, as sources of a figure.
#include <catch2/catch.hpp>
#include <cmath>

#include "../runs/folder.hpp"
#include "common/error.hpp"
#include "core/random.hpp"
#include "figures/fits.hpp"
#include "figures/formula.hpp"
#include "figures/table_source.hpp"

namespace sources_tests {
using namespace chute;
using namespace chute::figures;
using chute::test::Folder;
using chute::test::message;

namespace {

Fit saturation() {
  Fit fit;
  fit.form = Fit::Form::expression;
  fit.expression = "a*(1-exp(-x/b))";
  fit.start = {"a=1", "b=1"};
  fit.series = "law", fit.of = {"s"};
  fit.legend = true;
  return fit;
}

/// Points of 0.3 (1 − exp(−x/2)), off by a gaussian scatter that is known.
std::vector<FitPoint> points_of(double scatter, std::uint64_t seed) {
  Random random(seed, Purpose::engine);
  std::vector<FitPoint> points;
  for (int k = 1; k <= 30; ++k) {
    const double x = 0.3 * k;
    points.push_back({x, 0.3 * (1 - std::exp(-x / 2)) + scatter * random.normal(), 1});
  }
  return points;
}

}  // namespace

TEST_CASE("a formula is what it says, and what is none is told") {
  const Formula formula("0.3*(1-exp(-x/2))");
  for (const double x : {0.0, 0.7, 3.0}) CHECK(formula.at(x) == Approx(0.3 * (1 - std::exp(-x / 2))));
  CHECK(Formula("2*pi*x + ln(e)").at(0.5) == Approx(3.14159265358979 + 1));
  const Formula two("a*x^n", {"a", "n"});
  CHECK(two.at(3, {2, 2}) == Approx(18));
  CHECK_THROWS_WITH(Formula("0.3*(1-exp(-x/2)"), Catch::Contains("is no formula of x"));
  CHECK_THROWS_WITH(Formula("a*x"), Catch::Contains("\"a\""));
}

TEST_CASE("a formula put through points finds its parameters, with errors that fit their scatter") {
  const auto exact = fit_formula(saturation(), points_of(0, 1));
  REQUIRE(exact);
  CHECK(exact->constants[0].value == Approx(0.3));
  CHECK(exact->constants[1].value == Approx(2));
  double a_square = 0, b_square = 0;
  constexpr int trials = 200;
  for (std::uint64_t seed = 1; seed <= trials; ++seed) {
    const auto found = fit_formula(saturation(), points_of(0.01, seed));
    REQUIRE(found);
    a_square += std::pow((found->constants[0].value - 0.3) / found->constants[0].error, 2) / trials;
    b_square += std::pow((found->constants[1].value - 2) / found->constants[1].error, 2) / trials;
  }
  CHECK(a_square == Approx(1.07).margin(0.35));
  CHECK(b_square == Approx(1.07).margin(0.35));
  CHECK_FALSE(fit_formula(saturation(), {{1, 1, 1}, {2, 2, 1}}));
}

TEST_CASE("points whose errors are known count by them") {
  // Two clouds about different constants: the one with the small errors decides.
  Fit fit = saturation();
  fit.expression = "a", fit.start = {"a=0"};
  std::vector<FitPoint> points;
  for (int k = 0; k < 10; ++k)
    points.push_back({double(k), 1, 1, 0.01}), points.push_back({double(k), 2, 1, 1.0});
  const auto found = fit_formula(fit, points);
  REQUIRE(found);
  CHECK(found->constants[0].value == Approx((1e4 * 1 + 1 * 2) / (1e4 + 1)));
}

TEST_CASE("constants stand in the legend with errors of one digit, two where that is a 1") {
  CHECK(with_error({0.30123, 0.0042}) == "0.301 \\pm 0.004");
  CHECK(with_error({0.30123, 0.0014}) == "0.3012 \\pm 0.0014");
  CHECK(with_error({1234.5, 21}) == "1234 \\pm 21");
  CHECK(with_error({-2.6, 0.3}) == "-2.6 \\pm 0.3");
  CHECK(with_error({5.2e8, 3e6}) == "(5.20 \\pm 0.03) 10^{8}");
  FigureTable table;
  for (const auto& p : points_of(0.001, 3)) table.rows.push_back({"", "s", p.x, p.y});
  draw_fit(saturation(), table);
  CHECK_THAT(table.labels.at("law"), Catch::StartsWith("$a = 0.3") || Catch::StartsWith("$a = 0.29"));
  CHECK(table.labels.at("law").find("\\pm") != std::string::npos);
  CHECK(table.rows.back().series == "law");
}

TEST_CASE("columns of any table become series, by name, by value and by filter") {
  const Folder folder;
  test::write(folder / "sweep.csv",
              "# a sweep\nverdict,incline.sin,grains.size_ratio,v_x,v_x_err\n"
              "stopped,0.02,2,,\nsteady,0.04,2,0.1,0.01\nsteady,0.04,3,0.2,\nrunaway,0.06,3,0.4,0.02\n");
  TableColumns phases;
  phases.x = "incline.sin", phases.y = "grains.size_ratio", phases.by = "verdict";
  auto rows = rows_of_table(phases, folder / "sweep.csv").rows;
  REQUIRE(rows.size() == 4);
  CHECK(rows[0].series == "stopped");
  CHECK(rows[3].series == "runaway");
  CHECK(rows[3].x == 0.06);
  TableColumns speeds;
  speeds.x = "incline.sin", speeds.y = "v_x", speeds.y_err = "v_x_err", speeds.by = "grains.size_ratio";
  rows = rows_of_table(speeds, folder / "sweep.csv").rows;
  REQUIRE(rows.size() == 3);  // the gap is none
  CHECK(rows[0].series == "size_ratio=2");
  CHECK(rows[0].y_err == 0.01);
  CHECK_FALSE(rows[1].y_err);
  speeds.where = {{"verdict", "steady"}};
  speeds.by.reset(), speeds.series = "mine";
  rows = rows_of_table(speeds, folder / "sweep.csv").rows;
  REQUIRE(rows.size() == 2);
  CHECK(rows[1].series == "mine");
  speeds.where[0].is = "nowhere";
  CHECK_THROWS_WITH(rows_of_table(speeds, folder / "sweep.csv"), Catch::Contains("no row has numbers in"));
  speeds.where.clear(), speeds.y = "v_xx";
  CHECK_THROWS_WITH(rows_of_table(speeds, folder / "sweep.csv"), Catch::Contains("v_x"));
}

TEST_CASE("a table's column over two others is a map: a series for each y, whose name ends with it") {
  const Folder folder;
  const auto file = folder / "sweep.csv";
  std::ofstream(file) << "incline.sin,grains.size_ratio,v_x,verdict\n0.1,2,0.5,steady\n0.2,2,0.7,steady\n"
                         "0.1,2.5,,stopped\n0.2,2.5,0.9,steady\n";
  TableColumns columns;
  columns.x = "incline.sin", columns.y = "grains.size_ratio", columns.z = "v_x";
  const auto table = rows_of_table(columns, file);
  REQUIRE(table.rows.size() == 3);  // where v_x is not known there is no row
  CHECK(table.rows[0].series == "v_x size_ratio=2");
  CHECK(table.rows[2].series == "v_x size_ratio=2.5");
  CHECK(table.rows[1].x == 0.2);
  CHECK(table.rows[1].y == 0.7);
  columns.where.emplace_back().column = "verdict";
  columns.where[0].is = "runaway";
  CHECK_THROWS_WITH(rows_of_table(columns, file), Catch::Contains("passes what `where` asks"));
}

}  // namespace sources_tests
