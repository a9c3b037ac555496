#include "engines/automaton/automaton_method.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/error.hpp"
#include "engines/automaton/automaton_engine.hpp"
#include "engines/automaton/lattice_gas.hpp"
#include "engines/automaton/pile.hpp"
#include "engines/automaton/voids.hpp"

namespace chute::automaton {
namespace {

/// Fewer rows than this are not worth a thread.
constexpr int rows_per_thread = 16;

/// How many of `unit` a length is; a lattice has whole sites.
int whole(double length, double unit, const char* what) {
  const double count = length / unit, nearest = std::round(count);
  if (!(nearest >= 1) || std::abs(count - nearest) > 1e-3)
    throw InputError(
        fmt::format("domain.size: {:.8g} is no whole number of {}, {:.8g} apart; the nearest is {:.8g}",
                    length, what, unit, std::max(1.0, nearest) * unit));
  return static_cast<int>(nearest);
}

Lattice lattice_of(const World<2>& world, const engines::Setting& setting) {
  if (!(setting.size[0] > 0 && setting.size[1] > 0))
    throw InputError("domain.size: a lattice needs [length, height]");
  Lattice lattice{whole(setting.size[0], 1, "columns"), whole(setting.size[1], row_height, "rows"),
                  world.domain.periodic(0), world.domain.periodic(1)};
  if (lattice.periodic_y && lattice.rows % 2)
    throw InputError(
        fmt::format("domain.size: {} rows do not repeat, their number must be even", lattice.rows));
  if (lattice.sites() > (std::size_t{1} << 31)) throw InputError("domain.size: more than 2^31 sites");
  return lattice;
}

}  // namespace

Offers AutomatonMethod::offers() const {
  return {.in_3d = false,
          .by_contact = false,
          .walls = model != ModelKind::pile,
          .wall_shapes = model != ModelKind::pile,
          .avalanches = model == ModelKind::pile,
          .threads = model == ModelKind::lattice_gas,
          .clock = "updates"};
}

std::vector<Fact> AutomatonMethod::facts(const engines::Setting& s) const {
  const double columns = s.size[0], rows = s.size[1] / row_height;
  switch (model) {
    case ModelKind::lattice_gas:
      return {{"sites", std::round(columns) * std::round(rows), "", "of the lattice"},
              {"grains", density * std::round(columns * rows), "", "if all sites are filled"},
              {"memory", 2e-6 * columns * rows, "MB", "of the lattice"}};
    case ModelKind::pile:
      return {{"L", columns, "", "sites"},
              {"<s>", columns, "", "mean size of avalanches in the end: each grain topples L times"}};
    case ModelKind::voids:
      return {{"sites", std::round(columns) * std::round(rows), "", "of the lattice"},
              {"B", 1 / (4 * std::sqrt(3.0)), "", "how fast voids spread: variance 2 B h at height h"}};
  }
  return {};
}

double AutomatonMethod::seconds_per_step(const engines::Setting& s) const {
  // Measured on one core of a 2020s server.
  constexpr double per_site = 4e-9, per_toppling = 15e-9, per_row = 20e-9;
  switch (model) {
    case ModelKind::lattice_gas:
      return per_site * s.size[0] * s.size[1] / row_height;
    case ModelKind::pile:
      return per_toppling * s.size[0];
    case ModelKind::voids:
      return per_row * s.size[1];
  }
  return 0;
}

std::unique_ptr<Engine> AutomatonMethod::make(World<2> world, const engines::Setting& setting,
                                              int threads) const {
  std::unique_ptr<Model> made;
  if (model == ModelKind::pile) {
    PileSetup setup;
    setup.length = whole(setting.size[0], 1, "sites");
    setup.low = static_cast<int>(threshold_low), setup.high = static_cast<int>(threshold_high);
    setup.probability_low = probability_low;
    setup.seed = setting.seed;
    made = std::make_unique<Pile>(setup);
  } else if (model == ModelKind::voids) {
    VoidsSetup setup;
    setup.lattice = lattice_of(world, setting);
    setup.walls = world.walls;
    setup.orifice_x = orifice_x.value_or(setting.size[0] / 2);
    setup.orifice = orifice;
    if (fill_high) setup.fill_high = *fill_high;
    setup.refill = refill;
    setup.small = small, setup.bias = bias;
    setup.seed = setting.seed;
    if (orifice > setup.lattice.columns) throw InputError("engine.orifice: is wider than the lattice");
    made = std::make_unique<Voids>(setup);
  } else {
    LatticeGasSetup setup;
    setup.lattice = lattice_of(world, setting);
    setup.walls = world.walls;
    setup.rule = {dissipation, gravity, SiteRule::towards(gravity_on_incline<2>(1, setting.theta))};
    setup.reversal = reversal;
    setup.density = density;
    if (fill_low) setup.fill_low = *fill_low;
    if (fill_high) setup.fill_high = *fill_high;
    setup.seed = setting.seed;
    setup.threads = std::clamp(setup.lattice.rows / rows_per_thread, 1, threads);
    made = std::make_unique<LatticeGas>(setup);
  }
  return std::make_unique<AutomatonEngine>(std::move(made), world.surroundings());
}

std::unique_ptr<Engine> AutomatonMethod::make(World<3>, const engines::Setting&, int) const {
  throw InputError("engine.method: the automaton knows no third dimension");
}

}  // namespace chute::automaton
