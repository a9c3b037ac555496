#pragma once
#include <cmath>
#include <numbers>

#include "core/random.hpp"
#include "engines/event/event_engine.hpp"

/// A few hard grains by hand, for tests that know the answer.
namespace chute::test {

/// A solid sphere, I = 2/5 m R².
template <int D>
void add_ball(Grains<D>& grains, const Vec<D>& place, const Vec<D>& velocity, double radius, double mass,
              bool moves) {
  grains.add(place, radius, mass, 0.4 * mass * radius * radius, moves);
  for (int k = 0; k < D; ++k) grains.velocity[static_cast<std::size_t>(k)].back() = velocity[k];
}

/// Grains of unit mass and diameter on a lattice with random velocities and spins, in a box that is periodic
/// in every direction.
template <int D>
struct Gas {
  Grains<D> grains;
  event::EventSetup<D> setup;

  Gas(std::int64_t per_side, double spacing, unsigned seed = 5) {
    Random random(seed, Purpose::start);
    const auto n = static_cast<std::int64_t>(std::llround(std::pow(per_side, D)));
    for (std::int64_t i = 0; i < n; ++i) {
      Vec<D> place, velocity;
      auto rest = i;
      for (int k = 0; k < D; ++k, rest /= per_side) {
        place[k] = (static_cast<double>(rest % per_side) + 0.5) * spacing;
        velocity[k] = random.normal();
      }
      add_ball<D>(grains, place, velocity, 0.5, 1, true);
      for (auto& spin : grains.spin) spin.back() = random.normal();
    }
    for (int k = 0; k < D; ++k) setup.domain.length[k] = static_cast<double>(per_side) * spacing;
    setup.tick = 0.1;
  }
};

/// A few rows of grains above a line of fixed beads, under gravity on an incline.
struct Heap {
  Grains<2> grains;
  event::EventSetup<2> setup;

  Heap(int columns, int rows, double angle, unsigned seed = 5) {
    Random random(seed, Purpose::start);
    for (int i = 0; i < columns * rows; ++i)
      add_ball<2>(grains, {{(i % columns + 0.5) * 1.2, 1.5 + 1.2 * (i / columns)}},
                  {{random.normal(), random.normal()}}, 0.5 * (1 + random.uniform(-0.1, 0.1)), 1, true);
    const double length = 1.2 * columns;
    for (int i = 0; i < columns; ++i) add_ball<2>(grains, {{(i + 0.5) * 1.2, 0}}, {}, 0.5, 1, false);
    setup.domain.length[0] = length;
    setup.gravity = {{std::sin(angle), -std::cos(angle)}};
    setup.tick = 0.1;
  }
};

}  // namespace chute::test
