#pragma once
#include <numbers>

#include "engines/soft/soft_engine.hpp"

/// A few grains by hand, for tests that know the answer.
namespace chute::test {

inline constexpr double pi = std::numbers::pi;

/// The thesis's acetate spheres (3.1): two of them have e_n = 0.87.
struct Acetate {
  static constexpr double radius = 3e-3;       // m
  static constexpr double mass = 1.48e-4;      // kg
  static constexpr double stiffness = 7.32e6;  // N/m
  static constexpr double damping = 2.06;      // kg/s
};

/// A solid sphere, I = 2/5 m R².
template <int D>
void add_ball(Grains<D>& grains, const Vec<D>& place, const Vec<D>& velocity, double radius, double mass,
              bool moves = true) {
  grains.add(place, radius, mass, 0.4 * mass * radius * radius, moves);
  for (int k = 0; k < D; ++k) grains.velocity[k].back() = velocity[k];
}

/// Damped oscillator m_eff ξ'' = −k ξ − γ ξ' that the overlap of a contact obeys: thesis (3.1) to (3.3),
/// written out here and not taken from src/laws.
struct Oscillator {
  double k, gamma, m_eff;
  double decay() const { return gamma / (2 * m_eff); }
  double frequency() const { return std::sqrt(k / m_eff - decay() * decay()); }
  double contact_time() const { return pi / frequency(); }
  double restitution() const { return std::exp(-decay() * contact_time()); }
  /// Overlap and its rate a time t after they were x0 and v0.
  std::array<double, 2> at(double t, double x0, double v0) const {
    const double d = decay(), w = frequency(), b = (v0 + d * x0) / w;
    const double c = std::cos(w * t), s = std::sin(w * t), e = std::exp(-d * t);
    return {e * (x0 * c + b * s), e * ((b * w - d * x0) * c - (x0 * w + d * b) * s)};
  }
};

template <int D>
soft::SoftSetup<D> setup(const laws::ContactLaws& contact, double time_step, double diameter,
                         soft::Scheme scheme = soft::Scheme::gear5) {
  soft::SoftSetup<D> made;
  made.laws = contact;
  made.time_step = time_step;
  made.scheme = scheme;
  made.skins = soft::usual_skins<D>(diameter);
  return made;
}

/// Steps until nothing has touched for a step after something did; the number of steps with a contact.
template <int D>
std::int64_t through_one_contact(soft::SoftEngine<D>& engine, std::int64_t most = 1'000'000) {
  std::int64_t touching = 0;
  for (std::int64_t i = 0; i < most; ++i) {
    engine.advance_to(engine.step() + 1);
    if (!engine.contacts().empty())
      ++touching;
    else if (touching)
      return touching;
  }
  return -1;
}

inline laws::ContactLaws smooth(double stiffness, double damping) {
  return {laws::SpringDashpot::from_damping(stiffness, damping, laws::MassScaling::none),
          laws::Frictionless{}};
}

}  // namespace chute::test
