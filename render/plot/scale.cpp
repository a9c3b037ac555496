#include "plot/scale.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/error.hpp"
#include "plot/time_ticks.hpp"

namespace chute::plot {

double Span::fraction(double value) const {
  if (scale == Scale::linear) {
    if (std::isfinite(high - low)) return (value - low) / (high - low);
    return (value / 2 - low / 2) / (high / 2 - low / 2);  // from -1e308 to 1e308
  }
  if (!(value > 0)) return unknown;
  // logarithms of what lies close together differ in their last digits only
  if (high - low < low) return std::log1p((value - low) / low) / std::log1p((high - low) / low);
  return (std::log(value) - std::log(low)) / (std::log(high) - std::log(low));
}

double Span::at(double fraction) const {
  if (fraction == 1) return high;  // which roundings below might leave, also what doubles can hold
  if (scale == Scale::linear) return std::lerp(low, high, fraction);
  if (high - low < low) return low * std::exp(fraction * std::log1p((high - low) / low));
  return std::exp(std::lerp(std::log(low), std::log(high), fraction));
}

void Extent::include(double value, Scale scale, Mark mark) {
  if (!std::isfinite(value) || (scale == Scale::log && value <= 0)) return;
  low = std::min(low, value);
  high = std::max(high, value);
  if (mark == Mark::none) return;
  dot_low = std::min(dot_low, value);
  dot_high = std::max(dot_high, value);
  if (mark == Mark::dot) return;
  marker_low = std::min(marker_low, value);
  marker_high = std::max(marker_high, value);
}

void Extent::include(const Extent& other) {
  low = std::min(low, other.low);
  high = std::max(high, other.high);
  marker_low = std::min(marker_low, other.marker_low);
  marker_high = std::max(marker_high, other.marker_high);
  dot_low = std::min(dot_low, other.dot_low);
  dot_high = std::max(dot_high, other.dot_high);
  from_zero |= other.from_zero;
  keep_off |= other.keep_off;
}

namespace {

constexpr double room = 0.045;  // of the range, beside the outermost markers
/// Of the range, between a marker or dot and limits that were given: half a marker in the smallest usual frame.
constexpr double marker_room = 0.052, dot_room = 0.01;
constexpr double least = std::numeric_limits<double>::denorm_min(), most = std::numeric_limits<double>::max();

/// Room beyond the data must not leave what doubles can hold.
double held(double value) { return std::clamp(value, -most, most); }

/// Those of the axis where it names them, of the data elsewhere. An end that is named beyond all data is both.
std::pair<double, double> ends(const Axis& axis, const Extent& e) {
  const double low = axis.min.value_or(e.low), high = axis.max.value_or(e.high);
  if (low <= high || (axis.min && axis.max)) return {low, high};
  return axis.min ? std::pair{low, low} : std::pair{high, high};
}

Span padded_linear(const Axis& axis, Extent e) {
  if (e.low > e.high) {
    e.low = 0;
    e.high = 1;
  }
  if (e.from_zero) {
    e.low = std::min(0.0, e.low);
    e.high = std::max(0.0, e.high);
  }
  const auto [low, high] = ends(axis, e);
  Span span{low, high, Scale::linear};
  const double range = high - low, size = std::max(std::abs(low), std::abs(high));
  if (!std::isfinite(range)) return span;
  constexpr double half_a_day = 43'200;
  const double rounding = axis.times ? 0 : 1e-9 * size;  // clocks tell a second from the next in fifty years
  if (range < rounding || range == 0 || size == 0) {     // such differences are rounding, not data
    const double wider = axis.times ? half_a_day
                         : size > 0 ? std::max(0.1 * size, std::numeric_limits<double>::min())
                                    : 0.5;
    if (!axis.min) span.low = held(span.low - wider);
    if (!axis.max) span.high = held(span.high + wider);
    return span;
  }
  const double space = room * range;
  if (axis.min) span.low = std::min({low, e.marker_low - marker_room * range, e.dot_low - dot_room * range});
  if (axis.max)
    span.high = std::max({high, e.marker_high + marker_room * range, e.dot_high + dot_room * range});
  const bool on_ground = e.from_zero && high == 0, on_floor = e.from_zero && low == 0;
  if (!axis.max && !on_ground && (e.keep_off || e.dot_high > high - space))
    span.high = held(span.high + space);
  if (axis.min || on_floor) return span;
  // near zero start at zero, unless markers sit right there
  if (!axis.times && low >= 0 && low < 0.2 * high && e.dot_low > space)
    span.low = 0;
  else if (e.keep_off || e.dot_low < low + space)
    span.low = held(span.low - space);
  return span;
}

Span padded_log(const Axis& axis, Extent e) {
  if (e.low > e.high) {
    e.low = axis.max ? *axis.max / 100 : axis.min.value_or(0.1);
    e.low = std::max(e.low, least);
    e.high = held(100 * e.low);
  }
  const auto [low, high] = ends(axis, e);
  Span span{low, high, Scale::log};
  const double ratio = std::log(span.high) - std::log(span.low);
  if (ratio < 1e-9) {
    if (!axis.min) span.low = std::max(span.low / 3, least);
    if (!axis.max) span.high = held(span.high * 3);
    return span;
  }
  const double factor = std::exp(room * ratio);
  const double by_marker = std::exp(marker_room * ratio), by_dot = std::exp(dot_room * ratio);
  if (axis.min)
    span.low = std::max(std::min({span.low, e.marker_low / by_marker, e.dot_low / by_dot}), least);
  if (axis.max) span.high = held(std::max({span.high, e.marker_high * by_marker, e.dot_high * by_dot}));
  const bool pad_low = e.keep_off || e.dot_low < span.low * factor;
  const bool pad_high = e.keep_off || e.dot_high > span.high / factor;
  if (!axis.min && pad_low) span.low = std::max(span.low / factor, least);
  if (!axis.max && pad_high) span.high = held(span.high * factor);
  return span;
}

double power_of_ten(int n) { return std::pow(10.0, n); }
/// value × 10^n, also where 10^n is no double.
double times_ten(double value, int n) { return value * power_of_ten(n / 2) * power_of_ten(n - n / 2); }
int decade_of(double value) {
  int n = static_cast<int>(std::floor(std::log10(value)));
  if (times_ten(value, -n - 1) >= 1 - 1e-12) ++n;
  return n;
}

/// Labels of numbers whose last digit counts 10^`last`: all with the same decimals, large and tiny ones over
/// a factor; what differs in late digits only stands for its distance from a round number, which the factor names.
struct Labels {
  std::vector<std::string> texts;
  std::string factor;
};

constexpr int most_digits = 8;  // labels of more cannot be compared by eye

/// The round number below all values that leaves only the digits in which they differ; 0 if they need none.
double offset_of(const std::vector<double>& values, double largest, int last) {
  if (values.empty() || !(largest > 0) || decade_of(largest) - last < most_digits) return 0;
  const double range = values.back() - values.front();
  if (!std::isfinite(range)) return 0;
  const int digit = (range > 0 ? decade_of(range) : last) + 1;
  const double steps = std::floor(times_ten(values.front(), -digit));
  const double offset = times_ten(steps, digit);
  return std::abs(steps) < 1e15 && std::isfinite(offset) ? offset : values.front();
}

/// A number in full, or over a power of ten.
std::string full(double value) {
  const int decade = value == 0 ? 0 : decade_of(std::abs(value));
  constexpr int longest = 12;
  if (decade >= 0 && decade < longest) return fmt::format("{:.15g}", value);
  return fmt::format("{:.15g}\\times10^{{{}}}", times_ten(value, -decade), decade);
}

Labels label(const std::vector<double>& values, int last) {
  double largest = 0;
  for (double v : values) largest = std::max(largest, std::abs(v));
  const double offset = offset_of(values, largest, last);
  if (offset != 0) {
    largest = 0;
    for (double v : values) largest = std::max(largest, std::abs(v - offset));
  }
  int shift = 0;
  if (largest > 0 && (largest >= 99999.5 || largest < 1e-3 || (last < -4 && largest < 1)))
    shift = decade_of(largest);
  const int decimals = std::clamp(shift - last, 0, 17);
  Labels labels;
  for (double v : values) {
    const double scaled = times_ten(v - offset, -shift);
    auto text = fmt::format("{:.{}f}", scaled, decimals);
    if (text.find_first_not_of("-0.") == std::string::npos && text[0] == '-')
      text.erase(0, 1);  // no minus zero
    labels.texts.push_back("$" + text + "$");
  }
  if (shift != 0) labels.factor = fmt::format("$\\times10^{{{}}}$", shift);
  if (offset != 0)
    labels.factor += fmt::format("${}{}{}$", shift != 0 ? "\\," : "", offset > 0 ? "+" : "", full(offset));
  return labels;
}

class Ruler {
 public:
  Ruler(const Span& span, double length, double size, bool horizontal)
      : span_(span), length_(length), size_(size), horizontal_(horizontal) {}

