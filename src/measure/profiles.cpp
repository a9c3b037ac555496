#include "measure/profiles.hpp"

#include <numbers>

namespace chute::measure {
namespace {

/// Area of a disc of radius R below a horizontal line at `y` above its centre.
double area_below(double y, double R) {
  if (y <= -R) return 0;
  if (y >= R) return std::numbers::pi * R * R;
  return R * R * (std::asin(y / R) + std::numbers::pi / 2) + y * std::sqrt(R * R - y * y);
}

}  // namespace

Profiles::Profiles(double length, double bin, const Window& window)
    : length_(length), bin_(bin), blocks_(window) {}

Profiles::Sums& Profiles::bin_at(std::vector<Sums>& bins, std::int64_t b) const {
  const auto index = static_cast<std::size_t>(b);
  if (index >= bins.size()) bins.resize(index + 1);
  return bins[index];
}

void Profiles::sample(const GrainsView& grains, std::span<const ContactRecord> contacts) {
  auto& bins = blocks_.sample(grains.time);
  for (std::size_t i = 0; i < grains.moving; ++i) {
    const double h = grains.position[1][i], R = grains.radius[i];
    const auto top = static_cast<std::int64_t>(std::floor((h + R) / bin_));
    if (top < 0) continue;
    const auto bottom = std::max<std::int64_t>(0, static_cast<std::int64_t>(std::floor((h - R) / bin_)));
    for (auto b = top; b >= bottom; --b) {
      const double edge = static_cast<double>(b) * bin_ - h;
      bin_at(bins, b).exact += area_below(edge + bin_, R) - area_below(edge, R);
    }
    const auto centre = static_cast<std::int64_t>(std::floor(h / bin_));
    if (centre < 0) continue;
    Sums& s = bin_at(bins, centre);
    const double vx = grains.velocity[0][i], vy = grains.velocity[1][i];
    s.count += 1;
    s.area += std::numbers::pi * R * R;
    s.v_x += vx;
    s.v_y += vy;
    s.v_x2 += vx * vx;
    s.v_y2 += vy * vy;
    s.omega -= grains.spin[0][i];
    s.layer.add_grain(grains.mass[i], vx, vy);
  }
  for (const auto& contact : contacts) add_contact(bins, contact, grains);
}

void Profiles::add_contact(std::vector<Sums>& bins, const ContactRecord& contact,
                           const GrainsView& grains) const {
  for (const auto id : {contact.i, contact.j}) {
    const auto grain = static_cast<std::size_t>(id);
    if (grain >= grains.moving || grains.position[1][grain] < 0) continue;
    bin_at(bins, static_cast<std::int64_t>(std::floor(grains.position[1][grain] / bin_))).touches += 1;
  }
  const Branch branch = branch_of(contact, grains);
  const double low = std::min(branch.h_i, branch.h_i + branch.way[1]), high = low + std::abs(branch.way[1]);
  const auto first = static_cast<std::int64_t>(std::floor(low / bin_)),
             last = static_cast<std::int64_t>(std::floor(high / bin_));
  for (auto b = std::max<std::int64_t>(0, first); b <= last; ++b) {
    const double edge = static_cast<double>(b) * bin_;
    const double inside = std::min(high, edge + bin_) - std::max(low, edge);
    const auto stress = branch.stress(high > low ? inside / (high - low) : 1);
    auto& sums = bin_at(bins, b).layer.contact;
    for (std::size_t k = 0; k < 3; ++k) sums[k] += stress[k];
  }
}

std::vector<ProfileBin> Profiles::result(double start) const {
  const auto stretches = blocks_.stretches(start);
  std::vector<ProfileBin> profile;
  if (stretches.empty()) return profile;
  const double area = length_ * bin_;
  for (std::size_t b = 0; b < stretches[0].bins.size(); ++b) {
    const auto estimate = [&](auto&& mean_of) { return estimate_bin<Sums>(stretches, b, mean_of); };
    const auto per_area = [&](double Sums::*sum) {
      return estimate([&](const Sums& s, double samples) { return s.*sum / (samples * area); });
    };
    const auto per_grain = [&](double Sums::*sum) {
      return estimate([&](const Sums& s, double) { return s.*sum / s.count; });
    };
    const auto fluctuation = [&](double Sums::*square, double Sums::*sum) {
      return estimate([&](const Sums& s, double) {
        const double mean = s.*sum / s.count;
        return std::sqrt(std::max(0.0, s.*square / s.count - mean * mean));
      });
    };
    const auto kinetic = [&](std::size_t k) {
      return estimate([&](const Sums& s, double samples) { return s.layer.kinetic()[k] / (samples * area); });
    };
    const auto contact = [&](std::size_t k) {
      return estimate([&](const Sums& s, double samples) { return s.layer.contact[k] / (samples * area); });
    };
    ProfileBin bin{};
    bin.h = (static_cast<double>(b) + 0.5) * bin_;
    bin.grains = estimate([](const Sums& s, double samples) { return s.count / samples; }).mean;
    bin.eta = per_area(&Sums::area);
    bin.eta_exact = per_area(&Sums::exact);
    bin.v_x = per_grain(&Sums::v_x);
    bin.v_y = per_grain(&Sums::v_y);
    bin.sigma_x = fluctuation(&Sums::v_x2, &Sums::v_x);
    bin.sigma_y = fluctuation(&Sums::v_y2, &Sums::v_y);
    bin.omega = per_grain(&Sums::omega);
    bin.half_shear = {NAN, {}};
    bin.kinetic_xx = kinetic(0), bin.kinetic_xy = kinetic(1), bin.kinetic_yy = kinetic(2);
    bin.contact_xx = contact(0), bin.contact_xy = contact(1), bin.contact_yy = contact(2);
    bin.coordination = per_grain(&Sums::touches);
    profile.push_back(bin);
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
