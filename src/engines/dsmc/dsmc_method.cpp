#include "engines/dsmc/dsmc_method.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engines/dsmc/dsmc_engine.hpp"
#include "engines/dsmc/hard_gas.hpp"

namespace chute::dsmc {
namespace {

/// What steps and cells are by default, and where they are too coarse.
constexpr double usual_step = 0.2, coarse_step = 1.0 / 3;  // of the time between collisions
constexpr double coarse_cell = 0.5;                        // of the mean free path
constexpr double grains_in_cell = 20;

template <int D>
DsmcMethod::Gas gas_of(const DsmcMethod& method, const engines::Setting& s) {
  DsmcMethod::Gas gas;
  double room = 1;
  for (std::size_t k = 0; k < D; ++k) room *= s.size[k];
  if (room > 0) {
    gas.n = method.weight * static_cast<double>(s.grains) / room;
    gas.phi = gas.n * content<D>(s.mean_diameter / 2);
    if (method.dense != Dense::none && gas.phi < densest) gas.chi = chi<D>(gas.phi);
  }
  gas.temperature = s.mean_mass * s.spread * s.spread;
  for (const auto& wall : s.wall_surfaces)
    gas.temperature = std::max(gas.temperature, wall.temperature.value_or(0));
  if (gas.n > 0) {
    gas.path = free_path<D>(gas.n, s.mean_diameter, gas.chi);
    gas.rate = collision_rate<D>(gas.n, s.mean_diameter, gas.chi, gas.temperature, s.mean_mass);
  }
  return gas;
}

template <int D>
std::unique_ptr<Engine> made(World<D> world, const DsmcMethod& method, const engines::Setting& setting,
                             int threads) {
  DsmcSetup<D> setup{world.surroundings()};
  setup.contact.restitution = laws::ConstantRestitution{method.e_n(setting)};
  setup.contact.tangential = method.walton(setting);
  setup.time_step = method.step(setting);
  setup.cell = method.cell_side(setting);
  setup.weight = method.weight;
  setup.heating = method.heating;
  setup.dense = method.dense;
  setup.seed = setting.seed;
  setup.threads = setting.useful_threads(threads, DsmcMethod::grains_per_thread);
  return std::make_unique<DsmcEngine<D>>(std::move(world.grains), setup);
}

}  // namespace

DsmcMethod::Gas DsmcMethod::gas(const engines::Setting& s) const {
  return s.dimensions == 2 ? gas_of<2>(*this, s) : gas_of<3>(*this, s);
}

Offers DsmcMethod::offers() const {
  // Nothing touches for a while in a gas: its contacts are collisions.
  return {.contacts = true,
          .collisions = true,
          .impacts = true,
          .walls = true,
          .wall_shapes = true,
          .wall_motion = true,
          .wall_surfaces = true,
          .wall_sticking = true,
          .wall_temperatures = true,
          .threads = true};
}

std::optional<Refusal> DsmcMethod::refusal(const engines::Setting& s) const {
  const auto g = gas(s);
  if (g.phi > densest)
    return Refusal{
        "grains.count",
        fmt::format(
            "fill a part of {:.2f} of the domain; above {} grains are caged by their neighbours, which "
            "DSMC knows nothing of: use event, hybrid or soft",
            g.phi, densest)};
  if (!time_step && g.rate == 0)
    return Refusal{"engine.time_step",
                   g.n > 0
                       ? "missing: nothing moves at the start, so no time between collisions is known"
                       : "missing: without domain.size along every axis no time between collisions is known"};
  if (dense == Dense::esmc && cell_side(s) < s.mean_diameter)
    return Refusal{"engine.cell", "must not be smaller than a grain with dense = \"esmc\""};
  double cells = 1;
  for (const double length : s.size) cells *= length > 0 ? std::max(1.0, length / cell_side(s)) : 1;
  if (const auto why = too_many_cells(cells, s.grains)) return Refusal{"engine.cell", *why};
  return {};
}

double DsmcMethod::step(const engines::Setting& s) const {
  if (time_step) return *time_step;
  const auto g = gas(s);
  if (g.rate == 0) return s.between_outputs;  // refused
  return engines::step_dividing(s.between_outputs, std::min(usual_step / g.rate, s.duration));
}

double DsmcMethod::cell_side(const engines::Setting& s) const {
  if (cell) return *cell;
  const double d = s.mean_diameter, narrow = 1.5 * d;
  const auto g = gas(s);
  if (g.n == 0) return 3 * d;
  return std::clamp(std::pow(grains_in_cell * weight / g.n, 1.0 / s.dimensions), narrow,
                    std::max(3 * d, g.path / 3));
}

std::vector<Fact> DsmcMethod::facts(const engines::Setting& s) const {
  const auto tangential = walton(s);
  const auto g = gas(s);
  const double side = cell_side(s);
  const auto time = s.in("s", "sqrt(d/g)");
  std::vector<Fact> list{{"e_n", e_n(s), "", "restitution of every collision"},
                         {"mu", tangential.friction, "", "friction of collisions that slide"},
                         {"beta", tangential.beta, "", "tangential restitution of collisions that stick"},
                         {"dt", step(s), time, "time step"},
                         {"cell", side, s.in("m", "d"), "side of a cell, about"}};
  if (g.n > 0) {
    list.push_back({"phi", g.phi, "", "part of the domain that grains fill"});
    list.push_back({"lambda", g.path, s.in("m", "d"), "mean free path"});
    list.push_back({"N_c", g.n / weight * std::pow(side, s.dimensions), "", "grains in a cell"});
  }
  if (g.rate > 0) {
    list.push_back({"tau_c", 1 / g.rate, time, "mean time between a grain's collisions at the start"});
    list.push_back({"dt/tau_c", step(s) * g.rate, "", "1/3 is coarse"});
  }
  constexpr double bytes = 200;
  list.push_back({"memory", bytes * static_cast<double>(s.grains) / 1e6, "MB", "of the grains, at most"});
  return list;
}

std::vector<std::string> DsmcMethod::warnings(const engines::Setting& s) const {
  std::vector<std::string> list;
  const auto g = gas(s);
  if (g.rate > 0 && step(s) * g.rate > coarse_step)
    list.push_back(
        fmt::format("engine.time_step: a step is {:.2g} of the time between collisions; at most 1/3 is safe",
                    step(s) * g.rate));
  if (g.path > 0 && cell_side(s) > coarse_cell * g.path)
    list.push_back(fmt::format(
        "engine.cell: a cell is {:.2g} mean free paths wide, so that gradients within {:.3g} are smeared "
        "out; homogeneous gases do not mind",
        cell_side(s) / g.path, cell_side(s)));
  return list;
}

double DsmcMethod::seconds_per_step(const engines::Setting& s) const {
  constexpr double per_grain = 0.1e-6;  // measured on one core of a 2020s server
  return per_grain * static_cast<double>(s.grains);
}

std::unique_ptr<Engine> DsmcMethod::make(World<2> world, const engines::Setting& setting, int threads) const {
  return made(std::move(world), *this, setting, threads);
}
std::unique_ptr<Engine> DsmcMethod::make(World<3> world, const engines::Setting& setting, int threads) const {
  return made(std::move(world), *this, setting, threads);
}

}  // namespace chute::dsmc
