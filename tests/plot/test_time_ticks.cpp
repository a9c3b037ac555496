#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <random>

#include "common/error.hpp"
#include "plot/mathtext.hpp"
#include "plot/recipe.hpp"
#include "plot/scale.hpp"
#include "plot/time_ticks.hpp"
#include "read/iso_time.hpp"

namespace time_ticks_tests {
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
}

TEST_CASE("Axes shorter than seconds have fractions of them, and tell the minute once") {
  using Texts = std::vector<std::string>;
  const auto second = ticks("2026-03-07T14:05:09", "2026-03-07T14:05:10");
  CHECK(labels(second) == Texts{":09.0", ":09.2", ":09.4", ":09.6", ":09.8", ":10.0"});
  CHECK(second.factor == "2026-03-07 14:05");
  CHECK(labels(ticks("2026-03-07T14:05:59.5", "2026-03-07T14:06:00.5")) ==
        Texts{"14:05:59.6", "14:05:59.8", "14:06:00.0", "14:06:00.2", "14:06:00.4"});
  const auto years = ticks("1969-12-31T23:59:59.999", "1970-01-01T00:00:00.001", 160);
  CHECK(labels(years) == Texts{":59.9990", ":59.9995", ":00.0000", ":00.0005", ":00.0010"});
  CHECK(years.factor == "from 1969-12-31 23:59");
  CHECK(labels(ticks("2026-03-07T14:05:09.123400", "2026-03-07T14:05:09.123410", 300)) ==
        Texts{":09.123400", ":09.123402", ":09.123404", ":09.123406", ":09.123408", ":09.123410"});
  // doubles of our days are a quarter of a microsecond apart: less than that is told as what it is
  const auto plain = ticks("2026-03-07T14:05:09.1234000", "2026-03-07T14:05:09.1234014");
  CHECK_THAT(plain.factor, Contains("+1772892309") && Contains("s since 1970"));
  // those close to 1970 tell more
  CHECK(labels(ticks("1970-01-01T00:00:00", "1970-01-01T00:00:00.0000004")).front() == ":00.0000000");
}

TEST_CASE("Ticks of short axes of dates stand where their labels say, down to what doubles tell") {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> when(-6e10, 2.4e11), small(-1e5, 1e5),
      size(std::log(1e-7), std::log(4.0));
  int plain = 0, fine = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const double low = trial % 3 == 0 ? small(random) : when(random), high = low + std::exp(size(random));
    if (!(high > low)) continue;
    plot::Axis axis;
    axis.times = true;
    const double length = 100 + 40 * (trial % 9);
    const auto t = plot::ticks_for(axis, {low, high, plot::Scale::linear}, length, 8, true);
    CAPTURE(low, high, length, t.factor);
    REQUIRE(t.major.size() >= 1);
    REQUIRE(t.major.size() <= 9);
    const double ulp = std::nextafter(std::max(std::abs(low), std::abs(high)), INFINITY) -
                       std::max(std::abs(low), std::abs(high));
    // a text is read as a day and the seconds in it, whose sum is rounded, too
    const double rounding = std::max(2 * ulp, std::nextafter(86400.0, INFINITY) - 86400.0);
    if (t.factor.find("s since 1970") != std::string::npos) {
      ++plain;
      // two of the power of ten that is next to four of them; or labels of so many digits find no room
      REQUIRE((high - low < 80 * ulp || (high - low < 1e-5 && length < 200)));
      continue;
    }
    ++fine;
    for (const auto& tick : t.major) {
      REQUIRE((tick.value >= low && tick.value <= high));
      if (t.factor.starts_with("from ")) {
        const auto minute = read::iso_time(t.factor.substr(5));
        REQUIRE(minute);
        const double at = *minute + std::stod(tick.label.substr(1)), off = std::abs(at - tick.value);
        REQUIRE((off <= rounding || std::abs(off - 60) <= rounding));
        continue;
      }
      const auto behind = tick.label.starts_with(':') ? "" : t.factor.size() == 4 ? "-" : "T";
      const auto time = read::iso_time(t.factor.empty() ? tick.label : t.factor + behind + tick.label);
      CAPTURE(tick.label);
      REQUIRE(time);
      REQUIRE(std::abs(*time - tick.value) <= rounding);
    }
    for (const double at : t.minor) REQUIRE((at >= low && at <= high));
  }
  CHECK(plain > 100);
  CHECK(fine > 2000);
}

