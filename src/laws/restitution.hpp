#pragma once
#include <algorithm>
#include <cmath>
#include <variant>

namespace chute::laws {

/// The same e_n whatever the velocity.
struct ConstantRestitution {
  double e_n = 1;
  double operator()(double) const { return e_n; }
};

/// e_n(v) = 1 − a (v/v_0)^δ, thesis 2.1.3, kept at 0 where it would fall below. δ = 1/5 is what viscoelastic
/// spheres do (3.6) as e_n → 1; slow collisions are then nearly elastic, which avoids inelastic collapse
/// where nothing pushes the grains together (under gravity bounces still add up to a finite time: see
/// tests/event).
struct PowerLawRestitution {
  double loss = 0;        ///< a = 1 − e_n at v_0
  double velocity = 1;    ///< v_0 > 0
  double exponent = 0.2;  ///< δ
  double operator()(double v) const {
    return std::max(0.0, 1 - loss * std::pow(std::abs(v) / velocity, exponent));
  }
};

/// e_n(v) = (1 + v/v_0)^{-1/2}: plastic deformation (3.8), with v_0 = √(k_1/m_eff) / s.
struct HardeningRestitution {
  double velocity = 1;  ///< v_0 > 0
  double operator()(double v) const { return 1 / std::sqrt(1 + std::abs(v) / velocity); }
};

using Restitution = std::variant<ConstantRestitution, PowerLawRestitution, HardeningRestitution>;

inline double restitution_at(const Restitution& law, double v_n) {
  return std::visit([&](const auto& e) { return e(v_n); }, law);
}

/// Contact-time cut-off, thesis 2.1.3: a collision of a grain that collided less than t_c ago loses no normal
/// energy, e_n = 1. Real contacts last; grains that hit each other faster than that are in contact, and a
/// contact at rest dissipates nothing. It keeps the event-driven method out of inelastic collapse. t_c = 0 is
/// no cut-off.
struct ContactTimeCutoff {
  double contact_time = 0;  ///< t_c

  /// `since_i`, `since_j`: times since the last collision of each grain; infinite if there was none.
  double operator()(double e_n, double since_i, double since_j) const {
    return std::min(since_i, since_j) < contact_time ? 1.0 : e_n;
  }
};

}  // namespace chute::laws
