#include "engines/hybrid/hybrid_method.hpp"

#include <algorithm>
#include <cmath>

#include "engines/hard/contacts_of.hpp"
#include "engines/hybrid/hybrid_engine.hpp"
#include "engines/kind/memory.hpp"

namespace chute::hybrid {
namespace {

template <int D>
std::unique_ptr<Engine> made(World<D> world, const HybridMethod& method, const engines::Setting& setting,
                             int threads) {
  HybridSetup<D> setup{world.surroundings()};
  hard::set_contacts(setup, method, setting);
  setup.time_step = method.step(setting);
  setup.diameter = setting.resolved_diameter();
  setup.collisions_per_pair = static_cast<int>(method.collisions_per_step);
  setup.relaxation = method.relaxation;
  setup.threads = setting.useful_threads(threads, HybridMethod::grains_per_thread);
  return std::make_unique<HybridEngine<D>>(std::move(world.grains), setup);
}

}  // namespace

Offers HybridMethod::offers() const {
  return {.contacts = true,
          .collisions = true,
          .impacts = true,
          .walls = true,
          .wall_shapes = true,
          .wall_motion = true,
          .wall_surfaces = true,
          .wall_sticking = true,
          .materials = true,
          .tilting = true,
          .threads = true};
}

double HybridMethod::step(const engines::Setting& s) const {
  if (time_step) return *time_step;
  constexpr double way = 0.02, fall = 1e-3;  // parts of d in a step
  const double d = s.mean_diameter;
  double longest = s.duration / 100;
  if (s.fastest > 0) longest = std::min(longest, way * d / s.fastest);
  if (s.gravity > 0) longest = std::min(longest, std::sqrt(fall * d / s.gravity));
  return engines::step_dividing(s.between_outputs, longest);
}

std::vector<Fact> HybridMethod::facts(const engines::Setting& s) const {
  const auto tangential = walton(s);
  const double dt = step(s);
  std::vector<Fact> list{{"e_n", e_n(s), "", "restitution of every collision"},
                         {"mu", tangential.friction, "", "friction of collisions that slide"},
                         {"beta", tangential.beta, "", "tangential restitution of collisions that stick"},
                         {"dt", dt, s.in("s", "sqrt(d/g)"), "time step"},
                         {"v dt/d", s.fastest * dt / s.mean_diameter, "",
                          "way of the fastest grain of the start in a step; 0.3 is where a run stops"},
                         {"g dt^2/d", s.gravity * dt * dt / s.mean_diameter, "",
                          "how far grains at rest sink into each other, about"},
                         engines::memory_of_grains(s, 1500, 2500)};
  const auto pairs = pair_facts(s);
  list.insert(list.end(), pairs.begin(), pairs.end());
  return list;
}

double HybridMethod::seconds_per_step(const engines::Setting& s) const {
  // Measured on one core of a 2020s server with 300 grains of a dense flow.
  constexpr double per_grain = 0.3e-6, in_3d = 3;
  return per_grain * static_cast<double>(s.grains) * (s.dimensions == 3 ? in_3d : 1);
}

std::unique_ptr<Engine> HybridMethod::make(World<2> world, const engines::Setting& setting,
                                           int threads) const {
  return made(std::move(world), *this, setting, threads);
}
std::unique_ptr<Engine> HybridMethod::make(World<3> world, const engines::Setting& setting,
                                           int threads) const {
  return made(std::move(world), *this, setting, threads);
}

}  // namespace chute::hybrid