  /// The names at 1, 2, 3 … InputError if they touch.
  Ticks named(const std::vector<std::string>& names) const {
    Ticks ticks;
    for (std::size_t i = 0; i < names.size(); ++i) {
      const double at = static_cast<double>(i + 1);
      if (at >= span_.low && at <= span_.high) ticks.major.push_back({at, names[i]});
    }
    if (!fits(ticks.major, narrow_gap()))
      throw InputError(
          fmt::format("the axis is too short for its {} names: \"{}\" …", names.size(), names[0]));
    return ticks;
  }
  Ticks ticks() const { return span_.scale == Scale::linear ? linear(true) : logarithmic(); }

 private:
  Span span_;
  double length_, size_;
  bool horizontal_;

  bool fits(const std::vector<Tick>& major, double gap) const {
    double edge = -1e300;
    for (const auto& tick : major) {
      const auto text = set_text(tick.label, size_);
      const double half = (horizontal_ ? text.width : text.ascent + text.descent) / 2;
      const double at = span_.fraction(tick.value) * length_;
      if (at - half < edge + gap) return false;
      edge = at + half;
    }
    return true;
  }
  static constexpr std::size_t most_labels = 9;  // more are no help to the eye, however much room there is
  double wide_gap() const { return 1.3 * size_; }
  double narrow_gap() const { return (horizontal_ ? 0.6 : 0.45) * size_; }

