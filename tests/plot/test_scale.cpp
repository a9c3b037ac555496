#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "plot/scale.hpp"

namespace scale_tests {
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
    for (double v : markers) e.include(v, Scale::linear, Extent::Mark::marker);
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

TEST_CASE("any two doubles make an axis: its ticks lie on it, rise, and are as few as a reader wants") {
  std::mt19937_64 bits(1);
  const auto any = [&] {
    for (;;)
      if (const auto x = std::bit_cast<double>(bits()); std::isfinite(x)) return x;
  };
  const auto next = [](double x, int ulps) {
    for (int i = 0; i < ulps; ++i) x = std::nextafter(x, std::numeric_limits<double>::infinity());
    return x;
  };
  int axes = 0;
  for (int i = 0; i < 100'000; ++i) {
    const auto kind = bits() % 4;
    double a = any(), b = kind == 0   ? next(a, static_cast<int>(bits() % 50 + 1))
                          : kind == 1 ? a * 1.0001
                                      : any();
    const bool log = bits() % 2 == 0;
    if (log) a = std::max(std::abs(a), 5e-324), b = std::abs(b);
    if (a > b) std::swap(a, b);
    if (!(a < b) || !std::isfinite(b)) continue;
    ++axes;
    const Span span{a, b, log ? Scale::log : Scale::linear};
    const auto ticks = ticks_for(span, 190, 9, i % 3 != 0);
    const double slack = std::isfinite(b - a) ? 1e-6 * (b - a) : 0;
    if (ticks.major.size() > 60 || ticks.minor.size() > 700) FAIL(a << " to " << b << ": too many ticks");
    for (std::size_t k = 0; k < ticks.major.size(); ++k) {
      const double at = ticks.major[k].value;
      const bool inside =
          log ? at >= a * (1 - 1e-6) && at <= b * (1 + 1e-6) : at >= a - slack && at <= b + slack;
      const bool rises = k == 0 || at > ticks.major[k - 1].value;
      if (!inside || !rises || ticks.major[k].label.empty() || !std::isfinite(at))
        FAIL(a << " to " << b << ": a tick at " << at);
    }
  }
  CHECK(axes > 90'000);
}

TEST_CASE("axes at both ends of what doubles hold have finite ticks, and numbers as labels") {
  constexpr double most = std::numeric_limits<double>::max(),
                   least = std::numeric_limits<double>::denorm_min();
  std::mt19937_64 bits(3);
  std::uniform_real_distribution<double> part(0, 1);
  for (int i = 0; i < 20'000; ++i) {
    const bool large = i % 2 == 0, log = i % 3 == 0;
    double a = large ? most * part(bits) : least * std::floor(1 + 1e6 * part(bits) * part(bits));
    double b = i % 5 == 0           ? (large ? most : least)
               : i % 7 == 0 && !log ? -a
               : large              ? most * part(bits)
                                    : a * (1 + part(bits));
    if (a > b) std::swap(a, b);
    if (!(a < b)) continue;
    const Span span{a, b, log ? Scale::log : Scale::linear};
    const auto ticks = ticks_for(span, 190, 9, true);
    for (const auto& tick : ticks.major) {
      const double at = span.fraction(tick.value);
      const auto& text = tick.label;
      if (!(at > -1e-6 && at < 1 + 1e-6) || text.find("nan") != text.npos || text.find("inf") != text.npos)
        FAIL(a << " to " << b << ": " << text << " at " << at);
    }
    for (const double share : {0.0, 0.3, 1.0}) {
      const double value = span.at(share);
      // close to 0 doubles are a whole step apart
      if (std::abs(span.fraction(value) - share) > (large ? 1e-9 : 0.51))
        FAIL(a << " to " << b << " at " << share);
    }
  }
}

TEST_CASE("the data of an axis may be any doubles: its range holds them and can be mapped") {
  std::mt19937_64 bits(2);
  for (int i = 0; i < 100'000; ++i) {
    double value[2];
    for (double& v : value) {
      do v = std::bit_cast<double>(bits());
      while (!std::isfinite(v));
    }
    if (i % 5 == 0) value[1] = value[0];
    Axis axis;
    axis.scale = i % 2 ? Scale::log : Scale::linear;
    Extent extent;
    for (const double v : value) extent.include(v, axis.scale, Extent::Mark::marker);
    const auto span = span_of(axis, extent);
    if (!(span.low < span.high) || !std::isfinite(span.low) || !std::isfinite(span.high))
      FAIL(value[0] << ", " << value[1] << ": from " << span.low << " to " << span.high);
    for (const double v : value) {
      if (axis.scale == Scale::log && v <= 0) continue;
      const double part = span.fraction(v);
      if (!(part > -1e-6 && part < 1 + 1e-6)) FAIL(v << " lies at " << part);
    }
  }
}

TEST_CASE("an end that is named beyond all data leaves an axis that begins or ends there") {
  std::mt19937_64 bits(3);
  for (int i = 0; i < 20'000; ++i) {
    double end, value;
    for (double* v : {&end, &value}) {
      do *v = std::bit_cast<double>(bits());
      while (!std::isfinite(*v));
    }
    Axis axis;
    axis.scale = i % 2 ? Scale::log : Scale::linear;
    if (axis.scale == Scale::log) end = std::abs(end), value = std::abs(value);
    if (end == 0 || value == 0) continue;
    (i % 3 ? axis.min : axis.max) = end;
    Extent extent;
    extent.include(value, axis.scale, i % 5 ? Extent::Mark::marker : Extent::Mark::none);
    const auto span = span_of(axis, extent);
    if (!(span.low < span.high) || !std::isfinite(span.low) || !std::isfinite(span.high))
      FAIL(end << ", " << value << ": from " << span.low << " to " << span.high);
    REQUIRE_NOTHROW(ticks_for(span, 190, 9, true));
  }
  Axis axis;
  axis.min = 5;
  Extent extent;
  extent.include(4, Scale::linear);
  REQUIRE(span_of(axis, extent).low == 5);
  REQUIRE(span_of(axis, extent).high > 5);
}

TEST_CASE("what differs in late digits only stands for its distance from a round number") {
  const auto ticks = ticks_for({1.7e9, 1.7e9 + 20}, 190, 9, true);
  REQUIRE(ticks.factor == "$+1700000000$");
  REQUIRE(ticks.major.front().label == "$0$");
}

}  // namespace scale_tests
