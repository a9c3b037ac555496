// Laws put through points: constants that are known come back, with errors that fit their scatter.
#include <catch2/catch.hpp>

#include "core/random.hpp"
#include "figures/extract_hard.hpp"
#include "figures/fits.hpp"

namespace fits_tests {
using namespace chute;
using namespace chute::figures;

namespace {

/// Points of y = 0.3 x^1.4 F^-0.8, off by a gaussian scatter in ln y.
std::vector<FitPoint> scattered(double scatter, std::uint64_t seed) {
  std::vector<FitPoint> points;
  Random random(seed, Purpose::engine);
  for (const double factor : {3.0, 4.0, 5.0, 8.0})
    for (int k = 1; k <= 10; ++k) {
      const double x = 0.01 * k;
      points.push_back(
          {x, 0.3 * std::pow(x, 1.4) * std::pow(factor, -0.8) * std::exp(scatter * random.normal()), factor});
    }
  return points;
}

}  // namespace

TEST_CASE("a power law of two variables comes back as it was, and with scatter within its errors") {
  Fit fit;
  fit.factors = {3, 4, 5, 8};
  const auto exact = fit_law(fit, scattered(0, 1));
  REQUIRE(exact);
  CHECK(exact->c.value == Approx(0.3));
  CHECK(exact->k.value == Approx(1.4));
  CHECK(exact->n.value == Approx(-0.8));
  CHECK(exact->misfit < 1e-12);
  // Errors are right if their squares are those of the deviations, on average over many trials.
  double k_square = 0, n_square = 0;
  constexpr int trials = 200;
  for (std::uint64_t seed = 1; seed <= trials; ++seed) {
    const auto found = fit_law(fit, scattered(0.1, seed));
    REQUIRE(found);
    k_square += std::pow((found->k.value - 1.4) / found->k.error, 2) / trials;
    n_square += std::pow((found->n.value + 0.8) / found->n.error, 2) / trials;
  }
  CHECK(k_square == Approx(1.05).margin(0.35));
  CHECK(n_square == Approx(1.05).margin(0.35));
}

TEST_CASE("too few points have no law, and one series of a figure gets a line and a comment") {
  Fit fit;
  fit.form = Fit::Form::exponential;
  fit.series = "law", fit.of = {"a", "b"};
  CHECK_FALSE(fit_law(fit, {{1, 2, 1}, {2, 3, 1}}));
  FigureTable table;
  for (const double x : {0.0, 1.0, 2.0})
    table.rows.push_back({"", x == 1 ? "b" : "a", x, 5 * std::exp(-2 * x)});
  table.rows.push_back({"", "a", 3, 0});  // no logarithm: left out
  table.rows.push_back({"", "c", 1, 7});  // another series
  draw_fit(fit, table);
  REQUIRE(table.comments.size() == 1);
  CHECK_THAT(table.comments[0], Catch::Contains("5 exp((-2 +- ") && Catch::Contains("3 points"));
  const auto& last = table.rows.back();
  CHECK(last.series == "law");
  CHECK(last.x == 2);
  CHECK(last.y == Approx(5 * std::exp(-4)));
}

TEST_CASE("Janssen's law comes back from stresses that follow it, saturated or hardly bent") {
  for (const double length : {4.0, 20.0, 60.0}) {
    CAPTURE(length);
    std::vector<FigureRow> rows;
    for (double z = 1; z <= 30; ++z) rows.push_back({"", "", z, -38 * std::expm1(-z / length)});
    const auto fit = fit_janssen(rows);
    CHECK(fit.length == Approx(length).epsilon(1e-5));
    CHECK(fit.stress == Approx(38).epsilon(1e-5));
    CHECK(fit.largest == 30);
  }
}

}  // namespace fits_tests
