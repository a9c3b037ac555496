#pragma once
#include <cmath>
#include <map>

#include "core/sphere.hpp"
#include "engines/restructuring/restructuring_engine.hpp"

namespace chute::test {

/// What is laid in a box that repeats sideways, and on what.
struct Deposit {
  std::size_t grains = 1000;
  double width = 20;    ///< of the box, in every lateral direction
  double spread = 0;    ///< radii evenly within this part of a half
  double intruder = 0;  ///< diameter of grain 0; 0: as the others
  double jolt = 0;
  std::uint64_t seed = 1;
  restructuring::Rain rain = restructuring::Rain::line;
};

template <int D>
void add_sphere(Grains<D>& grains, const Vec<D>& place, double radius, bool moves) {
  const double mass = sphere_mass(1, radius);
  grains.add(place, radius, mass, sphere_inertia(mass, radius), moves);
}

/// A smooth floor at height 0 and gravity straight down.
template <int D>
World<D> box(double width) {
  World<D> world;
  for (int k = 0; k + 1 < D; ++k) world.domain.length[k] = width;
  world.gravity[D - 1] = -1;
  Wall<D> floor;
  floor.normal[D - 1] = 1;
  world.walls.push_back(floor);
  world.frame.dimensions = D;
  world.frame.footprint = D == 2 ? width : width * width;
  return world;
}

template <int D>
restructuring::RestructuringEngine<D> engine_of(const World<D>& world, const Deposit& deposit) {
  restructuring::RestructuringSetup<D> setup{world.surroundings()};
  setup.seed = deposit.seed, setup.rain = deposit.rain, setup.jolt = deposit.jolt;
  return {world.grains, setup};
}

template <int D>
restructuring::RestructuringEngine<D> rained(const Deposit& deposit) {
  auto world = box<D>(deposit.width);
  for (std::size_t i = 0; i < deposit.grains; ++i) {
    const double size = Random(deposit.seed, Purpose::sizes, i).uniform(-1, 1);
    add_sphere<D>(world.grains, {},
                  i == 0 && deposit.intruder > 0 ? deposit.intruder / 2 : 0.5 * (1 + deposit.spread * size),
                  true);
  }
  return engine_of(world, deposit);
}

inline double told(const Engine& engine, const std::string& name) {
  for (const auto& [key, value] : engine.tells())
    if (key == name) return value;
  return NAN;
}

}  // namespace chute::test
