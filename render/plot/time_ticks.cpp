#include "plot/time_ticks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>

#include "plot/mathtext.hpp"

namespace chute::plot {
namespace {

using Days = std::chrono::sys_days;

constexpr std::int64_t minute = 60, hour = 60 * minute, day = 24 * hour;
constexpr std::size_t most_labels = 9;  // as on axes of numbers
constexpr double shortest = 4;          // seconds: fractions of one are numbers

enum class Unit { seconds, months };
/// From one tick to the next; `minor` parts of it get small ticks.
struct Step {
  Unit unit;
  std::int64_t count;
  int minor;
};
constexpr std::int64_t year = 12;  // months
constexpr Step steps[] = {{Unit::seconds, 1, 1},
                          {Unit::seconds, 2, 2},
                          {Unit::seconds, 5, 5},
                          {Unit::seconds, 10, 5},
                          {Unit::seconds, 30, 3},
                          {Unit::seconds, minute, 6},
                          {Unit::seconds, 2 * minute, 4},
                          {Unit::seconds, 5 * minute, 5},
                          {Unit::seconds, 10 * minute, 5},
                          {Unit::seconds, 30 * minute, 3},
                          {Unit::seconds, hour, 6},
                          {Unit::seconds, 2 * hour, 4},
                          {Unit::seconds, 3 * hour, 3},
                          {Unit::seconds, 6 * hour, 6},
                          {Unit::seconds, 12 * hour, 4},
                          {Unit::seconds, day, 4},
                          {Unit::seconds, 2 * day, 2},
                          {Unit::seconds, 7 * day, 7},
                          {Unit::seconds, 14 * day, 2},
                          {Unit::months, 1, 1},
                          {Unit::months, 2, 2},
                          {Unit::months, 3, 3},
                          {Unit::months, 6, 6},
                          {Unit::months, year, 4},
                          {Unit::months, 2 * year, 2},
                          {Unit::months, 5 * year, 5},
                          {Unit::months, 10 * year, 5},
                          {Unit::months, 20 * year, 4},
                          {Unit::months, 50 * year, 5},
                          {Unit::months, 100 * year, 5},
                          {Unit::months, 200 * year, 4},
                          {Unit::months, 500 * year, 5},
                          {Unit::months, 1000 * year, 5},
                          {Unit::months, 2000 * year, 4},
                          {Unit::months, 5000 * year, 5}};

struct Moment {
  int years;
  unsigned months, days;
  std::int64_t second;  ///< of the day
};

std::int64_t floor_divided(std::int64_t a, std::int64_t b) {
  return a / b - (a % b != 0 && (a < 0) != (b < 0));
}

Moment moment_of(std::int64_t seconds) {
  const auto days = floor_divided(seconds, day);
  const std::chrono::year_month_day date{Days{std::chrono::days{days}}};
  return {static_cast<int>(date.year()), static_cast<unsigned>(date.month()),
          static_cast<unsigned>(date.day()), seconds - days * day};
}

/// Of the first day of a month, counted from the begin of year 0.
double month_begin(std::int64_t month) {
  const auto years = floor_divided(month, year);
  const std::chrono::year_month_day first{std::chrono::year{static_cast<int>(years)},
                                          std::chrono::month{static_cast<unsigned>(month - years * year + 1)},
                                          std::chrono::day{1}};
  return static_cast<double>(Days{first}.time_since_epoch().count()) * static_cast<double>(day);
}

std::int64_t month_of(double seconds) {
  const auto m = moment_of(static_cast<std::int64_t>(std::floor(seconds)));
  return m.years * year + static_cast<std::int64_t>(m.months) - 1;
}

/// Places every `count` units within the axis, if they are not too many.
std::vector<double> places(const Span& span, Unit unit, std::int64_t count, std::size_t most) {
  std::vector<double> found;
  const auto take = [&](double at) {
    if (at >= span.low && at <= span.high) found.push_back(at);
  };
  if (unit == Unit::seconds) {
    // weeks begin on Mondays; the first of January 1970 was a Thursday
    const std::int64_t shift = count % (7 * day) == 0 ? -3 * day : 0;
    const double every = static_cast<double>(count);
    if ((span.high - span.low) / every > static_cast<double>(most)) return {};
    for (auto n = static_cast<std::int64_t>(std::ceil((span.low - static_cast<double>(shift)) / every));;
         ++n) {
      const double at = static_cast<double>(n * count + shift);
      if (at > span.high) break;
      take(at);
    }
  } else {
    const auto first = month_of(span.low), last = month_of(span.high);
    if ((last - first) / count > static_cast<std::int64_t>(most)) return {};
    for (auto month = floor_divided(first, count) * count; month <= last; month += count)
      take(month_begin(month));
  }
  return found;
}

/// Labels that leave out what all of them share, which stands in `factor`.
void label(Ticks& ticks, const Step& step) {
  std::vector<Moment> moments;
  for (const auto& tick : ticks.major) moments.push_back(moment_of(static_cast<std::int64_t>(tick.value)));
  const auto all = [&](auto&& same) {
    return std::all_of(moments.begin(), moments.end(),
                       [&](const Moment& m) { return same(m, moments.front()); });
  };
  const bool one_year = all([](const Moment& a, const Moment& b) { return a.years == b.years; });
  const bool one_day = one_year && all([](const Moment& a, const Moment& b) {
                         return a.months == b.months && a.days == b.days;
                       });
  const bool has_days = step.unit == Unit::seconds, has_clock = has_days && step.count % day != 0;
  const bool has_months = has_days || step.count % year != 0;
  const bool has_seconds = has_clock && step.count % minute != 0;
  for (std::size_t i = 0; i < moments.size(); ++i) {
    const auto& m = moments[i];
    std::string text;
    if (!has_months || !one_year) text = fmt::format("{:04}", m.years);
    if (has_months && !(has_clock && one_day))
      text += fmt::format("{}{:02}", text.empty() ? "" : "-", m.months);
    if (has_days && !(has_clock && one_day)) text += fmt::format("-{:02}", m.days);
    if (has_clock)
      text +=
          fmt::format("{}{:02}:{:02}", text.empty() ? "" : " ", m.second / hour, m.second / minute % minute);
    if (has_seconds) text += fmt::format(":{:02}", m.second % minute);
    ticks.major[i].label = text;
  }
  if (moments.empty() || !has_months || !one_year) return;
  const auto& m = moments.front();
  ticks.factor = has_clock && one_day ? fmt::format("{:04}-{:02}-{:02}", m.years, m.months, m.days)
                                      : fmt::format("{:04}", m.years);
}

bool fits(const Ticks& ticks, const Span& span, double length, double size, bool horizontal) {
  const double gap = horizontal ? 1.1 * size : 0.6 * size;
  double edge = -1e300;
  for (const auto& tick : ticks.major) {
    const auto text = set_text(tick.label, size);
    const double half = (horizontal ? text.width : text.ascent + text.descent) / 2,
                 at = span.fraction(tick.value) * length;
    if (at - half < edge + gap) return false;
    edge = at + half;
  }
  return true;
}

}  // namespace

Calendar calendar() { return {month_begin(year), month_begin(10'000 * year) - 1}; }

std::optional<Ticks> time_ticks(const Span& span, double length, double size, bool horizontal) {
  const auto [first, last] = calendar();
  if (!(span.low >= first && span.high <= last && span.high - span.low >= shortest)) return {};
  std::optional<Ticks> few;
  for (const Step& step : steps) {
    Ticks ticks;
    for (const double at : places(span, step.unit, step.count, most_labels)) ticks.major.push_back({at, {}});
    if (ticks.major.empty() || ticks.major.size() > most_labels) continue;
    label(ticks, step);
    if (!fits(ticks, span, length, size, horizontal)) continue;
    const auto small = step.unit == Unit::months && step.count == 1
                           ? std::vector<double>()
                           : places(span, step.unit, step.count / step.minor, 200);
    if (static_cast<double>(small.size()) <= length / 3)
      for (const double at : small)
        if (std::none_of(ticks.major.begin(), ticks.major.end(),
                         [&](const Tick& t) { return t.value == at; }))
          ticks.minor.push_back(at);
    if (ticks.major.size() >= 2) return ticks;
    if (!few) few = std::move(ticks);
  }
  return few;
}

}  // namespace chute::plot
