#include "measure/profiles.hpp"

#include <numbers>

namespace chute::measure {
namespace {

using std::numbers::pi;

/// Area of a disc of radius R below a horizontal line at `y` above its centre; volume of a sphere below a plane.
double below(double y, double R, int dimensions) {
  const double t = std::clamp(y, -R, R);
  if (dimensions == 3) return pi * (R + t) * (R + t) * (2 * R - t) / 3;
  return R * R * (std::asin(t / R) + pi / 2) + t * std::sqrt(R * R - t * t);
}

/// A variance without what rounding takes it below 0. That of grains whose velocities are not known is not known either;
/// that of no grains is 0.
double variance_of(double value, double count) {
  return count > 0 && std::isnan(value) ? value : std::max(0.0, value);
}

}  // namespace

Profiles::Profiles(const Frame& frame, double bin, const Window& window)
    : frame_(frame), bin_(bin), blocks_(window) {}

/// The bin at a height; null below the bed, and above all bins that are kept.
Profiles::Sums* Profiles::bin_at(std::vector<Sums>& bins, double height) const {
  const double b = std::floor(height / bin_);
  if (!(b >= 0 && b < most_layers)) return nullptr;
  const auto index = static_cast<std::size_t>(b);
  if (index >= bins.size()) bins.resize(index + 1);
  return &bins[index];
}

void Profiles::sample(const GrainsView& grains, std::span<const Contact> touching,
                      std::span<const Contact> forces) {
  auto& bins = blocks_.sample(grains.time);
  const auto normal = frame_.normal();
  const int D = frame_.dimensions;
  for (std::size_t i = 0; i < grains.moving; ++i) {
    const double h = grains.position[normal][i], R = grains.radius[i];
    for (double b = std::max(0.0, std::floor((h - R) / bin_)), top = std::floor((h + R) / bin_);
         b <= top && b < most_layers; ++b)
      if (Sums* s = bin_at(bins, (b + 0.5) * bin_))
        s->exact += below((b + 1) * bin_ - h, R, D) - below(b * bin_ - h, R, D);
    Sums* s = bin_at(bins, h);
    if (!s) {
      beyond_ += h > 0;
      continue;
    }
    const auto v = velocity_of(grains, i);
    s->count += 1;
    s->area += below(R, R, D);
    for (std::size_t k = 0; k < 3; ++k) s->v[k] += v[k], s->v2[k] += v[k] * v[k];
    s->omega += frame_.rolling_sign() * grains.spin[frame_.rolling_axis()][i];
    s->layer.add_grain(grains.mass[i], v);
  }
  for (const auto& contact : touching)
    for (const auto id : {contact.a, contact.b})
      if (!is_wall(id) && static_cast<std::size_t>(id) < grains.moving)
        if (Sums* s = bin_at(bins, grains.position[normal][static_cast<std::size_t>(id)])) s->touches += 1;
  for (const auto& contact : forces) add_contact(bins, contact, grains);
}

void Profiles::add_contact(std::vector<Sums>& bins, const Contact& contact, const GrainsView& grains) const {
  const double begin = begin_of(contact, grains, frame_.normal()), way = contact.branch[frame_.normal()];
  const double low = std::min(begin, begin + way), high = low + std::abs(way);
  for (double b = std::max(0.0, std::floor(low / bin_)), last = std::floor(high / bin_);
       b <= last && b < most_layers; ++b) {
    const double edge = b * bin_, inside = std::min(high, edge + bin_) - std::max(low, edge);
    if (Sums* s = bin_at(bins, edge + 0.5 * bin_))
      s->layer.add_contact(contact, high > low ? inside / (high - low) : 1);
  }
}

std::vector<ProfileBin> Profiles::result(double start) const {
  const auto stretches = blocks_.stretches(start);
  std::vector<ProfileBin> profile;
  if (stretches.empty()) return profile;
  const double area = frame_.footprint * bin_;
  for (std::size_t b = 0; b < stretches[0].bins.size(); ++b) {
    const auto estimate = [&](auto&& mean_of) { return estimate_bin<Sums>(stretches, b, mean_of); };
    const auto per_area = [&](auto&& sum) {
      return estimate([&](const Sums& s, double samples) { return sum(s) / (samples * area); });
    };
    const auto per_grain = [&](auto&& sum) {
      return estimate([&](const Sums& s, double) { return sum(s) / s.count; });
    };
    ProfileBin bin{};
    bin.h = (static_cast<double>(b) + 0.5) * bin_;
    bin.grains = estimate([](const Sums& s, double samples) { return s.count / samples; }).mean;
    bin.eta = per_area([](const Sums& s) { return s.area; });
    bin.eta_exact = per_area([](const Sums& s) { return s.exact; });
    for (std::size_t k = 0; k < 3; ++k) {
      bin.v[k] = per_grain([k](const Sums& s) { return s.v[k]; });
      bin.sigma[k] = estimate([k](const Sums& s, double) {
        const double mean = s.v[k] / s.count;
        return std::sqrt(variance_of(s.v2[k] / s.count - mean * mean, s.count));
      });
    }
    bin.temperature = estimate([&](const Sums& s, double) {
      double sum = 0;
      for (std::size_t k = 0; k < 3; ++k) sum += s.v2[k] / s.count - (s.v[k] / s.count) * (s.v[k] / s.count);
      return variance_of(sum, s.count) / frame_.dimensions;
    });
    bin.omega = per_grain([](const Sums& s) { return s.omega; });
    for (std::size_t t = 0; t < 6; ++t) {
      bin.kinetic[t] = per_area([t](const Sums& s) { return s.layer.kinetic(t); });
      bin.contact[t] = per_area([t](const Sums& s) { return s.layer.contact[t]; });
    }
    bin.coordination = per_grain([](const Sums& s) { return s.touches; });
    profile.push_back(bin);
  }
  for (std::size_t b = 1; b + 1 < profile.size(); ++b) {
    const auto &under = profile[b - 1].v[0], &above = profile[b + 1].v[0];
    Estimate& shear = profile[b].half_shear;
    shear.mean = (above.mean - under.mean) / (4 * bin_);
    if (above.error && under.error) shear.error = std::hypot(*above.error, *under.error) / (4 * bin_);
  }
  return profile;
}

}  // namespace chute::measure
