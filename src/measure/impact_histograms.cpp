#include "measure/impact_histograms.hpp"

#include <numbers>

namespace chute::measure {
ImpactHistograms::ImpactHistograms(const HistogramBins& bins, const Window& window)
    : bins_(bins), blocks_(window) {}

void ImpactHistograms::add(std::span<const Impact> impacts, std::size_t moving) {
  for (const auto& impact : impacts) {
    if (!std::isfinite(impact.gamma) || !std::isfinite(impact.v_n))
      continue;  // not a number belongs to no bin
    auto& sums = blocks_.sample(impact.time);
    sums.resize(bins_.angles + bins_.velocities + 1);
    const auto kind =
        static_cast<std::size_t>(is_wall(impact.bead) || impact.bead >= static_cast<std::int64_t>(moving));
    const double speed = std::abs(impact.v_n),
                 angle = impact.gamma - std::numbers::pi * std::floor(impact.gamma / std::numbers::pi);
    const auto count = [&](std::size_t bin) {
      sums[bin].count[kind] += 1;
      sums[bin].v_n[kind] += speed;
    };
    count(std::min(bins_.angles - 1,
                   static_cast<std::size_t>(angle / std::numbers::pi * static_cast<double>(bins_.angles))));
    if (speed < bins_.fastest)
      count(bins_.angles +
            static_cast<std::size_t>(speed / bins_.fastest * static_cast<double>(bins_.velocities)));
    count(bins_.angles + bins_.velocities);
  }
}

std::vector<HistogramRow> ImpactHistograms::result(double start) const {
  const auto stretches = blocks_.stretches(start);
  std::vector<HistogramRow> rows;
  if (stretches.empty()) return rows;
  // For the density of a bin, all impacts have to be beside it.
  struct Share {
    double here = 0, all = 0, v_n = 0;
    Share& operator+=(const Share& o) {
      here += o.here, all += o.all, v_n += o.v_n;
      return *this;
    }
  };
  const auto add = [&](std::string_view pair, auto&& kinds, std::string_view quantity) {
    const bool velocity = quantity == "v_n", mean = quantity == "v_n of gamma";
    const std::size_t first = velocity ? bins_.angles : 0, count = velocity ? bins_.velocities : bins_.angles;
    const double width = (velocity ? bins_.fastest : std::numbers::pi) / static_cast<double>(count);
    for (std::size_t b = 0; b < count; ++b) {
      std::vector<Blocks<Share>::Part> shares;
      for (const auto& stretch : stretches) {
        Share share;
        for (const std::size_t kind : kinds)
          share += {stretch.bins[first + b].count[kind], stretch.bins.back().count[kind],
                    stretch.bins[first + b].v_n[kind]};
        shares.push_back({stretch.samples, {share}});
      }
      const auto value = [&](const Share& s, double) {
        return mean ? s.v_n / s.here : s.here / (s.all * width);
      };
      rows.push_back(
          {pair, quantity, (static_cast<double>(b) + 0.5) * width, estimate_bin<Share>(shares, 0, value)});
    }
  };
  for (const auto quantity : {"gamma", "v_n", "v_n of gamma"}) {
    add("grain", std::array<std::size_t, 1>{0}, quantity);
    add("bed", std::array<std::size_t, 1>{1}, quantity);
    add("all", std::array<std::size_t, 2>{0, 1}, quantity);
  }
  return rows;
}

}  // namespace chute::measure
