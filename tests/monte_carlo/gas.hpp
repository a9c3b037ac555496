#pragma once
#include <cmath>

#include "core/sphere.hpp"
#include "engines/monte_carlo/monte_carlo_engine.hpp"

namespace chute::test {

using monte_carlo::MonteCarloEngine;
using monte_carlo::MonteCarloSetup;

/// A grain of mass 1.
template <int D>
void add_grain(Grains<D>& grains, const Vec<D>& place, double radius = 0.5, bool moves = true) {
  grains.add(place, radius, 1, sphere_inertia(1, radius), moves);
}
template <int D>
void add_wall(MonteCarloSetup<D>& setup, const Vec<D>& point, const Vec<D>& normal) {
  Wall<D> wall;
  wall.point = point, wall.normal = normal;
  setup.walls.push_back(wall);
}
/// Gravity 1 straight down onto a floor at height 0.
template <int D>
MonteCarloSetup<D> above_floor() {
  MonteCarloSetup<D> setup;
  setup.gravity[D - 1] = -1;
  Vec<D> up{};
  up[D - 1] = 1;
  add_wall<D>(setup, {}, up);
  setup.frame.dimensions = D;
  return setup;
}

/// A gas in a box that repeats everywhere, from a square (cubic) lattice of `side` grains along each direction.
template <int D>
struct Gas {
  MonteCarloSetup<D> setup;
  Grains<D> grains;
  Gas(int side, double phi) {
    const double body = D == 2 ? M_PI / 4 : M_PI / 6, spacing = std::pow(body / phi, 1.0 / D);
    for (int k = 0; k < D; ++k) setup.domain.length[k] = side * spacing;
    setup.frame.dimensions = D;
    setup.temperature = 1, setup.equilibrate = 100;
    const int total = D == 2 ? side * side : side * side * side;
    for (int i = 0; i < total; ++i) {
      Vec<D> place;
      for (int k = 0, rest = i; k < D; ++k, rest /= side) place[k] = (rest % side + 0.5) * spacing;
      add_grain<D>(grains, place);
    }
  }
  double density() const {
    double n = static_cast<double>(grains.moving);
    for (int k = 0; k < D; ++k) n /= setup.domain.length[k];
    return n;
  }
};

}  // namespace chute::test
