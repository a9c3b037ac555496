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

/// Standard error of a mean from the scatter of its values over blocks; none from a single block.
std::optional<double> block_error(const std::vector<double>& values) {
  if (values.size() < 2) return {};
  const auto n = static_cast<double>(values.size());
  double mean = 0, square = 0;
  for (double v : values) mean += v / n;
  for (double v : values) square += (v - mean) * (v - mean);
  return std::sqrt(square / (n - 1) / n);
}

}  // namespace

Profiles::Profiles(double length, double bin, double from, double until, std::size_t blocks)
    : length_(length), bin_(bin), from_(from), until_(until), samples_(blocks), sums_(blocks) {}

void Profiles::sample(const GrainsView& grains) {
  const double part = until_ > from_ ? (grains.time - from_) / (until_ - from_) : 0;  // 0/0 is no block
  const auto blocks = static_cast<double>(samples_.size());
  const auto block = static_cast<std::size_t>(std::clamp(part * blocks, 0.0, blocks - 1));
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

/// What the sums of some samples say about a bin of the given area.
struct Profiles::Means {
  double eta, exact, v_x, v_y, sigma_x, sigma_y, omega;

  Means(const Sums& s, double samples, double bin_area)
      : eta(s.area / (samples * bin_area)),
        exact(s.exact / (samples * bin_area)),
        v_x(s.v_x / s.count),
        v_y(s.v_y / s.count),
        sigma_x(std::sqrt(std::max(0.0, s.v_x2 / s.count - v_x * v_x))),
        sigma_y(std::sqrt(std::max(0.0, s.v_y2 / s.count - v_y * v_y))),
        omega(s.omega / s.count) {}
};

/// The blocks that count, those with samples that begin at `start` or later.
std::vector<std::size_t> Profiles::blocks_from(double start) const {
  std::vector<std::size_t> counting;
  const double width = (until_ - from_) / static_cast<double>(samples_.size());
  for (std::size_t block = samples_.size(); block-- > 0;) {
    const bool late = from_ + static_cast<double>(block) * width >= start - 1e-9 * width;
    if (samples_[block] > 0 && (late || counting.empty())) counting.insert(counting.begin(), block);
  }
  return counting;
}

std::vector<ProfileBin> Profiles::result(double start) const {
  constexpr std::size_t stretches = 10;
  const auto counting = blocks_from(start);
  std::size_t highest = 0;
  for (const auto block : counting) highest = std::max(highest, sums_[block].size());
  std::vector<ProfileBin> profile;
  for (std::size_t b = 0; b < highest; ++b) {
    Sums total, stretch;
    double samples = 0, stretch_samples = 0;
    std::vector<Means> blocks_means;
    for (std::size_t k = 0; k < counting.size(); ++k) {
      const auto& bins = sums_[counting[k]];
      if (b < bins.size()) stretch += bins[b];
      stretch_samples += static_cast<double>(samples_[counting[k]]);
      // With many blocks, several make a stretch.
      if (counting.size() > stretches && k + 1 < counting.size() &&
          (k + 1) * stretches / counting.size() == k * stretches / counting.size())
        continue;
      blocks_means.emplace_back(stretch, stretch_samples, length_ * bin_);
      total += stretch;
      samples += stretch_samples;
      stretch = {};
      stretch_samples = 0;
    }
    // The mean is that of the whole window, so that σ counts slow changes of the flow too; stretches only
    // give the error.
    const Means mean(total, samples, length_ * bin_);
    const auto estimate = [&](double Means::*member) {
      std::vector<double> values;
      for (const auto& m : blocks_means)
        if (std::isfinite(m.*member)) values.push_back(m.*member);
      return Estimate{mean.*member, block_error(values)};
    };
    profile.push_back({(static_cast<double>(b) + 0.5) * bin_,
                       total.count / samples,
                       estimate(&Means::eta),
                       estimate(&Means::exact),
                       estimate(&Means::v_x),
                       estimate(&Means::v_y),
                       estimate(&Means::sigma_x),
                       estimate(&Means::sigma_y),
                       estimate(&Means::omega),
                       {NAN, {}}});
  }
  for (std::size_t b = 1; b + 1 < profile.size(); ++b) {
    const auto &below = profile[b - 1].v_x, &above = profile[b + 1].v_x;
    Estimate& shear = profile[b].half_shear;
    shear.mean = (above.mean - below.mean) / (4 * bin_);
    if (above.error && below.error) shear.error = std::hypot(*above.error, *below.error) / (4 * bin_);
  }
  return profile;
}

}  // namespace chute::measure
