#include "engines/restructuring/restructuring_method.hpp"

#include <fmt/format.h>

#include <cmath>

#include "engines/kind/memory.hpp"
#include "engines/monte_carlo/monte_carlo_method.hpp"

namespace chute::restructuring {
namespace {

template <int D>
std::unique_ptr<Engine> made(World<D> world, const RestructuringMethod& method,
                             const engines::Setting& setting) {
  RestructuringSetup<D> setup{world.surroundings()};
  setup.seed = setting.seed;
  setup.rain = method.rain;
  setup.jolt = method.jolt * setting.mean_diameter;
  if (method.turn) setup.turn = *parse_angle(*method.turn);
  setup.stabilise = method.stabilise;
  if (method.loosening.expand > 0) {
    setup.loosening = method.loosening;
    setup.loosening->step *= setting.mean_diameter;
  }
  return std::make_unique<RestructuringEngine<D>>(std::move(world.grains), setup);
}

}  // namespace

std::optional<Refusal> RestructuringMethod::refusal(const engines::Setting& s) const {
  if (s.theta != 0)
    return Refusal{"incline", "restructuring lays grains straight down: it needs angle = \"0 deg\""};
  if (turn && s.drum == 0) return Refusal{"engine.turn", "turns a drum: it needs a [[wall]] with a radius"};
  if (s.drum > 0 && loosening.expand > 0)
    return Refusal{"engine.expand", "stretches heights, and a drum has no room for that"};
  constexpr double densest = 0.8;  // about what discs that are laid fill
  if (const double part = static_cast<double>(s.grains) * std::pow(s.mean_diameter / 2 / s.drum, 2);
      s.drum > 0 && part > densest)
    return Refusal{"grains.count",
                   fmt::format("fill {:.3g} of the drum; laid discs need more room, at most {} is "
                               "possible",
                               part, densest)};
  if (loosening.expand > 0) return monte_carlo::too_long(loosening.step * s.mean_diameter, s.size);
  return {};
}

std::vector<Fact> RestructuringMethod::facts(const engines::Setting& s) const {
  return {{"shakes", s.duration, "", "times that every grain is laid"},
          {"jolt", jolt * s.mean_diameter, s.in("m", "d"), "largest shift sideways before a grain falls"},
          engines::memory_of_grains(s, 1200, 1800)};
}

double RestructuringMethod::seconds_per_step(const engines::Setting& s) const {
  constexpr double seconds_2d = 1e-6, seconds_3d = 5e-6;  // to lay a grain
  constexpr double move_2d = 7e-8, move_3d = 1.5e-7;      // a trial move before
  const double moves = loosening.expand > 0 ? static_cast<double>(loosening.sweeps) : 0;
  return static_cast<double>(s.grains) *
         (s.dimensions == 2 ? seconds_2d + moves * move_2d : seconds_3d + moves * move_3d);
}

std::unique_ptr<Engine> RestructuringMethod::make(World<2> world, const engines::Setting& setting,
                                                  int) const {
  return made(std::move(world), *this, setting);
}
std::unique_ptr<Engine> RestructuringMethod::make(World<3> world, const engines::Setting& setting,
                                                  int) const {
  return made(std::move(world), *this, setting);
}

}  // namespace chute::restructuring
