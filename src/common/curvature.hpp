#pragma once
#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

/// Where a curve needs points so that the straight lines between them are not seen: as many as it bends.
namespace chute {

/// How far a curve may pass from the lines through its points, as a share of its range: half a line's width in a figure.
inline constexpr double unseen_bend = 1.5e-3;

/// The same of a closed form, whose points cost nothing: so little that its corners are not seen either, where a long straight line
/// ends at a small angle.
inline constexpr double smooth_bend = 3e-4;

/// Rounds of halving; a jump gets two points in each.
inline constexpr int most_halvings = 7;

/// Of a curve through points in ascending x the places, halfway between neighbours, where it bends by more than is unseen:
/// looked up, they make it smoother, and after some rounds there are none. With `log` halfway in the logarithm.
inline std::vector<double> where_bent(const std::vector<double>& x, const std::vector<double>& y, bool log,
                                      double allowed = unseen_bend) {
  std::vector<double> between;
  if (x.size() < 3) return between;
  double low = y[0], high = y[0];
  for (const double v : y)
    if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
  const auto at = [&](std::size_t i) { return log ? std::log(x[i]) : x[i]; };
  // What spans decades is shown on a logarithmic axis, where its small values bend as visibly as the large ones.
  constexpr double decade = 10;
  const bool decades = low > 0 && high > decade * low;
  const auto height = [&](std::size_t i) { return decades ? std::log(y[i]) : y[i]; };
  const double range = decades ? std::log(high / low) : high - low;
  std::vector<bool> halve(x.size(), false);  // the interval behind each point
  for (std::size_t i = 1; i + 1 < x.size(); ++i) {
    const double part = (at(i) - at(i - 1)) / (at(i + 1) - at(i - 1));
    const double bend = std::abs(height(i) - (height(i - 1) + part * (height(i + 1) - height(i - 1))));
    if (bend > allowed * range) halve[i - 1] = halve[i] = true;
  }
  for (std::size_t i = 0; i + 1 < x.size(); ++i)
    if (halve[i]) between.push_back(log ? std::exp((at(i) + at(i + 1)) / 2) : (x[i] + x[i + 1]) / 2);
  return between;
}

/// A function from `low` to `high` at as many places as it bends: never fewer than `least`, evenly spaced.
inline std::vector<std::pair<double, double>> by_curvature(const std::function<double(double)>& f, double low,
                                                           double high, int least = 24) {
  std::vector<std::pair<double, double>> points;
  for (int k = 0; k <= least; ++k) {
    const double x = k == least ? high : low + (high - low) * k / least;
    points.emplace_back(x, f(x));
  }
  for (int round = 0; round < most_halvings; ++round) {
    std::vector<double> x, y;
    for (const auto& [a, b] : points) x.push_back(a), y.push_back(b);
    const auto more = where_bent(x, y, false, smooth_bend);
    if (more.empty()) break;
    for (const double at : more) points.emplace_back(at, f(at));
    std::sort(points.begin(), points.end());
  }
  return points;
}

/// The points of a finely sampled curve that are needed to draw it: the ends, the least and the greatest, and wherever it would pass by more than is unseen
/// from the line through the others (Douglas & Peucker 1973, distances along y).
inline std::vector<std::size_t> needed_points(const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<std::size_t> kept;
  if (x.empty()) return kept;
  const auto [low, high] = std::minmax_element(y.begin(), y.end());
  const double allowed = unseen_bend * (*high - *low);
  std::vector<bool> needed(x.size(), false);
  needed.front() = needed.back() = true;
  needed[static_cast<std::size_t>(low - y.begin())] = needed[static_cast<std::size_t>(high - y.begin())] =
      true;
  std::vector<std::pair<std::size_t, std::size_t>> open;
  for (std::size_t i = 1, from = 0; i < x.size(); ++i)
    if (needed[i]) open.emplace_back(from, i), from = i;
  while (!open.empty()) {
    const auto [from, to] = open.back();
    open.pop_back();
    std::size_t worst = from;
    double most = allowed;
    for (std::size_t i = from + 1; i < to; ++i) {
      const double line = y[from] + (y[to] - y[from]) * (x[i] - x[from]) / (x[to] - x[from]);
      if (std::abs(y[i] - line) > most) most = std::abs(y[i] - line), worst = i;
    }
    if (worst == from) continue;
    needed[worst] = true;
    open.emplace_back(from, worst), open.emplace_back(worst, to);
  }
  for (std::size_t i = 0; i < x.size(); ++i)
    if (needed[i]) kept.push_back(i);
  return kept;
}

}  // namespace chute
