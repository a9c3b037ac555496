#include "engines/monte_carlo/monte_carlo_method.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "engines/kind/memory.hpp"
#include "engines/monte_carlo/monte_carlo_engine.hpp"
#include "laws/list.hpp"

namespace chute::monte_carlo {
namespace {

template <int D>
std::unique_ptr<Engine> made(World<D> world, const MonteCarloMethod& method, const engines::Setting& setting,
                             int threads) {
  const double d = setting.mean_diameter;
  MonteCarloSetup<D> setup{world.surroundings()};
  setup.seed = setting.seed;
  setup.temperature = method.temperature;
  setup.step = method.trial_length * d;
  setup.equilibrate = method.equilibrate;
  setup.serial = method.order == MonteCarloMethod::Order::serial;
  if (method.shakes())
    setup.shaking = Shaking{method.lift * d, method.expand, method.sweeps, method.settled * d};
  const int members = setup.serial ? 1 : setting.useful_threads(threads, MonteCarloMethod::grains_per_thread);
  return std::make_unique<MonteCarloEngine<D>>(std::move(world.grains), setup, members);
}

}  // namespace

std::optional<Refusal> too_long(double move, const std::array<double, 3>& size) {
  for (const double length : size)
    if (length > 0 && move > longest_part * length)
      return Refusal{
          "engine.step",
          fmt::format("trial moves of {:.6g} are too long for a domain of {:.6g}; at most {} of it "
                      "is possible",
                      move, length, longest_part)};
  return {};
}

Offers MonteCarloMethod::offers() const {
  return {.by_contact = false,
          .walls = true,
          .threads = order == Order::checkerboard,
          .clock = shakes() ? "shakes" : "sweeps"};
}

std::optional<Refusal> MonteCarloMethod::refusal(const engines::Setting& s) const {
  auto shear = s.contact.laws(s.reference()).shear;
  if (const double* mu = laws::friction(shear); mu && *mu > 0)
    return Refusal{"contact.tangential.friction",
                   "monte-carlo knows no friction; use law = \"frictionless\""};
  return too_long(trial_length * s.mean_diameter, s.size);
}

std::vector<Fact> MonteCarloMethod::facts(const engines::Setting& s) const {
  const double weight = s.mean_mass * s.gravity;
  std::vector<Fact> list{
      {"delta", trial_length * s.mean_diameter, s.in("m", "d"), "longest trial move at the begin"}};
  if (temperature > 0 && weight > 0)
    list.push_back({"T/mg", temperature / weight, s.in("m", "d"), "height over which a thin gas falls off"});
  list.push_back(engines::memory_of_grains(s, 400, 500));
  return list;
}

double MonteCarloMethod::seconds_per_step(const engines::Setting& s) const {
  constexpr double seconds_2d = 7e-8, seconds_3d = 1.5e-7;  // a trial move
  constexpr double usual_sweeps = 2000;                     // of a shake
  return static_cast<double>(s.grains) * (s.dimensions == 2 ? seconds_2d : seconds_3d) *
         (shakes() ? usual_sweeps : 1);
}

std::unique_ptr<Engine> MonteCarloMethod::make(World<2> world, const engines::Setting& s, int threads) const {
  return made(std::move(world), *this, s, threads);
}
std::unique_ptr<Engine> MonteCarloMethod::make(World<3> world, const engines::Setting& s, int threads) const {
  return made(std::move(world), *this, s, threads);
}

}  // namespace chute::monte_carlo
