#pragma once
#include <vector>

#include "clumps/make_clump.hpp"
#include "core/sphere.hpp"
#include "engines/soft/clump_engine.hpp"

/// A few grains by hand, for tests that know the answer.
namespace chute::test {

/// Bodies as they are put, of density 6/π: a body whose form has the volume of a sphere of diameter 1 weighs 1.
template <int D>
struct Bodies {
  Grains<D> grains;
  Clumps<D> clumps;

  /// A form of these spheres, for `put`.
  int form(const std::vector<clumps::Sphere>& spheres) {
    clumps.forms.push_back(clumps::make_clump<D>(spheres));
    return static_cast<int>(clumps.forms.size()) - 1;
  }
  void put(int form, const Vec<D>& place, const Vec<D>& velocity = {}, const Vec<turns<D>>& spin = {},
           const Orientation<D>& attitude = as_at_start<D>(), double scale = 0.5) {
    const double mass = sphere_mass(6 / std::numbers::pi, scale);
    const auto& clump = clumps.forms[static_cast<std::size_t>(form)];
    grains.add(place, scale * clump.radius, mass, clump.inertia(mass, scale), true);
    for (int k = 0; k < D; ++k) grains.velocity[k].back() = velocity[k];
    for (int k = 0; k < turns<D>; ++k) grains.spin[k].back() = spin[k];
    for (int k = 0; k < orientation_numbers<D>; ++k) grains.orientation[k].back() = attitude[k];
    clumps.form.push_back(form);
    clumps.scale.push_back(scale);
  }
  void put_bead(const Vec<D>& place, double radius = 0.5) {
    const double mass = sphere_mass(6 / std::numbers::pi, radius);
    grains.add(place, radius, mass, sphere_inertia(mass, radius), false);
  }
};

/// Three spheres of different sizes off a line: three different moments.
inline std::vector<clumps::Sphere> crooked() {
  return {{{{0, 0, 0}}, 0.5}, {{{0.7, 0.1, 0}}, 0.4}, {{{0.1, 0.6, 0.1}}, 0.3}};
}
inline std::vector<clumps::Sphere> rod() {
  return {{{{-0.5, 0, 0}}, 0.5}, {{{0, 0, 0}}, 0.5}, {{{0.5, 0, 0}}, 0.5}};
}

template <int D>
soft::SoftSetup<D> setup(const laws::ContactLaws& contact, double time_step, soft::Scheme scheme) {
  soft::SoftSetup<D> made;
  made.laws = contact;
  made.time_step = time_step;
  made.scheme = scheme;
  made.skins = soft::usual_skins<D>(1);
  return made;
}

inline laws::ContactLaws smooth(double stiffness, double damping = 0) {
  return {laws::SpringDashpot::from_damping(stiffness, damping, laws::MassScaling::none),
          laws::Frictionless{}};
}
inline laws::ContactLaws rough(double stiffness) {
  return {laws::SpringDashpot::from_restitution(stiffness, 0.7),
          laws::RegularisedCoulomb{30, 0.4, laws::MassScaling::none, {}}};
}
inline laws::ContactLaws remembering(double stiffness) {
  return {laws::SpringDashpot::from_restitution(stiffness, 0.7),
          laws::CundallStrack{laws::PairCoefficient{0.4 * stiffness}, laws::CutOffSpring{0.4, true}}};
}

}  // namespace chute::test
