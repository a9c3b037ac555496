#include "sweep/phase.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace chute::sweep {
namespace {

using measure::Verdict;

Estimate mean_over(const std::vector<Estimate>& starts) {
  if (starts.size() == 1) return starts[0];
  std::vector<double> means;
  for (const auto& s : starts) means.push_back(s.mean);
  return estimate_of(means);
}

double middle_of(std::vector<double>& values) {
  std::ranges::sort(values);
  const auto n = values.size();
  return n % 2 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
}

Estimate median_of(std::vector<double> values) {
  if (values.empty()) return {NAN, {}};
  const double median = middle_of(values);
  if (values.size() == 1) return {median, {}};
  for (double& v : values) v = std::abs(v - median);
  return {median, 1.2533 * 1.4826 * middle_of(values) / std::sqrt(static_cast<double>(values.size()))};
}

}  // namespace

Tally tally(std::span<const measure::Flow> starts) {
  Tally made;
  made.starts = starts.size();
  std::vector<Estimate> v_x, omega, kinetic;
  std::vector<double> moving;
  for (const auto& start : starts) {
    ++made.of[static_cast<std::size_t>(start.verdict)];
    if (start.verdict != Verdict::stopped) moving.push_back(start.v_x.mean);
    if (start.verdict != Verdict::steady) continue;
    v_x.push_back(start.v_x);
    omega.push_back(start.omega);
    kinetic.push_back(start.kinetic);
  }
  made.v_x = mean_over(v_x);
  made.omega = mean_over(omega);
  made.kinetic = mean_over(kinetic);
  made.median = median_of(std::move(moving));
  for (const auto& start : starts) {
    const bool settled = start.verdict == Verdict::steady || start.verdict == Verdict::unsettled;
    made.together +=
        settled && std::abs(start.v_x.mean - made.median.mean) <= 0.1 * std::abs(made.median.mean);
  }
  return made;
}

Phase phase_of(std::span<const Tally> launches, double alike) {
  std::size_t stopped = 0, starts = 0;
  for (const auto& launch : launches) stopped += launch.count(Verdict::stopped), starts += launch.starts;
  if (2 * stopped >= starts) return Phase::A;
  const auto& slow = launches.front();
  if (2 * (slow.count(Verdict::accelerating) + slow.count(Verdict::runaway)) > slow.starts) return Phase::C;
  const bool same = std::ranges::all_of(launches, [&](const Tally& launch) {
    return std::abs(launch.median.mean - slow.median.mean) <= alike * std::abs(slow.median.mean);
  });
  return same ? Phase::B : Phase::C;
}

namespace {

/// Narrows [low, high] around the place where `beyond` becomes true.
Estimate bisect(double low, double high, double tolerance, const std::function<bool(double)>& beyond) {
  while (high - low > tolerance) {
    const double middle = std::midpoint(low, high);
    if (middle <= low || middle >= high) break;  // as fine as numbers are
    (beyond(middle) ? high : low) = middle;
  }
  return {std::midpoint(low, high), (high - low) / 2};
}

}  // namespace

Boundaries find_boundaries(std::span<const double> values, double tolerance, Wanted wanted,
                           const std::function<Phase(double)>& phase_at) {
  Boundaries found;
  std::optional<Phase> before;
  const auto complete = [&] { return wanted == Wanted::AB ? found.AB.has_value() : found.BC.has_value(); };
  for (std::size_t i = 0; i < values.size() && !complete(); ++i) {
    const auto now = phase_at(values[i]);
    if (before == Phase::A && now != Phase::A && !found.AB)
      found.AB =
          bisect(values[i - 1], values[i], tolerance, [&](double x) { return phase_at(x) != Phase::A; });
    if (wanted == Wanted::both && before && before != Phase::C && now == Phase::C)
      found.BC =
          bisect(values[i - 1], values[i], tolerance, [&](double x) { return phase_at(x) == Phase::C; });
    before = now;
  }
  return found;
}

}  // namespace chute::sweep