TEST_CASE("Dates within a second fill their axis") {
  plot::Axis axis;
  axis.times = true;
  const double begin = *read::iso_time("2026-03-07T14:05:09");
  for (const double length : {0.5, 1e-3, 1e-5}) {
    plot::Extent extent;
    extent.include(begin, plot::Scale::linear), extent.include(begin + length, plot::Scale::linear);
    const auto span = plot::span_of(axis, extent);
    CHECK(span.low <= begin);
    CHECK(span.high - span.low < 1.2 * length);
  }
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

TEST_CASE("Instants of all years come back from their texts, in whatever zone they are told") {
  std::mt19937 random(3);
  const auto [first, last] = plot::calendar();
  std::uniform_real_distribution<double> when(first, last);
  std::uniform_int_distribution<int> zone(-23 * 60 - 59, 23 * 60 + 59);
  for (int trial = 0; trial < 20'000; ++trial) {
    const double t = std::floor(when(random)) + (trial % 4) * 0.25;
    const auto text = read::iso_text(t);
    INFO(text);
    REQUIRE(read::iso_time(text));
    CHECK(*read::iso_time(text) == t);
    const int minutes = zone(random);  // the same instant as a clock shows it there
    const auto local = read::iso_text(t + 60.0 * minutes);
    if (local.find('T') == std::string::npos || t + 60.0 * minutes > last || t + 60.0 * minutes < first)
      continue;
    const auto told = fmt::format("{}{}{:02}:{:02}", local, minutes < 0 ? '-' : '+', std::abs(minutes) / 60,
                                  std::abs(minutes) % 60);
    INFO(told);
    REQUIRE(read::iso_time(told));
    CHECK(*read::iso_time(told) == t);
  }
}

TEST_CASE("Leap seconds are there at the end of a day of universal time, and nowhere else") {
  CHECK(read::iso_time("2016-12-31T23:59:60Z") == read::iso_time("2017-01-01"));
  CHECK(*read::iso_time("2016-12-31T23:59:60.5") == *read::iso_time("2017-01-01") + 0.5);
  CHECK(read::iso_time("2017-01-01T00:59:60+01:00") == read::iso_time("2017-01-01"));
  CHECK(read::iso_time("2016-12-31T18:59:60-0500") == read::iso_time("2017-01-01"));
  for (const char* none :
       {"2016-12-31T12:30:60Z", "2016-12-31T23:59:60+01:00", "2016-12-31T23:59:61Z", "2016-12-31T24:00:01",
        "2016-12-31T24:30", "2016-12-31T12:00+24:00", "2016-02-30", "2015-02-29"})
    CHECK_FALSE(read::iso_time(none));
  CHECK(read::iso_time("2016-12-31T24:00") == read::iso_time("2017-01-01"));
}

TEST_CASE("What no four digits tell has no text") {
  CHECK(read::iso_text(*read::iso_time("0001-01-01") - 367 * 86400.0).empty());
  CHECK(read::iso_text(*read::iso_time("9999-12-31T23:59:59.9999999")).empty());
  for (const double t : {1e300, -1e300, double(INFINITY), double(-INFINITY), double(NAN)})
    CHECK(read::iso_text(t).empty());
}

TEST_CASE("Axes of dates go from the year 1 to 9999 and say so; the room beside dates ends there") {
  plot::Axis axis;
  axis.times = true;
  axis.label = "day";
  const auto of = [&](double low, double high) {
    plot::Extent extent;
    extent.include(low, plot::Scale::linear, plot::Extent::Mark::marker);
    extent.include(high, plot::Scale::linear, plot::Extent::Mark::marker);
    return plot::span_of(axis, extent);
  };
  const double first = *read::iso_time("0001-01-01"), last = *read::iso_time("9999-12-31T23:59:59");
  for (const auto& [low, high] :
       {std::pair{first, last}, {first, first}, {last, last}, {first, 0.0}, {0.0, last}}) {
    const auto span = of(low, high);
    const auto ticks = plot::ticks_for(axis, span, 300, 8, true);
    CAPTURE(low, high, ticks.factor);
    CHECK(span.low >= first);
    CHECK(span.high <= last);
    CHECK(ticks.major.size() >= 1);
    CHECK_THAT(ticks.factor, !Contains("times"));  // dates, no powers of ten
  }
  CHECK_THROWS_WITH(of(first - 1, 0), Contains("axis \"day\"") && Contains("year 1 to the year 9999"));
  CHECK_THROWS_WITH(of(0, last + 1), Contains("year 1 to the year 9999"));
  for (const double limit : {1e12, -1e12, 1e300}) {
    axis.max = std::abs(limit), axis.min = -std::abs(limit);
    CHECK_THROWS_WITH(of(0, 1), Contains("the limit") && Contains("dates: from, to"));
  }
}

TEST_CASE("Any axis of dates is laid out or refused, and never overflows") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> exponent(-3, 12), sign(-1, 1);
  int refused = 0;
  for (int trial = 0; trial < 5000; ++trial) {
    plot::Axis axis;
    axis.times = true;
    const auto any = [&] { return std::copysign(std::pow(10, exponent(random)), sign(random)); };
    plot::Extent extent;
    for (int k = 0; k < 2; ++k) extent.include(any(), plot::Scale::linear);
    if (trial % 3 == 0) axis.min = any();
    if (trial % 5 == 0) axis.max = any();
    try {
      const auto span = plot::span_of(axis, extent);
      const auto ticks = plot::ticks_for(axis, span, 200, 8, true);
      CHECK(span.low < span.high);
      CHECK(ticks.major.size() <= 9);
    } catch (const InputError&) {
      ++refused;
    }
  }
  CHECK(refused > 50);
  CHECK(refused < 2500);
}

