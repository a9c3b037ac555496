#pragma once
#include "core/random.hpp"
#include "two_grains.hpp"

namespace chute::test {

/// A small flow on a bumpy line, 18 degrees steep, in reduced units: dense contacts, friction, a bed, a
/// period.
struct SmallChute {
  static constexpr double stiffness = 1e5, restitution = 0.6;
  std::int64_t bed = 8, columns = 6, rows = 4;

  static laws::ContactLaws contact(double viscosity = 100, double friction = 0.5) {
    return {laws::SpringDashpot::from_restitution(stiffness, restitution),
            laws::RegularisedCoulomb{viscosity, friction, laws::MassScaling::none, {}}};
  }
  /// t_n of two grains of unit mass.
  static double contact_time() {
    const double damp = -std::log(restitution) / pi;
    return pi / std::sqrt(stiffness / 0.5 / (1 + damp * damp));
  }

  Grains<2> grains() const {
    Random random(3, Purpose::start);
    Grains<2> g;
    for (std::int64_t i = 0; i < columns * rows; ++i) {
      const double d = random.uniform(0.9, 1.1);
      add_ball<2>(g,
                  {{(0.5 + static_cast<double>(i % columns)) * static_cast<double>(bed) /
                        static_cast<double>(columns),
                    1.5 + 1.2 * static_cast<double>(i / columns)}},
                  {{2 + random.normal(), random.normal()}}, d / 2, d * d * d);
    }
    for (std::int64_t i = 0; i < bed; ++i)
      add_ball<2>(g, {{0.5 + static_cast<double>(i), 0}}, {{0, 0}}, 0.5, 1, false);
    return g;
  }
  soft::SoftSetup<2> setup(double steps_per_contact, soft::Scheme scheme = soft::Scheme::gear5) const {
    auto s = test::setup<2>(contact(), contact_time() / steps_per_contact, 1, scheme);
    s.domain.length[0] = static_cast<double>(bed);
    s.gravity = {{std::sin(0.1 * pi), -std::cos(0.1 * pi)}};
    return s;
  }
};

/// Contacts that remember how they were loaded and how far they slipped.
inline const laws::ContactLaws remembering{
    laws::WaltonBraun::from_restitution(SmallChute::stiffness, SmallChute::restitution),
    laws::CundallStrack{laws::PairCoefficient{2.0 / 7 * SmallChute::stiffness},
                        laws::CutOffSpring{0.5, true}}};

/// Loose gas in three dimensions above a plane of fixed grains, periodic in x and y.
inline Grains<3> small_box() {
  Random random(4, Purpose::start);
  Grains<3> g;
  for (int i = 0; i < 60; ++i)
    add_ball<3>(g, {{0.6 + 1.25 * (i % 4), 0.6 + 1.25 * (i / 4 % 4), 1.3 + 1.2 * (i / 16)}},
                {{1 + random.normal(), random.normal(), random.normal()}}, random.uniform(0.4, 0.55), 1);
  for (int i = 0; i < 25; ++i)
    add_ball<3>(g, {{0.5 + i % 5, 0.5 + static_cast<double>(i / 5), 0}}, {{0, 0, 0}}, 0.5, 1, false);
  return g;
}
inline soft::SoftSetup<3> small_box_setup(double steps_per_contact) {
  auto s = setup<3>(SmallChute::contact(), SmallChute::contact_time() / steps_per_contact, 1);
  s.domain.length[0] = s.domain.length[1] = 5;
  s.gravity = {{0.3, 0, -0.95}};
  return s;
}

}  // namespace chute::test
