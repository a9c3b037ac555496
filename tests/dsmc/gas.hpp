#pragma once
#include <cmath>
#include <numbers>

#include "core/random.hpp"
#include "engines/dsmc/dsmc_engine.hpp"
#include "engines/dsmc/hard_gas.hpp"

/// Gases by hand, for tests that know the answer.
namespace chute::test {

/// Grains of unit diameter and mass at random places with a Maxwellian of temperature T in a periodic box of `side`, in which
/// they fill the part φ. Spins are Maxwellian of temperature `rotation`.
template <int D>
struct Gas {
  Grains<D> grains;
  dsmc::DsmcSetup<D> setup;
  Gas(std::size_t count, double phi, double T = 1, std::uint64_t seed = 1, double rotation = 0) {
    const double one = D == 2 ? std::numbers::pi / 4 : std::numbers::pi / 6;
    const double side = std::pow(static_cast<double>(count) * one / phi, 1.0 / D);
    for (int k = 0; k < D; ++k) setup.domain.length[k] = side;
    grains.reserve(count);
    Vec<D> sum{};
    for (std::size_t i = 0; i < count; ++i) {
      Random random(seed, Purpose::start, i);
      Vec<D> place;
      for (int k = 0; k < D; ++k) place[k] = side * random.uniform();
      grains.add(place, 0.5, 1, 0.1, true);
      for (std::size_t k = 0; k < D; ++k) {
        grains.velocity[k].back() = std::sqrt(T) * random.normal();
        sum[static_cast<int>(k)] += grains.velocity[k].back();
      }
      for (auto& s : grains.spin) s.back() = std::sqrt(rotation / 0.1) * random.normal();
    }
    for (std::size_t k = 0; k < D; ++k)
      for (double& v : grains.velocity[k]) v -= sum[static_cast<int>(k)] / static_cast<double>(count);
    // The temperature exactly, so that closed forms need no error of it.
    double square = 0;
    for (const auto& column : grains.velocity)
      for (const double v : column) square += v * v;
    const double factor = std::sqrt(T * D * static_cast<double>(count) / square);
    for (auto& column : grains.velocity)
      for (double& v : column) v *= factor;
    setup.contact = {laws::ConstantRestitution{1}, laws::Walton{0, -1}};
    setup.seed = seed;
  }
};

template <int D>
Vec<D> momentum(const Grains<D>& grains) {
  Vec<D> sum{};
  for (std::size_t i = 0; i < grains.moving; ++i) sum = sum + grains.mass[i] * grains.speed(i);
  return sum;
}

inline double told(const Engine& engine, std::string_view name) {
  for (const auto& [key, value] : engine.tells())
    if (key == name) return value;
  return NAN;
}

template <int D>
Wall<D> floor_wall() {
  Wall<D> wall;
  wall.normal[D - 1] = 1;
  return wall;
}

}  // namespace chute::test