TEST_CASE("A recipe's limits of an axis of dates are dates") {
  const auto figure = [](const std::string& keys) {
    const auto text = parse_toml("[plot]\nx = { " + keys + " }\n", "f.toml");
    TomlReader reader(text, "f.toml");
    plot::PlotRecipe recipe;
    reader.section("plot", recipe);
    reader.finish();
    return plot::figure_from(
        recipe, read::parse_table("panel,series,x,y\n,a,2026-03-07,1\n,a,2026-03-09T12:00+02:00,2\n"
                                  ",a,1969-12-31T23:00Z,3\n",
                                  "f.csv"));
  };
  const auto made = figure("from = \"2026-03-01\", to = \"2026-04-01T00:00+02:00\"");
  CHECK(made.panels[0].x.min == read::iso_time("2026-03-01"));
  CHECK(made.panels[0].x.max == read::iso_time("2026-03-31T22:00"));
  CHECK(made.panels[0].series[0].x[1] == *read::iso_time("2026-03-09T10:00"));
  CHECK(made.panels[0].series[0].x[2] == -3600);
  CHECK_THROWS_WITH(figure("from = \"2026-02-30\""),
                    Contains("f.toml:2: plot.x.from: \"2026-02-30\" is no date"));
  CHECK_THROWS_WITH(figure("from = \"2026-02-03\", to = \"2026-02-03\""), Contains("must be before to"));
  CHECK_THROWS_WITH(figure("from = \"2026-02-03\", min = 3"), Contains("give from or min"));
}

}  // namespace time_ticks_tests
