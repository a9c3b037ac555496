#pragma once
#include <cmath>

#include "core/frame.hpp"
#include "core/random.hpp"
#include "engines/hybrid/hybrid_engine.hpp"

/// A few hard grains by hand, for tests that know the answer.
namespace chute::test {

/// A solid sphere of unit diameter and mass, I = 2/5 m R².
template <int D>
void add_ball(Grains<D>& grains, const Vec<D>& place, const Vec<D>& velocity, bool moves = true,
              double radius = 0.5, double mass = 1) {
  grains.add(place, radius, mass, 0.4 * mass * radius * radius, moves);
  for (int k = 0; k < D; ++k) grains.velocity[static_cast<std::size_t>(k)].back() = velocity[k];
}

template <int D>
hybrid::HybridSetup<D> setup_of(double e_n, laws::Walton tangential, double time_step) {
  hybrid::HybridSetup<D> setup;
  setup.contact = {laws::ConstantRestitution{e_n}, tangential};
  setup.time_step = time_step;
  return setup;
}

/// A horizontal plane at height 0.
template <int D>
Wall<D> floor_at(double height = 0) {
  Wall<D> wall;
  wall.point[D - 1] = height;
  wall.normal[D - 1] = 1;
  return wall;
}

/// Grains with random velocities and spins on a lattice, in a box that is periodic in every direction.
template <int D>
struct Gas {
  Grains<D> grains;
  Domain<D> domain;
  Gas(std::int64_t per_side, double spacing, double spin = 1, std::uint64_t seed = 5) {
    const auto n = static_cast<std::int64_t>(std::llround(std::pow(per_side, D)));
    for (std::int64_t i = 0; i < n; ++i) {
      Random random(seed, Purpose::start, static_cast<std::uint64_t>(i));
      Vec<D> place, velocity;
      auto rest = i;
      for (int k = 0; k < D; ++k, rest /= per_side) {
        place[k] = (static_cast<double>(rest % per_side) + 0.5) * spacing;
        velocity[k] = random.normal();
      }
      add_ball<D>(grains, place, velocity);
      for (auto& s : grains.spin) s.back() = spin * random.normal();
    }
    for (int k = 0; k < D; ++k) domain.length[k] = static_cast<double>(per_side) * spacing;
  }
};

template <int D>
Vec<D> momentum(const Grains<D>& grains) {
  Vec<D> sum{};
  for (std::size_t i = 0; i < grains.moving; ++i) sum = sum + grains.mass[i] * grains.speed(i);
  return sum;
}

}  // namespace chute::test