  /// Within rounding, which is all that is left of an axis whose ends agree but for it.
  bool is_on_axis(double value) const {
    const double range = span_.high - span_.low, slack = std::isfinite(range) ? 1e-6 * range : 0;
    return value >= span_.low - slack && value <= span_.high + slack &&
           (span_.scale == Scale::linear || value > 0);
  }

  /// Of counts beyond it doubles miss some.
  static constexpr double countable = 9e15;

  Ticks with_step(double mantissa, int exponent) const {
    const double step = times_ten(mantissa, exponent);
    Ticks ticks;
    std::vector<double> values;
    const double first = std::ceil(span_.low / step - 1e-7), last = std::floor(span_.high / step + 1e-7);
    if (!std::isfinite(step) || step == 0 || !(last - first <= 200)) return ticks;
    if (std::max(std::abs(first), std::abs(last)) > countable) return ticks;
    for (double i = first; i <= last; ++i) {
      // through the decimal form: 3 * 0.1 must be 0.3
      const bool divides = exponent < 0 && exponent > -300;
      const double value = divides ? i * mantissa / power_of_ten(-exponent) : i * step;
      if (!is_on_axis(value) || (!values.empty() && value <= values.back())) continue;
      values.push_back(value);
    }
    take(ticks, values, exponent);
    add_minor(ticks, step / (mantissa == 2 ? 4 : 5));
    return ticks;
  }

  static void take(Ticks& ticks, const std::vector<double>& values, int last_digit) {
    const auto labels = label(values, last_digit);
    for (std::size_t i = 0; i < values.size(); ++i) ticks.major.push_back({values[i], labels.texts[i]});
    ticks.factor = labels.factor;
  }

  void add_minor(Ticks& ticks, double step) const {
    if (!((span_.high - span_.low) / step <= length_ / 3)) return;
    const double first = std::ceil(span_.low / step - 1e-7), last = std::floor(span_.high / step + 1e-7);
    if (std::max(std::abs(first), std::abs(last)) > countable) return;
    for (double i = first; i <= last; ++i) {
      const double value = i * step;
      const bool taken = std::any_of(ticks.major.begin(), ticks.major.end(),
                                     [&](const Tick& t) { return std::abs(t.value - value) < 0.01 * step; });
      if (!taken && is_on_axis(value)) ticks.minor.push_back(value);
    }
  }

