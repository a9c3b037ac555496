#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <random>

#include "common/error.hpp"
#include "plot/mathtext.hpp"
#include "plot/recipe.hpp"
#include "plot/scale.hpp"
#include "read/iso_time.hpp"

using namespace chute;
using Catch::Matchers::Contains;

namespace {

plot::Ticks ticks(const char* from, const char* to, double length = 240) {
  plot::Axis axis;
  axis.times = true;
  return plot::ticks_for(axis, {*read::iso_time(from), *read::iso_time(to), plot::Scale::linear}, length, 8,
                         true);
}

std::vector<std::string> labels(const plot::Ticks& t) {
  std::vector<std::string> texts;
  for (const auto& tick : t.major) texts.push_back(tick.label);
  return texts;
}

}  // namespace

TEST_CASE("Axes of dates have ticks where calendars and clocks have them") {
  using Texts = std::vector<std::string>;
  CHECK(labels(ticks("1990-01-01", "2031-01-01")) ==
        Texts{"1990", "1995", "2000", "2005", "2010", "2015", "2020", "2025", "2030"});
  const auto quarters = ticks("2026-01-01", "2026-12-31");
  CHECK(labels(quarters) == Texts{"01", "03", "05", "07", "09", "11"});
  CHECK(quarters.factor == "2026");
  CHECK(labels(ticks("1990-01-01", "2031-01-01", 120)) == Texts{"1990", "2000", "2010", "2020", "2030"});
  CHECK(labels(ticks("2025-10-20", "2026-04-20")) ==
        Texts{"2025-11", "2025-12", "2026-01", "2026-02", "2026-03", "2026-04"});
  CHECK(labels(ticks("2026-02-26", "2026-03-03T12:00")) ==
        Texts{"02-26", "02-27", "02-28", "03-01", "03-02", "03-03"});
  const auto hours = ticks("2026-03-07T05:30", "2026-03-07T18:00");
  CHECK(labels(hours) == Texts{"06:00", "08:00", "10:00", "12:00", "14:00", "16:00", "18:00"});
  CHECK(hours.factor == "2026-03-07");
  CHECK(labels(ticks("2026-03-07T23:59:50", "2026-03-08T00:00:20")).front() == "03-07 23:59:50");
  CHECK_THAT(ticks("2026-03-07T14:05:09", "2026-03-07T14:05:10").factor, Contains("+"));  // numbers
}

TEST_CASE("Ticks of any two dates fit, are few, and stand where their labels say") {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> when(-6e10, 2.4e11), size(std::log(4.0), std::log(2e11));
  for (int trial = 0; trial < 3000; ++trial) {
    const double low = when(random), high = low + std::exp(size(random));
    if (high > 2.5e11) continue;
    plot::Axis axis;
    axis.times = true;
    const double length = 60 + 40 * (trial % 9);
    const auto t = plot::ticks_for(axis, {low, high, plot::Scale::linear}, length, 8, true);
    CAPTURE(low, high, length);
    REQUIRE(t.major.size() <= 9);
    REQUIRE((t.major.size() >= 1 || length < 100));
    REQUIRE(t.minor.size() <= length / 3 + 9);
    double edge = -1e300;
    for (const auto& tick : t.major) {
      REQUIRE((tick.value >= low - 1e-6 * (high - low) && tick.value <= high + 1e-6 * (high - low)));
      const double half = plot::set_text(tick.label, 8).width / 2,
                   at = (tick.value - low) / (high - low) * length;
      REQUIRE(at - half > edge);
      edge = at + half;
      // a label with all its parts is the tick's time
      if (const auto time = read::iso_time(tick.label)) REQUIRE(*time == tick.value);
      if (const auto time = read::iso_time(t.factor + "T" + tick.label)) REQUIRE(*time == tick.value);
    }
  }
}

TEST_CASE("Times as text read back the same") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> when(-6e10, 2.5e11);
  for (int trial = 0; trial < 2000; ++trial) {
    const double whole = std::floor(when(random)), time = trial % 2 ? whole : whole + 0.25;
    REQUIRE(read::iso_time(read::iso_text(time)) == time);
  }
  CHECK(read::iso_text(0) == "1970-01-01");
  CHECK(read::iso_text(86399.5) == "1970-01-01T23:59:59.5");
  CHECK(read::iso_text(std::nan("")).empty());
}

TEST_CASE("A table's dates make an axis of dates") {
  const auto table = read::parse_table(
      "panel,series,x,y\n,a,2026-03-01,1\n,a,2026-03-05T12:00,2\n,a,2026-03-09,3\n", "t.csv");
  plot::PlotRecipe recipe;
  auto figure = plot::figure_from(recipe, table);
  CHECK(figure.panels[0].x.times);
  CHECK_FALSE(figure.panels[0].y.times);
  CHECK(figure.panels[0].series[0].x[1] == *read::iso_time("2026-03-05T12:00"));
  recipe.x.scale = plot::AxisRecipe::Scale::log;
  CHECK_THROWS_WITH(plot::figure_from(recipe, table), Contains("no logarithmic axis"));
  // one date alone gets a day around it
  plot::Axis axis;
  axis.times = true;
  plot::Extent extent;
  extent.include(*read::iso_time("2026-03-07"), plot::Scale::linear);
  const auto span = plot::span_of(axis, extent);
  CHECK(span.high - span.low == 86400);
}
