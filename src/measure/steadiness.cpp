#include "measure/steadiness.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

namespace chute::measure {
namespace {

constexpr std::size_t blocks = 64, stretches = 12;
constexpr std::array<std::string_view, 5> verdict_names{"stopped", "steady", "accelerating", "runaway",
                                                        "unsettled"};

double mean(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// The record of a run, to be asked about any part of it.
class Record {
 public:
  explicit Record(const FlowSeries& series) : s_(series) {}
  std::size_t rows() const { return s_.time.size(); }
  std::size_t last() const { return rows() - 1; }
  /// The row at a part of the time from `first` to the end.
  std::size_t row(std::size_t first, std::size_t k, std::size_t of) const {
    return first + (last() - first) * k / of;
  }
  double velocity(std::size_t from, std::size_t to) const {
    return (s_.x[to] - s_.x[from]) / (s_.time[to] - s_.time[from]);
  }

  /// Velocities of equal parts of the time from row `first` to the end.
  std::vector<double> velocities(std::size_t first, std::size_t count) const {
    std::vector<double> v(count);
    for (std::size_t k = 0; k < count; ++k) v[k] = velocity(row(first, k, count), row(first, k + 1, count));
    return v;
  }
  /// Means of another column over the same parts.
  std::vector<double> means(std::span<const double> column, std::size_t first, std::size_t count) const {
    std::vector<double> m(count);
    for (std::size_t k = 0; k < count; ++k) {
      const auto from = row(first, k, count), to = row(first, k + 1, count);
      m[k] = mean(column.subspan(from + 1, to - from));
    }
    return m;
  }

 private:
  const FlowSeries& s_;
};

/// MSER: the number of leading values without which the mean of the others has the least squared standard
/// error. Of nearly equal choices the one that keeps most, for correlated noise would often cut away good
/// data.
std::size_t transient(std::span<const double> values) {
  constexpr std::size_t fewest = 8;  // fewer can agree by chance
  constexpr double nearly = 1.3;
  std::vector<double> statistic(values.size(), INFINITY);
  double sum = 0, squares = 0;
  const double shift = values.back();  // keeps the sums of squares free of cancellation
  for (std::size_t first = values.size(); first-- > 0;) {
    sum += values[first] - shift;
    squares += (values[first] - shift) * (values[first] - shift);
    const auto n = static_cast<double>(values.size() - first);
    if (values.size() - first >= fewest) statistic[first] = std::max(0.0, squares - sum * sum / n) / (n * n);
  }
  const double least = *std::min_element(statistic.begin(), statistic.end());
  const auto found =
      std::find_if(statistic.begin(), statistic.end(), [&](double s) { return s <= nearly * least; });
  return static_cast<std::size_t>(found - statistic.begin());
}

/// Straight line through equally spaced values, and how far they scatter about it.
struct Trend {
  double middle, change, change_error, scatter;
  double off_line;  ///< scatter about the line; `scatter` is about the mean
  explicit Trend(std::span<const double> values) : middle(mean(values)) {
    const auto n = static_cast<double>(values.size());
    const double centre = (n - 1) / 2;
    double moment = 0, spread = 0, square = 0, next = 0, all = 0;
    for (std::size_t k = 0; k < values.size(); ++k) {
      const double t = static_cast<double>(k) - centre;
      moment += t * (values[k] - middle);
      spread += t * t;
    }
    const double slope = moment / spread;
    std::vector<double> off(values.size());
    for (std::size_t k = 0; k < values.size(); ++k) {
      off[k] = values[k] - middle - slope * (static_cast<double>(k) - centre);
      square += off[k] * off[k];
      all += (values[k] - middle) * (values[k] - middle);
      if (k > 0) next += off[k] * off[k - 1];
    }
    change = n * slope;
    change_error =
        n * std::sqrt(square / (n - 2) / spread) * correlation_factor(square > 0 ? next / square : 0);
    scatter = std::sqrt(all / (n - 1));
    off_line = std::sqrt(square / (n - 2));
  }
};

/// First row of the rest at the end, if there is one.
std::optional<std::size_t> rest(const FlowSeries& s, const FlowScales& scales) {
  const double still = 1e-3 * scales.gravity * scales.length, near = 0.5 * scales.length;
  std::size_t first = s.time.size();
  while (first > 0 && s.kinetic[first - 1] <= still && std::abs(s.x[first - 1] - s.x.back()) <= near) --first;
  const double needed = scales.gravity > 0 ? 10 * std::sqrt(scales.length / scales.gravity) : 0;
  if (first + 3 > s.time.size() || s.time.back() - s.time[first] < needed) return {};
  return first;
}

bool is_steady(const Record& record, std::size_t first) {
  const auto v = record.velocities(first, stretches);
  const Trend trend(v);
  const double speed = std::abs(trend.middle);
  const double last = record.velocity(record.row(0, 7, 8), record.last());
  return trend.change_error <= 0.15 * speed &&
         std::abs(trend.change) <= std::max(0.1 * speed, 3 * trend.change_error) &&
         std::abs(last - trend.middle) <= std::max(0.15 * speed, 4 * trend.scatter);
}

constexpr std::size_t eighth = blocks / 8, quarter = blocks / 4;
/// Standard errors of a growth that is no chance, and standard deviations of a plateau that has been left. Noise that is
/// correlated over a twentieth to a fifth of the record ran away in 5 to 9 % of records without these, in 0 to 1 % with them.
constexpr double sure_growth = 3, sure_departure = 4;

/// Mean velocities of sixteenths of the record: long enough that single blocks do not decide, short enough to see it slow down.
std::vector<double> sixteenths(std::span<const double> v) {
  constexpr std::size_t length = blocks / 16;
  std::vector<double> means;
  for (std::size_t first = 0; first < v.size(); first += length)
    means.push_back(mean(v.subspan(first, length)));
  return means;
}

bool grows(std::span<const double> v) {
  const Trend trend(v);
  return trend.change > sure_growth * trend.change_error;
}

/// Does it grow up to the end of the record? What slows down before is on its way back, or may be.
bool still_grows(std::span<const double> v) {
  const auto parts = sixteenths(v);
  return parts.back() == *std::max_element(parts.begin(), parts.end()) && grows(v.last(quarter));
}

double deviation(std::span<const double> values) {
  const double middle = mean(values);
  double squares = 0;
  for (const double v : values) squares += (v - middle) * (v - middle);
  return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

bool runs_away(std::span<const double> v) {
  constexpr std::size_t length = 3 * blocks / 8, third = length / 3;
  if (!still_grows(v)) return false;
  const double end = mean(v.last(eighth));
  for (std::size_t first = 0; first + length + eighth <= blocks; ++first) {
    const auto plateau = v.subspan(first, length);
    const std::array parts{mean(plateau.first(third)), mean(plateau.subspan(third, third)),
                           mean(plateau.last(third))};
    const auto [low, high] = std::minmax_element(parts.begin(), parts.end());
    if (!(*low > 0 && *high <= 1.15 * *low && end >= 1.3 * *high)) continue;
    // how far it strayed before, the first eighth with the start's transient left out
    const auto begin = std::min(first, eighth);
    const double strayed = deviation(v.subspan(begin, first + length - begin));
    if (end - mean(plateau) > sure_departure * strayed) return true;
  }
  return false;
}

bool accelerates(std::span<const double> v) {
  const auto late = v.subspan(quarter);
  const double a = mean(late.first(quarter)), b = mean(late.subspan(quarter, quarter)),
               c = mean(late.last(quarter));
  if (!(c >= 1.2 * std::abs(a) && b > a && c - b >= 0.8 * (b - a) && grows(late))) return false;
  const auto parts = sixteenths(late);
  return parts.back() >= *std::max_element(parts.begin(), parts.end()) - Trend(parts).off_line;
}

}  // namespace

std::string_view name(Verdict verdict) { return verdict_names[static_cast<std::size_t>(verdict)]; }

std::optional<Verdict> verdict_named(std::string_view name) {
  const auto found = std::find(verdict_names.begin(), verdict_names.end(), name);
  if (found == verdict_names.end()) return {};
  return static_cast<Verdict>(found - verdict_names.begin());
}

namespace {

/// Rows that lie as far apart as the two that lie farthest, for a run whose rows were made to come more often or more seldom
/// on the way; empty if all lie equally far apart but for rounding to steps.
std::vector<std::size_t> even_rows(std::span<const double> time) {
  constexpr double rounding = 1.5;
  double least = INFINITY, most = 0;
  for (std::size_t k = 1; k < time.size(); ++k) {
    least = std::min(least, time[k] - time[k - 1]);
    most = std::max(most, time[k] - time[k - 1]);
  }
  if (!(most > rounding * least) || !(least > 0)) return {};
  std::vector<std::size_t> rows{0};
  for (std::size_t k = 1; k < time.size(); ++k)
    if (time[k] - time[rows.back()] >= most * (1 - 1e-6)) rows.push_back(k);
  return rows;
}

/// Length of the record in sqrt(length/g); infinite without gravity, where nothing accelerates by itself.
double time_units(const FlowSeries& s, const FlowScales& scales) {
  if (!(scales.gravity > 0)) return INFINITY;
  return (s.time.back() - s.time.front()) / std::sqrt(scales.length / scales.gravity);
}
/// In less, grains that were launched have not even met all of each other.
constexpr double shortest_record = 20;

}  // namespace

Flow judge_flow(const FlowSeries& series, const FlowScales& scales) {
  if (const auto rows = even_rows(series.time); !rows.empty()) {
    std::array<std::vector<double>, 4> thinned;
    for (const auto row : rows) {
      thinned[0].push_back(series.time[row]), thinned[1].push_back(series.x[row]);
      thinned[2].push_back(series.omega[row]), thinned[3].push_back(series.kinetic[row]);
    }
    return judge_flow({thinned[0], thinned[1], thinned[2], thinned[3]}, scales);
  }
  const Record record(series);
  const auto unknown = [](double value) { return Estimate{value, {}}; };
  if (record.rows() < 2) return {Verdict::unsettled, NAN, unknown(NAN), unknown(NAN), unknown(NAN)};
  const auto plain = [&](Verdict verdict, std::size_t first) {
    const auto part = [&](std::span<const double> column) {
      return unknown(mean(column.subspan(first + 1)));
    };
    return Flow{verdict, series.time[first], unknown(record.velocity(first, record.last())),
                part(series.omega), part(series.kinetic)};
  };
  if (const auto first = rest(series, scales)) return plain(Verdict::stopped, *first);
  const auto late = record.row(0, 3, 4);
  if (record.rows() <= blocks) return plain(Verdict::unsettled, late);

  const auto v = record.velocities(0, blocks);
  const auto first = record.row(0, std::min(transient(v), 3 * blocks / 5), blocks);
  const double way = std::abs(series.x.back() - series.x[first]);
  if (way >= 20 * scales.length && is_steady(record, first))
    return {Verdict::steady, series.time[first], estimate_in_time(record.velocities(first, stretches)),
            estimate_in_time(record.means(series.omega, first, stretches)),
            estimate_in_time(record.means(series.kinetic, first, stretches))};
  if (time_units(series, scales) < shortest_record) return plain(Verdict::unsettled, late);
  if (runs_away(v)) return plain(Verdict::runaway, late);
  return plain(accelerates(v) ? Verdict::accelerating : Verdict::unsettled, late);
}

Flow joined(std::span<const Flow> starts) {
  std::array<std::size_t, verdict_names.size()> count{};
  for (const auto& start : starts) ++count[static_cast<std::size_t>(start.verdict)];
  const auto most = static_cast<Verdict>(std::max_element(count.begin(), count.end()) - count.begin());
  Flow flow{most, -INFINITY, {}, {}, {}};
  const auto over = [&](Estimate Flow::*member) {
    std::vector<double> means;
    for (const auto& start : starts)
      if (start.verdict == most) means.push_back((start.*member).mean);
    return estimate_of(means);
  };
  for (const auto& start : starts)
    if (start.verdict == most) flow.from = std::max(flow.from, start.from);
  flow.v_x = over(&Flow::v_x);
  flow.omega = over(&Flow::omega);
  flow.kinetic = over(&Flow::kinetic);
  return flow;
}

}  // namespace chute::measure
