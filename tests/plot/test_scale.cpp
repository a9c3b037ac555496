#include <catch2/catch.hpp>
#include <cmath>

#include "plot/scale.hpp"

using namespace chute::plot;

namespace {

std::vector<std::string> labels(const Span& span, double length, bool horizontal = true) {
  std::vector<std::string> out;
  for (const auto& t : ticks_for(span, length, 9, horizontal).major) out.push_back(t.label);
  return out;
}
using Strings = std::vector<std::string>;

}  // namespace

TEST_CASE("linear ticks are round numbers with equal decimals") {
  REQUIRE(labels({0, 1}, 190) == Strings{"$0.0$", "$0.2$", "$0.4$", "$0.6$", "$0.8$", "$1.0$"});
  REQUIRE(labels({-0.45, 0.52}, 120) == Strings{"$-0.4$", "$-0.2$", "$0.0$", "$0.2$", "$0.4$"});
  REQUIRE(labels({0, 16}, 190) == Strings{"$0$", "$2$", "$4$", "$6$", "$8$", "$10$", "$12$", "$14$", "$16$"});
  REQUIRE(labels({0, 30}, 60) == Strings{"$0$", "$10$", "$20$", "$30$"});
}

TEST_CASE("large and tiny numbers stand over one factor") {
  const auto large = ticks_for({0, 7e6}, 190, 9, true), tiny = ticks_for({0, 4e-5}, 190, 9, true);
  REQUIRE(large.factor == "$\\times10^{6}$");
  REQUIRE(large.major[1].label == "$1$");
  REQUIRE(tiny.factor == "$\\times10^{-5}$");
  REQUIRE(ticks_for({0, 2000}, 190, 9, true).factor.empty());
}

TEST_CASE("log axes have decades, minor ticks between, and every nth decade where they crowd") {
  const auto ticks = ticks_for({1e-3, 1e2, Scale::log}, 200, 9, true);
  REQUIRE(ticks.major.size() == 6);
  REQUIRE(ticks.major[0].label == "$10^{-3}$");
  REQUIRE(ticks.minor.size() == 5 * 8);
  const auto many = ticks_for({1e-12, 1e12, Scale::log}, 100, 9, true);
  REQUIRE(many.major.size() >= 3);
  REQUIRE(many.major.size() <= 6);
  for (const auto& t : many.major) REQUIRE(std::log10(t.value) == Approx(std::round(std::log10(t.value))));
}

TEST_CASE("short log axes show numbers instead") {
  REQUIRE(labels({1, 10, Scale::log}, 190) == Strings{"$1$", "$2$", "$5$", "$10$"});
  REQUIRE(labels({0.4, 6, Scale::log}, 190) == Strings{"$0.5$", "$1.0$", "$2.0$", "$5.0$"});
  const auto narrow = labels({2.1, 2.9, Scale::log}, 190);
  REQUIRE(narrow.size() >= 3);
}

TEST_CASE("positions follow the scale") {
  const Span lin{2, 4}, log{1, 100, Scale::log};
  REQUIRE(lin.fraction(3) == Approx(0.5));
  REQUIRE(log.fraction(10) == Approx(0.5));
  REQUIRE(std::isnan(log.fraction(0)));
  REQUIRE(std::isnan(log.fraction(-1)));
}

TEST_CASE("ranges leave room for markers, start at zero when near it, and stand what is degenerate") {
  const auto extent = [](std::initializer_list<double> lines, std::initializer_list<double> markers, bool y) {
    Extent e;
    e.keep_off = y;
    for (double v : lines) e.include(v, Scale::linear);
    for (double v : markers) e.include(v, Scale::linear, true);
    return e;
  };
  const auto near_zero = span_of({}, extent({}, {0.02, 1}, false));
  REQUIRE((near_zero.low < 0 && near_zero.high > 1 && near_zero.high < 1.1));
  REQUIRE(span_of({}, extent({}, {0.1, 1}, false)).low == 0);
  const auto line = span_of({}, extent({3, 8}, {5}, false));  // a line may end at the frame
  REQUIRE((line.low == 3 && line.high == 8));
  const auto upright = span_of({}, extent({3, 8}, {}, true));  // but not run along it
  REQUIRE((upright.low < 3 && upright.high > 8));
  REQUIRE(span_of({}, extent({0, 8}, {}, true)).low == 0);
  auto e = extent({2, 3}, {}, true);
  e.from_zero = true;
  REQUIRE(span_of({}, e).low == 0);
  Axis fixed;
  fixed.min = 1, fixed.max = 5;
  REQUIRE((span_of(fixed, e).low == 1 && span_of(fixed, e).high == 5));
  for (double v : {0.0, 1.0, -1e20, 1e-300}) {
    const auto one = span_of({}, extent({v}, {v}, true));
    REQUIRE((one.low < one.high && std::isfinite(one.low) && std::isfinite(one.high)));
  }
  const auto empty = span_of({}, {});
  REQUIRE(empty.low < empty.high);
  const auto log = span_of({"", Scale::log, {}, {}, {}}, {});
  REQUIRE((log.low > 0 && log.low < log.high));
}