  /// The finest step whose labels fit well; a finer one that just fits where that gives fewer than three
  /// labels.
  Ticks linear(bool wanted) const {
    const double range = span_.high - span_.low;
    const int top =
        std::isfinite(range) ? decade_of(range) + 1 : std::numeric_limits<double>::max_exponent10 + 1;
    Ticks tight, few;
    for (int exponent = top - 4; exponent <= top; ++exponent)
      for (int mantissa : {1, 2, 5}) {
        auto ticks = with_step(mantissa, exponent);
        if (ticks.major.empty()) continue;
        if (tight.major.empty() && fits(ticks.major, narrow_gap())) tight = ticks;
        if (ticks.major.size() > most_labels || !fits(ticks.major, wide_gap())) continue;
        if (ticks.major.size() >= 3 || !wanted) return ticks;
        if (few.major.empty()) few = ticks;
      }
    auto& best = tight.major.size() > few.major.size() ? tight : few;
    // ends that differ in their last digits have no round number between them: they are told themselves
    if (best.major.empty()) take(best, {span_.low, span_.high}, decade_of(std::min(range, most)) - 1);
    return best;
  }

  Ticks logarithmic() const {
    const double low = std::log10(span_.low), high = std::log10(span_.high);
    const int first = static_cast<int>(std::ceil(low - 1e-9)),
              last = static_cast<int>(std::floor(high + 1e-9));
    if (last > first && high - low > std::log10(12.0)) return decades(first, last);
    if (high - low > std::log10(3.0)) {
      auto ticks = one_two_five();
      if (ticks.major.size() >= 3 && fits(ticks.major, narrow_gap())) return ticks;
    }
    return linear(true);
  }

  Ticks decades(int first, int last) const {
    Ticks ticks;
    // beyond six only those strides that a reader counts in
    const auto next = [](int stride) { return stride < 6 ? stride + 1 : stride < 10 ? 10 : stride + 10; };
    for (int stride = 1;; stride = next(stride)) {
      ticks.major.clear();
      for (int n = first; n <= last; ++n)
        if (n % stride == 0 && power_of_ten(n) > 0)
          ticks.major.push_back({power_of_ten(n), fmt::format("$10^{{{}}}$", n)});
      if (fits(ticks.major, horizontal_ ? 0.8 * size_ : 0.7 * size_) || ticks.major.size() <= 1) {
        const double decade = length_ / (std::log10(span_.high) - std::log10(span_.low));
        for (int n = first - 1; n <= last; ++n) {
          constexpr double crowded = 2.5;  // points: closer ticks run together
          if (stride > 1 && decade >= crowded && n >= first && n % stride != 0)
            ticks.minor.push_back(power_of_ten(n));
          if (stride > 1 || decade < 4 * size_ / 3) continue;
          for (int digit = 2; digit <= 9; ++digit) {
            const double value = digit * power_of_ten(n);
            if (value >= span_.low && value <= span_.high) ticks.minor.push_back(value);
          }
        }
        return ticks;
      }
    }
  }

