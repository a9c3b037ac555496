#include "engines/lammps/lammps_method.hpp"

#include "common/error.hpp"
#include "engines/kind/soft_laws.hpp"
#include "engines/lammps/lammps_engine.hpp"

namespace chute::lammps {
namespace {

template <int D>
std::unique_ptr<Engine> made(World<D> world, const LammpsMethod& method, const engines::Setting& setting,
                             int ranks) {
  LammpsSetup setup;
  setup.time_step = method.step(setting);
  auto deck = make_deck<D>(world, setting, setup.time_step);
  if (deck.wrong) throw InputError(deck.wrong->key + ": " + deck.wrong->message);
  setup.deck = std::move(deck.deck);
  setup.ranks = ranks;
  if (method.dumps) setup.dumps = *method.dumps;
  return std::make_unique<LammpsEngine<D>>(std::move(world), std::move(setup));
}

}  // namespace

Offers LammpsMethod::offers() const {
  return {.contacts = true,
          .forces = true,
          .walls = true,
          .wall_motion = true,
          .wall_surfaces = true,
          .materials = true};
}

std::optional<Refusal> LammpsMethod::refusal(const engines::Setting& s) const { return refusal_of_laws(s); }

double LammpsMethod::step(const engines::Setting& s) const {
  if (time_step) return *time_step;
  return engines::step_dividing(s.between_outputs,
                                engines::shortest_contact(s).contact_time / steps_per_contact);
}

std::vector<Fact> LammpsMethod::facts(const engines::Setting& s) const {
  auto list = laws::impact_facts(s.contact, s.si, s.pairs);
  const auto pairs = engines::facts_of_pairs(s);
  list.insert(list.end(), pairs.begin(), pairs.end());
  const auto rest = laws::step_facts(s.contact, s.si, s.pairs.front(), step(s));
  list.insert(list.end(), rest.begin(), rest.end());
  return list;
}

double LammpsMethod::seconds_per_step(const engines::Setting& s) const {
  // Measured on one core: a step of a few grains is bound by LAMMPS's own overhead.
  constexpr double step_cost = 3e-6, grain_steps_per_second = 20e6;
  return step_cost + static_cast<double>(s.grains) / grain_steps_per_second;
}

std::unique_ptr<Engine> LammpsMethod::make(World<2> world, const engines::Setting& setting, int ranks) const {
  return made(std::move(world), *this, setting, ranks);
}
std::unique_ptr<Engine> LammpsMethod::make(World<3> world, const engines::Setting& setting, int ranks) const {
  return made(std::move(world), *this, setting, ranks);
}

}  // namespace chute::lammps
