#include "theory/rolling.hpp"

#include <fmt/format.h>

#include <boost/math/special_functions/ellint_rf.hpp>
#include <cmath>
#include <numbers>

#include "common/error.hpp"

namespace chute::theory {
namespace {

/// c = sin²γ_max, after a look at the input.
double sin_squared(const Line& line) {
  const double ratio = (1 + line.gap) / (1 + line.size_ratio);
  if (!(line.size_ratio > 0 && line.radius > 0 && line.gap >= 0 && line.gravity >= 0 && line.inertia >= 0 &&
        ratio <= 1))
    throw WorkError(fmt::format(
        "no ball of size ratio {} and bead radius {} rolls on a line with gap {} under gravity {}",
        line.size_ratio, line.radius, line.gap, line.gravity));
  return ratio * ratio;
}

/// γ̇²(γ_max) in units of 2 (m/m_eff) g/(R+r) sin θ: what gravity gives on the way over a bead is what the
/// impact takes:
///   2 sin γ_max sin θ = (1 − e_t²) γ̇²(γ_max),   in general; with (4.44) it is (4.45).
double speed_squared(const Line& line, Version version) {
  const double e_t = impact_ratio(line, version);
  return 2 * std::sqrt(sin_squared(line)) / (1 - e_t * e_t);
}

/// ∫ dγ/√(b − cos γ) from `from` to `to`, (4.49). With u = γ/2 and b − cos γ = (b − 1) + 2 sin²u it is
/// Carlson's R_F, which needs no case for the modulus. From 0 if b > 1; else the range holds no 0, and γ is
/// counted from π: b − cos γ = (b + 1) − 2 cos²u.
double passage_integral(double b, double from, double to) {
  using boost::math::ellint_rf;
  const auto from_top = [&](double gamma) {
    const double s = std::sin(gamma / 2), c = std::cos(gamma / 2);
    return 2 * s * ellint_rf((b - 1) * c * c, b - 1 + 2 * s * s, b - 1);
  };
  const auto from_bottom = [&](double gamma) {
    const double s = std::sin(gamma / 2), c = std::cos(gamma / 2);
    return -2 * c * ellint_rf((b + 1) * s * s, b + 1 - 2 * c * c, b + 1);
  };
  return b > 1 ? from_top(to) - from_top(from) : from_bottom(to) - from_bottom(from);
}

}  // namespace

double largest_angle(const Line& line) { return std::asin(std::sqrt(sin_squared(line))); }

double impact_ratio(const Line& line, Version version) {
  const double c = sin_squared(line), m_eff = line.effective_mass();
  if (version == Version::printed) return std::sqrt(std::max(0.0, 1 - 4 * c * (1 - c) / m_eff));
  return (1 - 2 * c + line.inertia) / m_eff;  // cos 2γ = 1 − 2 sin²γ
}

std::optional<Passage> steady_passage(const Line& line, double theta, Version version) {
  const double gamma_max = largest_angle(line), e_t = impact_ratio(line, version), g = line.gravity;
  if (!(theta > 0 && theta < std::numbers::pi / 2) || e_t <= 0 || g == 0) return {};
  const double squared = speed_squared(line, version) * std::sin(theta);
  const double b = squared + std::cos(theta + gamma_max);  // (4.51)
  if (theta <= gamma_max && b <= 1) return {};             // it does not reach the top at γ = −θ
  const double rate = 2 / line.effective_mass() * g / line.centres();
  const double a = 1 / std::sqrt(rate);  // (4.50)
  Passage passage{};
  passage.gamma_max = gamma_max;
  passage.v_before = line.centres() * std::sqrt(rate * squared);                     // (4.45)
  passage.v_after = e_t * passage.v_before;                                          // (4.43)
  passage.duration = a * passage_integral(b, theta - gamma_max, theta + gamma_max);  // (4.49)
  const double way = 2 * line.centres() * (version == Version::printed ? gamma_max : std::sin(gamma_max));
  passage.mean_velocity = way / passage.duration;  // (4.47)
  passage.least_contact =
      std::cos(theta + gamma_max) - passage.v_before * passage.v_before / (line.centres() * g);
  return passage;
}

double linear_velocity(const Line& line, double theta, Version version) {
  const double c = sin_squared(line), m_eff = line.effective_mass();
  // printed: b − cos θ = sin θ (m_eff/2m)(1 + c)/√c − sin θ √c, (4.53). Corrected: 1 − e_t² = 4c(m_eff/m −
  // c)(m/m_eff)² gives (1 + c m/m_eff) for (1 + c), and the way (sin γ/γ)² ≈ 1 − c/3.
  const double bracket = version == Version::printed ? 1 / c + 1 - 2 / m_eff : 1 / c - 1.0 / 3 - 1 / m_eff;
  return std::sqrt(line.radius * (1 + line.gap) * line.gravity * bracket * std::sin(theta));
}

double boundary_ab(const Line& line, double gap_max, Version version) {
  if (gap_max < line.gap)
    throw WorkError(fmt::format("the largest gap {} is below the mean gap {}", gap_max, line.gap));
  Line widest = line;
  widest.gap = gap_max;
  const double c = sin_squared(widest), c_mean = sin_squared(line);
  const double e_m = impact_ratio(widest, version), e_m_squared = e_m * e_m;
  const double a = e_m_squared * (speed_squared(line, version) + std::sqrt(c) - std::sqrt(c_mean)) +
                   std::sqrt(c);                                                                 // (4.60)
  const double b = e_m_squared * (std::sqrt(1 - c_mean) - std::sqrt(1 - c)) + std::sqrt(1 - c);  // (4.61)
  return std::asin(1 / std::hypot(a, b)) - std::atan(b / a);                                     // (4.62)
}

double lift_off_angle(const Line& line, Version version) {
  // cos(θ + γ_max) = v²/((R+r)g), with v² = (R+r)g (2m/m_eff) s sin θ: one tangent.
  const double gamma_max = largest_angle(line);
  const double s = 2 / line.effective_mass() * speed_squared(line, version);
  return std::atan2(std::cos(gamma_max), s + std::sin(gamma_max));
}

}  // namespace chute::theory