  Ticks one_two_five() const {
    Ticks ticks;
    std::vector<double> values;
    const int lowest = decade_of(span_.low), highest = decade_of(span_.high);
    int finest = highest;
    for (int n = lowest; n <= highest; ++n)
      for (int digit = 1; digit <= 9; ++digit) {
        const double value = digit * power_of_ten(n);
        if (!std::isfinite(value) || value < span_.low * (1 - 1e-9) || value > span_.high * (1 + 1e-9))
          continue;
        if (digit == 1 || digit == 2 || digit == 5)
          values.push_back(value), finest = std::min(finest, n);
        else
          ticks.minor.push_back(value);
      }
    take(ticks, values, finest);
    return ticks;
  }
};

}  // namespace

namespace {

/// Dates and limits are of the calendar; the room beside them ends with it.
void keep_in_calendar(const Axis& axis, const Extent& data, Span& span) {
  const auto [first, last] = calendar();
  const auto is_in = [first = first, last = last](double v) { return v >= first && v <= last; };
  const auto wrong = [&](const std::string& what) {
    throw InputError(
        fmt::format("axis \"{}\": {}: axes of dates go from the year 1 to the year 9999", axis.label, what));
  };
  for (const auto& limit : {axis.min, axis.max})
    if (limit && !is_in(*limit))
      wrong(fmt::format("the limit {} (in seconds since 1970; dates: from, to)", *limit));
  if (data.low <= data.high && !(is_in(data.low) && is_in(data.high)))
    wrong("there are earlier or later dates");
  span.low = std::clamp(span.low, first, last - 1);
  span.high = std::clamp(span.high, std::nextafter(span.low, last), last);
}

}  // namespace

Span span_of(const Axis& axis, const Extent& extent) {
  const auto wrong = [&](const std::string& what) {
    throw InputError(fmt::format("axis \"{}\": {}", axis.label, what));
  };
  for (const auto& limit : {axis.min, axis.max}) {
    if (!limit) continue;
    if (!std::isfinite(*limit)) wrong("its limits must be finite");
    if (axis.scale == Scale::log && *limit <= 0)
      wrong(fmt::format("{} is no limit of a log axis, must be > 0", *limit));
  }
  if (axis.min && axis.max && !(*axis.min < *axis.max))
    wrong(fmt::format("min {} must be below max {}", *axis.min, *axis.max));
  if (!axis.names.empty()) {
    if (axis.scale == Scale::log) wrong("a log axis has no names");
    return {axis.min.value_or(0.5), axis.max.value_or(static_cast<double>(axis.names.size()) + 0.5),
            Scale::linear};
  }
  Extent data = extent;
  // data that lie wholly beyond the one given limit leave the other to choose
  if (axis.min && data.high <= *axis.min)
    data.high = held(axis.scale == Scale::log ? *axis.min * 10
                                              : *axis.min + std::max(1.0, 0.1 * std::abs(*axis.min)));
  if (axis.max && data.low >= *axis.max)
    data.low = axis.scale == Scale::log ? std::max(*axis.max / 10, least)
                                        : held(*axis.max - std::max(1.0, 0.1 * std::abs(*axis.max)));
  Span span = axis.scale == Scale::linear ? padded_linear(axis, data) : padded_log(axis, data);
  if (axis.times && axis.scale == Scale::linear) keep_in_calendar(axis, extent, span);
  if (axis.min) span.low_limit = *axis.min;
  if (axis.max) span.high_limit = *axis.max;
  return span;
}

std::vector<std::string> value_texts(const std::vector<double>& values) {
  constexpr double share = 0.02;  // of the distance to the next value that a text may be off
  double largest = 0, distance = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < values.size(); ++i) {
    largest = std::max(largest, std::abs(values[i]));
    for (std::size_t k = 0; k < i; ++k)
      if (values[k] != values[i]) distance = std::min(distance, std::abs(values[i] - values[k]));
  }
  if (!(largest > 0)) return std::vector<std::string>(values.size(), "$0$");
  distance = std::min(distance, largest);
  const auto rounded = [](double value, int digit) {
    return times_ten(std::round(times_ten(value, -digit)), digit);
  };
  const auto is_told = [&](double v, int digit) {
    return std::abs(rounded(v, digit) - v) <= share * distance;
  };
  int last = std::max(0, decade_of(distance));
  while (last > decade_of(distance) - most_digits &&
         !std::all_of(values.begin(), values.end(), [&](double v) { return is_told(v, last); }))
    --last;
  std::vector<double> told;
  for (const double v : values) told.push_back(rounded(v, last));
  const auto labels = label(told, last);
  if (labels.factor.empty()) return labels.texts;
  std::vector<std::string> texts;
  for (const double v : told) texts.push_back("$" + full(v) + "$");
  return texts;
}

Ticks ticks_for(const Span& span, double length, double size, bool horizontal) {
  return Ruler(span, length, size, horizontal).ticks();
}

Ticks ticks_for(const Axis& axis, const Span& span, double length, double size, bool horizontal) {
  if (axis.times && span.scale == Scale::linear)
    if (auto ticks = time_ticks(span, length, size, horizontal)) return std::move(*ticks);
  if (axis.names.empty()) {
    auto ticks = ticks_for(span, length, size, horizontal);
    if (axis.times) ticks.factor += fmt::format("{}s since 1970", ticks.factor.empty() ? "" : " ");
    return ticks;
  }
  return Ruler(span, length, size, horizontal).named(axis.names);
}

}  // namespace chute::plot
