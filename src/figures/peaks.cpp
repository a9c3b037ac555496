#include "figures/peaks.hpp"

#include <algorithm>
#include <cmath>

namespace chute::figures {
namespace {

constexpr double valley = 0.5;        ///< of the lower peak's density; a higher valley divides nothing
constexpr double least_share = 0.01;  ///< of all values, for a peak

/// Density on a grid of a quarter bandwidth, in counts per cell: far finer than the kernel.
struct Density {
  double low = 0, cell = 0;
  std::vector<double> at;
};

Density density_of(std::span<const double> values, double bandwidth) {
  constexpr int per_bandwidth = 4, reach = 4 * per_bandwidth;  // the kernel ends at 4 bandwidths
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  Density density;
  density.cell = bandwidth / per_bandwidth;
  density.low = *least - (reach + 0.5) * density.cell;
  const auto cells = static_cast<std::size_t>((*most - density.low) / density.cell) + reach + 2;
  std::vector<double> counts(cells);
  for (const double v : values) counts[static_cast<std::size_t>((v - density.low) / density.cell)] += 1;
  density.at.assign(cells, 0);
  for (std::size_t i = 0; i < cells; ++i) {
    if (counts[i] == 0) continue;
    const std::size_t from = i < reach ? 0 : i - reach, to = std::min(cells - 1, i + reach);
    for (std::size_t k = from; k <= to; ++k) {
      const double off = (static_cast<double>(k) - static_cast<double>(i)) / per_bandwidth;
      density.at[k] += counts[i] * std::exp(-off * off / 2);
    }
  }
  return density;
}

/// A maximum of the density and the valley after it, as cells.
struct Hill {
  std::size_t top, valley_after;
};

std::vector<Hill> hills_of(const std::vector<double>& density) {
  std::vector<Hill> hills;
  bool rising = true;
  std::size_t turn = 0;  // the highest or lowest cell since the last turn
  for (std::size_t k = 1; k < density.size(); ++k) {
    if (rising ? density[k] < density[turn] : density[k] > density[turn]) {
      if (rising)
        hills.push_back({turn, density.size() - 1});
      else
        hills.back().valley_after = turn;
      rising = !rising;
      turn = k;
    } else if (density[k] != density[turn]) {
      turn = k;
    }
  }
  return hills;
}

/// Joins neighbours, the shallowest valley first, until every valley divides.
void join_shallow(std::vector<Hill>& hills, const std::vector<double>& density) {
  while (hills.size() > 1) {
    std::size_t shallowest = 0;
    double highest = 0;
    for (std::size_t k = 0; k + 1 < hills.size(); ++k) {
      const double lower = std::min(density[hills[k].top], density[hills[k + 1].top]);
      const double ratio = density[hills[k].valley_after] / lower;
      if (ratio > highest) highest = ratio, shallowest = k;
    }
    if (highest <= valley) return;
    auto& left = hills[shallowest];
    const auto& right = hills[shallowest + 1];
    if (density[right.top] > density[left.top]) left.top = right.top;
    left.valley_after = right.valley_after;
    hills.erase(hills.begin() + static_cast<std::ptrdiff_t>(shallowest) + 1);
  }
}

}  // namespace

std::vector<Peak> find_peaks(std::span<const double> values, double bandwidth) {
  if (values.empty()) return {};
  std::vector<double> sorted;
  for (const double v : values)
    if (std::isfinite(v)) sorted.push_back(v);  // a first flight is not known
  if (sorted.empty()) return {};
  std::sort(sorted.begin(), sorted.end());
  const Density density = density_of(sorted, bandwidth);
  auto hills = hills_of(density.at);
  join_shallow(hills, density.at);
  std::vector<Peak> peaks;
  auto from = sorted.begin();
  for (const Hill& hill : hills) {
    const double end = density.low + (static_cast<double>(hill.valley_after) + 0.5) * density.cell;
    const auto to = &hill == &hills.back() ? sorted.end() : std::lower_bound(from, sorted.end(), end);
    const auto count = static_cast<double>(to - from);
    double mean = 0, square = 0;
    for (auto v = from; v != to; ++v) mean += *v / count;
    for (auto v = from; v != to; ++v) square += (*v - mean) * (*v - mean) / count;
    const double share = count / static_cast<double>(sorted.size());
    if (share >= least_share) peaks.push_back({mean, std::sqrt(square), share});
    from = to;
  }
  return peaks;
}

}  // namespace chute::figures
