#pragma once
#include <cmath>
#include <map>

#include "core/frame.hpp"
#include "core/random.hpp"
#include "engines/contact/contact_engine.hpp"

/// A few rigid grains by hand, for tests that know the answer.
namespace chute::test {

using contact::ContactEngine;
using contact::ContactSetup;

/// A ball of unit diameter and mass, I = κ m R²; κ = 2/5 is a solid sphere.
template <int D>
void add_ball(Grains<D>& grains, const Vec<D>& place, const Vec<D>& velocity = {}, bool moves = true,
              double radius = 0.5, double kappa = 0.4) {
  grains.add(place, radius, 1, kappa * radius * radius, moves);
  for (int k = 0; k < D; ++k) grains.velocity[static_cast<std::size_t>(k)].back() = velocity[k];
}

/// One friction, no rebound, converged as statics are.
template <int D>
ContactSetup<D> setup_of(double mu, double time_step = 0.01) {
  ContactSetup<D> setup;
  setup.contact = {laws::ConstantRestitution{0}, laws::Walton{mu, 0}};
  setup.static_friction = mu;
  setup.time_step = time_step;
  setup.tolerance = 1e-12;
  setup.iterations = 100000;
  return setup;
}

template <int D>
void pull(ContactSetup<D>& setup, const Vec<D>& gravity) {
  setup.gravity = gravity;
  setup.reference_impulse = norm(gravity) * setup.time_step;
  setup.impact_velocity = 4 * norm(gravity) * setup.time_step;
  setup.stick_velocity = 1e-6;
}

/// A horizontal plane at height 0.
template <int D>
Wall<D> floor_at(double height = 0) {
  Wall<D> wall;
  wall.point[D - 1] = height;
  wall.normal[D - 1] = 1;
  return wall;
}

/// The contacts by their partners' ids.
template <int D>
std::map<std::pair<std::int64_t, std::int64_t>, Contact> by_partners(const ContactEngine<D>& engine) {
  std::map<std::pair<std::int64_t, std::int64_t>, Contact> contacts;
  for (const auto& c : engine.contacts()) contacts[{c.a, c.b}] = c;
  return contacts;
}

}  // namespace chute::test
