#include "measure/profiles.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace chute::measure {
namespace {

/// Area of a disc of radius R below a horizontal line at `y` above its centre.
double area_below(double y, double R) {
  if (y <= -R) return 0;
  if (y >= R) return std::numbers::pi * R * R;
  return R * R * (std::asin(y / R) + std::numbers::pi / 2) + y * std::sqrt(R * R - y * y);
}

/// Mean over blocks and its standard error; no error from a single block.
Estimate over_blocks(const std::vector<double>& values) {
  if (values.empty()) return {0, {}};
  const auto n = static_cast<double>(values.size());
  double mean = 0, square = 0;
  for (double v : values) mean += v / n;
  for (double v : values) square += (v - mean) * (v - mean);
  if (values.size() < 2) return {mean, {}};
  return {mean, std::sqrt(square / (n - 1) / n)};
}

}  // namespace

Profiles::Profiles(double length, double bin, double from, double until)
    : length_(length), bin_(bin), from_(from), until_(until) {}

void Profiles::sample(const GrainsView& grains) {
  const double part = (grains.time - from_) / (until_ - from_);
  const auto block = static_cast<std::size_t>(std::clamp(part * blocks, 0.0, blocks - 1.0));
  auto& bins = sums_[block];
  ++samples_[block];
  for (std::size_t i = 0; i < grains.moving; ++i) {
    const double h = grains.position[1][i], R = grains.radius[i];
    const auto top = static_cast<std::int64_t>(std::floor((h + R) / bin_));
    if (top < 0) continue;
    if (static_cast<std::size_t>(top) >= bins.size()) bins.resize(static_cast<std::size_t>(top) + 1);
    const auto bottom = std::max<std::int64_t>(0, static_cast<std::int64_t>(std::floor((h - R) / bin_)));
    for (auto b = bottom; b <= top; ++b) {
      const double edge = static_cast<double>(b) * bin_ - h;
      bins[static_cast<std::size_t>(b)].exact += area_below(edge + bin_, R) - area_below(edge, R);
    }
    const auto centre = static_cast<std::int64_t>(std::floor(h / bin_));
    if (centre < 0) continue;
    Sums& s = bins[static_cast<std::size_t>(centre)];
    const double vx = grains.velocity[0][i], vy = grains.velocity[1][i];
    s.count += 1;
    s.area += std::numbers::pi * R * R;
    s.v_x += vx;
    s.v_y += vy;
    s.v_x2 += vx * vx;
    s.v_y2 += vy * vy;
    s.omega -= grains.spin[0][i];
  }
}

std::vector<ProfileBin> Profiles::result() const {
  std::size_t highest = 0;
  for (const auto& bins : sums_) highest = std::max(highest, bins.size());
  std::vector<ProfileBin> profile;
  for (std::size_t b = 0; b < highest; ++b) {
    std::vector<double> eta, exact, v_x, v_y, sigma_x, sigma_y, omega;
    double count = 0, samples = 0;
    for (std::size_t block = 0; block < blocks; ++block) {
      if (samples_[block] == 0) continue;
      const auto n = static_cast<double>(samples_[block]);
      const Sums s = b < sums_[block].size() ? sums_[block][b] : Sums{};
      count += s.count;
      samples += n;
      eta.push_back(s.area / (n * length_ * bin_));
      exact.push_back(s.exact / (n * length_ * bin_));
      if (s.count == 0) continue;
      const double mean_x = s.v_x / s.count, mean_y = s.v_y / s.count;
      v_x.push_back(mean_x);
      v_y.push_back(mean_y);
      sigma_x.push_back(std::sqrt(std::max(0.0, s.v_x2 / s.count - mean_x * mean_x)));
      sigma_y.push_back(std::sqrt(std::max(0.0, s.v_y2 / s.count - mean_y * mean_y)));
      omega.push_back(s.omega / s.count);
    }
    if (samples == 0) return {};
    profile.push_back({(static_cast<double>(b) + 0.5) * bin_, count / samples, over_blocks(eta),
                       over_blocks(exact), over_blocks(v_x), over_blocks(v_y), over_blocks(sigma_x),
                       over_blocks(sigma_y), over_blocks(omega)});
  }
  return profile;
}

}  // namespace chute::measure
