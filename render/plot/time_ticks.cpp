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
/// Of a second, and what clocks write; finer ones only instants close to 1970 could have.
constexpr int finest_digits = 12;
/// Parts of a second that are told are at least so many steps of the double apart that holds the time: 1 µs in our days.
constexpr double least_steps = 4;

enum class Unit { seconds, months };
/// From one tick to the next, `count` of the last of `digits` decimals; `minor` parts of it get small ticks.
struct Step {
  Unit unit;
  std::int64_t count;
  int minor;
  int digits = 0;
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

constexpr std::int64_t tens(int n) { return n == 0 ? 1 : 10 * tens(n - 1); }

/// How many decimals of a second doubles between these can tell; nothing if they have fewer than two such places between them.
std::optional<int> told_digits(const Span& span) {
  const double largest = std::max(std::abs(span.low), std::abs(span.high));
  const double step = least_steps * (std::nextafter(largest, INFINITY) - largest);
  if (step > 1) return {};
  int digits = 0;
  while (digits < finest_digits && 1 / static_cast<double>(tens(digits + 1)) >= step) ++digits;
  if (span.high - span.low < 2 / static_cast<double>(tens(digits))) return {};
  return digits;
}

/// Finest first, those of parts of a second where their places can be told.
std::vector<Step> steps_from(int digits) {
  std::vector<Step> all;
  for (int n = digits; n > 0; --n)
    for (const std::int64_t count : {1, 2, 5}) all.push_back({Unit::seconds, count, count == 2 ? 4 : 5, n});
  all.insert(all.end(), std::begin(steps), std::end(steps));
  return all;
}

struct Moment {
  int years;
  unsigned months, days;
  std::int64_t second;  ///< of the day
  std::int64_t part = 0;
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

/// The same of an instant that is told with so many decimals.
Moment moment_of(double seconds, int digits) {
  if (digits == 0) return moment_of(static_cast<std::int64_t>(seconds));
  const auto whole = tens(digits);
  const auto parts = std::llround(seconds * static_cast<double>(whole));
  auto moment = moment_of(floor_divided(parts, whole));
  moment.part = parts - floor_divided(parts, whole) * whole;
  return moment;
}

/// Places every `count` of the last of these decimals within the axis, if they are not too many.
std::vector<double> parts_of_seconds(const Span& span, const Step& step, std::size_t most) {
  const auto whole = tens(step.digits);
  const double scale = static_cast<double>(whole), every = static_cast<double>(step.count) / scale;
  std::vector<double> found;
  if ((span.high - span.low) / every > static_cast<double>(most)) return found;
  for (auto n = static_cast<std::int64_t>(std::floor(span.low / every)) - 1;; ++n) {
    const auto parts = n * step.count, seconds = floor_divided(parts, whole);
    const double at = static_cast<double>(seconds) + static_cast<double>(parts - seconds * whole) / scale;
    if (at > span.high) return found;
    if (at >= span.low) found.push_back(at);
  }
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

std::vector<double> places(const Span& span, const Step& step, std::size_t most) {
  return step.digits > 0 ? parts_of_seconds(span, step, most) : places(span, step.unit, step.count, most);
}

/// Between those of `step`; none where they would be the same or cannot be told.
std::vector<double> minor_places(const Span& span, const Step& step, int digits) {
  constexpr std::size_t most = 200;
  if (step.unit == Unit::months && step.count == 1) return {};
  if (step.digits == 0) return places(span, step.unit, step.count / step.minor, most);
  if (step.count == 5) return places(span, {Unit::seconds, 1, 1, step.digits}, most);
  if (step.digits == digits) return {};
  return places(span, {Unit::seconds, step.count == 2 ? 5 : 2, 1, step.digits + 1}, most);
}

/// Labels of seconds alone, behind the minute of the first, for axes across the end of a minute that have no room for more.
void label_briefly(Ticks& ticks, const Step& step) {
  for (auto& tick : ticks.major) {
    const auto m = moment_of(tick.value, step.digits);
    tick.label = fmt::format(":{:02}.{:0{}}", m.second % minute, m.part, step.digits);
  }
  const auto m = moment_of(ticks.major.front().value, step.digits);
  ticks.factor = fmt::format("from {:04}-{:02}-{:02} {:02}:{:02}", m.years, m.months, m.days, m.second / hour,
                             m.second / minute % minute);
}

/// Labels that leave out what all of them share, which stands in `factor`.
void label(Ticks& ticks, const Step& step) {
  std::vector<Moment> moments;
  for (const auto& tick : ticks.major) moments.push_back(moment_of(tick.value, step.digits));
  const auto all = [&](auto&& same) {
    return std::all_of(moments.begin(), moments.end(),
                       [&](const Moment& m) { return same(m, moments.front()); });
  };
  const bool one_year = all([](const Moment& a, const Moment& b) { return a.years == b.years; });
  const bool one_day = one_year && all([](const Moment& a, const Moment& b) {
                         return a.months == b.months && a.days == b.days;
                       });
  const bool has_days = step.unit == Unit::seconds,
             has_clock = has_days && (step.digits > 0 || step.count % day != 0);
  const bool has_months = has_days || step.count % year != 0;
  const bool has_seconds = has_clock && (step.digits > 0 || step.count % minute != 0);
  // such labels are long, and the minute is told once
  const bool one_minute = step.digits > 0 && one_day && all([](const Moment& a, const Moment& b) {
                            return a.second / minute == b.second / minute;
                          });
  for (std::size_t i = 0; i < moments.size(); ++i) {
    const auto& m = moments[i];
    std::string text;
    if (!has_months || !one_year) text = fmt::format("{:04}", m.years);
    if (has_months && !(has_clock && one_day))
      text += fmt::format("{}{:02}", text.empty() ? "" : "-", m.months);
    if (has_days && !(has_clock && one_day)) text += fmt::format("-{:02}", m.days);
    if (has_clock && !one_minute)
      text +=
          fmt::format("{}{:02}:{:02}", text.empty() ? "" : " ", m.second / hour, m.second / minute % minute);
    if (has_seconds) text += fmt::format(":{:02}", m.second % minute);
    if (step.digits > 0) text += fmt::format(".{:0{}}", m.part, step.digits);
    ticks.major[i].label = text;
  }
  if (moments.empty() || !has_months || !one_year) return;
  const auto& m = moments.front();
  ticks.factor = has_clock && one_day ? fmt::format("{:04}-{:02}-{:02}", m.years, m.months, m.days)
                                      : fmt::format("{:04}", m.years);
  if (one_minute) ticks.factor += fmt::format(" {:02}:{:02}", m.second / hour, m.second / minute % minute);
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

/// The finest ticks whose labels fit, two at least if such are found. `brief`: those of seconds alone.
std::optional<Ticks> finest(const Span& span, int digits, bool brief, double length, double size,
                            bool horizontal) {
  std::optional<Ticks> few;
  for (const Step& step : steps_from(digits)) {
    if (brief && step.digits == 0) break;
    Ticks ticks;
    for (const double at : places(span, step, most_labels)) ticks.major.push_back({at, {}});
    if (ticks.major.empty() || ticks.major.size() > most_labels) continue;
    brief ? label_briefly(ticks, step) : label(ticks, step);
    if (!fits(ticks, span, length, size, horizontal)) continue;
    const auto small = minor_places(span, step, digits);
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

}  // namespace

Calendar calendar() { return {month_begin(year), month_begin(10'000 * year) - 1}; }

std::optional<Ticks> time_ticks(const Span& span, double length, double size, bool horizontal) {
  const auto [first, last] = calendar();
  if (!(span.low >= first && span.high <= last)) return {};
  const auto digits = told_digits(span);
  if (!digits) return {};
  auto found = finest(span, *digits, false, length, size, horizontal);
  constexpr double seconds_wrap = 30;  // of a longer axis seconds alone would stand twice
  if ((found && found->major.size() >= 2) || span.high - span.low > seconds_wrap) return found;
  auto brief = finest(span, *digits, true, length, size, horizontal);
  return brief && brief->major.size() >= 2 ? brief : found;
}

}  // namespace chute::plot
