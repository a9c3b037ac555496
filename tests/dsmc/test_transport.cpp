// How cells and steps change what a gas carries: a wave of shear decays by the viscosity, which partners from afar and
// flights through the time of a collision enlarge by known parts, in the squares of cell and step.
#include <catch2/catch.hpp>

#include "gas.hpp"

using namespace chute;
using namespace chute::test;
using dsmc::DsmcEngine;

namespace {

constexpr double pi = std::numbers::pi;

/// A dilute gas of spheres between periods of 12 mean free paths λ, with v_x ∝ sin(2πy/S) and v_z ∝ cos(2πy/S).
struct ShearWave {
  static constexpr std::size_t count = 480000;
  static constexpr double path = 10;  // λ, in diameters
  static constexpr double phi = pi / (6 * std::numbers::sqrt2 * pi * path);
  static constexpr double lengths = 12, side = lengths * path, wave = 2 * pi / side;
  static constexpr double speed = 1;
  Gas<3> gas;
  /// In units of λ, and of λ over the mean speed √(8T/πm).
  ShearWave(double cell, double step, std::uint64_t seed)
      : gas(count, count * pi / 6 / (side * side * side), 1, seed) {
    gas.setup.weight = phi * 6 / pi * side * side * side / static_cast<double>(count);
    gas.setup.dense = dsmc::Dense::none;
    gas.setup.cell = cell * path;
    gas.setup.time_step = step * path / std::sqrt(8 / pi);
    for (std::size_t i = 0; i < count; ++i) {
      const double y = gas.grains.position[1][i];
      gas.grains.velocity[0][i] += speed * std::sin(wave * y);
      gas.grains.velocity[2][i] += speed * std::cos(wave * y);
    }
  }
  static double amplitude(const Grains<3>& grains) {
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i)
      sum += grains.velocity[0][i] * std::sin(wave * grains.position[1][i]) +
             grains.velocity[2][i] * std::cos(wave * grains.position[1][i]);
    return sum / static_cast<double>(count);
  }
  /// −d ln(amplitude)/dt over about a decay time, when the velocities know of the wave.
  double decay() {
    DsmcEngine<3> engine(gas.grains, gas.setup);
    const double dt = gas.setup.time_step, unit = path / std::sqrt(8 / pi);
    const auto at = [&](double t) { return std::llround(t * unit / dt); };
    engine.advance_to(at(4));
    const double before = amplitude(engine.state());
    engine.advance_to(at(14));
    return std::log(before / amplitude(engine.state())) / static_cast<double>(at(14) - at(4)) / dt;
  }
};

/// Of the gas at the start; the wave's energy heats it a little as it decays, and viscosity grows like the root of T.
double viscosity(double cell, double step) {
  // The density of mass is n, of unit masses: decay = η k²/n.
  return ShearWave(cell, step, 1).decay() * ShearWave::phi * 6 / pi / (ShearWave::wave * ShearWave::wave);
}

}  // namespace

// Cells of side L (Alexander, Garcia & Alder, Phys. Fluids 10, 1540 (1998)): colliding partners are E (y1 − y2)² = L²/6 apart and
// hand over 4/3 of half their mean difference of velocities, as fast ones collide more often, n c/2λ times: η grows by n m c
// L²/(18 λ), which is 16/(45π) (L/λ)² of Enskog's. Steps (Hadjiconstantinou, Phys. Fluids 12, 2634 (2000)): shear stress builds up
// in the flight, linear in time, and decays between flights by exp(−x), x = Δt p/η, so that η is x/2 coth(x/2) times as large.
TEST_CASE("viscosity errs by the squares of cell and step, as much as is known") {
  const double fine = viscosity(0.5, 0.1), wide = viscosity(1, 0.1), wider = viscosity(1.5, 0.1),
               slow = viscosity(0.5, 1), slower = viscosity(0.5, 2);
  const double enskog = 5.0 / 16 / std::sqrt(pi) * 1.016, by_cells = 16 / (45 * pi);
  CAPTURE(fine, wide, wider, slow, slower, enskog);
  // 0.26 of the wave's energy is heat by then, and kλ = 0.5 is not small.
  CHECK(fine == Approx(enskog * (1 + by_cells / 4)).epsilon(0.1));
  CHECK((wide / fine - 1) / 0.75 == Approx(by_cells).epsilon(0.25));
  CHECK((wider / fine - 1) / 2 == Approx(by_cells).epsilon(0.2));
  const auto by_steps = [](double step) {
    const double x = step * (pi / 8) / (5 * pi / 32);  // η = 5π/32 n m c λ, p = π/8 n m c²
    return x / 2 / std::tanh(x / 2);
  };
  // With 35 grains in a cell some meet the partner again from whom they have just parted, the more the longer a step is:
  // that adds a few per cent (with 70 they were 0.053 and 0.221, where 0.052 and 0.204 are due).
  for (const auto& [measured, step] : {std::pair{slow, 1.0}, {slower, 2.0}}) {
    const double due = by_steps(step) - by_steps(0.1), more = measured / fine - 1;
    CHECK(more > due);
    CHECK(more < due + 0.08 * step);
  }
  CHECK((slower / fine - 1) / (slow / fine - 1) == Approx(4).epsilon(0.25));
}
