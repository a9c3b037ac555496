#include "engines/soft/soft_method.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "engines/kind/memory.hpp"
#include "engines/kind/soft_laws.hpp"
#include "engines/soft/bounce.hpp"
#include "engines/soft/clump_engine.hpp"

namespace chute::soft {
namespace {

/// The laws of contacts with a wall: empty if it has neither friction nor restitution of its own, and all are of one material.
std::optional<LawTable> table_of_wall(const engines::Setting& setting, const WallSurface& own) {
  if (setting.by_pair()) return LawTable(engines::laws_of_wall(setting, own));
  if (!own.friction && !own.restitution) return {};
  return LawTable(engines::laws_of_wall(setting, own).front());
}

template <int D>
std::unique_ptr<Engine> made(World<D> world, const SoftMethod& method, const engines::Setting& setting,
                             int threads) {
  SoftSetup<D> setup{world.surroundings()};
  setup.between = engines::laws_between(setting);
  setup.laws = setting.by_pair() ? setting.contact.laws_of_pair(setting.reference())
                                 : setting.contact.laws(setting.reference());
  for (const auto& wall : setup.walls) setup.wall_laws.push_back(table_of_wall(setting, wall.surface));
  setup.scheme = method.integrator;
  setup.ends = method.contact_ends;
  setup.time_step = method.step(setting);
  setup.skins = usual_skins<D>(setting.mean_diameter);
  setup.deepest_overlap = method.deepest_overlap;
  setup.contact_time = setting.contact.impact(setting.reference()).contact_time;
  setup.threads = setting.useful_threads(threads, SoftMethod::grains_per_thread);
  if (world.clumps.any())
    return std::make_unique<ClumpEngine<D>>(std::move(world.grains), std::move(world.clumps), setup);
  return std::make_unique<SoftEngine<D>>(std::move(world.grains), setup);
}

/// Residual of the energy account over gravity's work in flows, against decay = γ_s dt 7/(2 m_eff): where slip dies away within
/// few steps, the regularised friction force is integrated wrongly. Measured with 100 discs at 18 degrees, e_n = 0.6, μ = 0.5,
/// k_n = 1e5, 50 steps per contact, after 30 √(d/g), in which they made 30 to 100 d (README); k_n = 1e4 and 25 or 100 steps move the steep part by a factor of 3,
/// e_n = 0.9 with μ = 0.2 lies far below.
struct Measured {
  double decay, residual;
};
constexpr std::array<Measured, 7> gear5_residuals{
    {{0.05, 8e-5}, {0.11, 1e-4}, {0.16, 4e-3}, {0.22, 0.043}, {0.32, 0.25}, {0.45, 0.44}, {1, 0.54}}};
constexpr std::array<Measured, 6> verlet_residuals{
    {{0.02, 0.010}, {0.05, 0.014}, {0.11, 0.017}, {0.32, 0.021}, {1, 0.023}, {1.5, 0.040}}};

double residual_at(double decay, std::span<const Measured> table) {
  if (decay <= table.front().decay) return table.front().residual;
  for (std::size_t k = 1; k < table.size(); ++k) {
    if (decay > table[k].decay) continue;
    const auto &a = table[k - 1], &b = table[k];
    return a.residual *
           std::pow(b.residual / a.residual, std::log(decay / a.decay) / std::log(b.decay / a.decay));
  }
  return table.back().residual;
}

/// γ_s dt 7/(2 m_eff) of the law of a scene; nothing if it is another law.
std::optional<double> slip_decay(const engines::Setting& s, double dt) {
  for (const auto& fact : laws::step_facts(s.contact, s.si, s.pairs.front(), dt))
    if (fact.name.starts_with("gamma_s dt")) return fact.value;
  return {};
}

/// Of two mean grains. Where a law does not name a speed any is right at which they stay nearly round.
std::optional<BounceError> error_of_bounces(const engines::Setting& s, const Stepping& stepping) {
  const auto pair = s.reference();
  const double t_n = s.contact.impact(pair).contact_time;
  constexpr double shallow = 1e-3;  // of a radius, in half a contact time
  const double speed = s.contact.at_velocity().value_or(shallow * 2 * pair.r_eff / t_n);
  const auto contact = s.by_pair() ? s.contact.laws_of_pair(pair) : s.contact.laws(pair);
  return bounce_error(contact, pair, speed, laws::normal_impact(contact, speed, pair), stepping);
}

}  // namespace

Offers SoftMethod::offers() const {
  return {.contacts = true,
          .forces = true,
          .impacts = true,
          .independent = true,
          .clumps = true,
          .walls = true,
          .wall_shapes = true,
          .wall_motion = true,
          .wall_surfaces = true,
          .materials = true,
          .tilting = true,
          .open = true,
          .threads = true};
}

std::optional<Refusal> SoftMethod::refusal(const engines::Setting& s) const {
  return engines::refusal_of_own_laws(s);
}

double SoftMethod::step(const engines::Setting& s) const {
  if (time_step) return *time_step;
  return engines::step_dividing(s.between_outputs,
                                engines::shortest_contact(s).contact_time / steps_per_contact);
}

std::vector<Fact> SoftMethod::facts(const engines::Setting& s) const {
  auto list = laws::impact_facts(s.contact, s.si, s.pairs);
  const auto pairs = engines::facts_of_pairs(s);
  list.insert(list.end(), pairs.begin(), pairs.end());
  const double dt = step(s);
  const auto least = engines::shortest_contact(s);
  if (s.stiffest || s.by_pair())
    list.push_back({"t_n/dt least", least.contact_time / dt, "",
                    "steps in the contact of " + least.who + ", which sets dt"});
  const auto rest = laws::step_facts(s.contact, s.si, s.pairs.front(), dt);
  list.insert(list.end(), rest.begin(), rest.end());
  if (const auto error = error_of_bounces(s, {integrator, contact_ends, dt}))
    list.push_back(
        {"e_n error", error->worst, "",
         fmt::format(
             "most by which a bounce of that pair misses e_n, by the moment in a step at which it begins "
             "(mean {:+.1g})",
             error->mean)});
  if (const auto decay = slip_decay(s, dt))
    list.push_back({"residual", 100 * expected_residual(*decay), "%",
                    "of gravity's work that the energy account is off by in dense flows, about"});
  list.push_back(engines::memory_of_grains(s, 900, 1200));
  return list;
}

double SoftMethod::expected_residual(double decay) const {
  return integrator == Scheme::gear5 ? residual_at(decay, gear5_residuals)
                                     : residual_at(decay, verlet_residuals);
}

std::vector<std::string> SoftMethod::warnings(const engines::Setting& s) const {
  constexpr double good = 0.08, begins = 0.1;  // of the decay of slip in a step
  constexpr double fewest_steps = 5;           // as steps_per_contact has it
  const double dt = step(s), t_n = engines::shortest_contact(s).contact_time;
  std::vector<std::string> told;
  if (time_step && t_n / dt < fewest_steps)
    told.push_back(fmt::format(
        "engine.time_step = {:.3g} is {:.2g} contact times: a contact takes t_n = {:.3g}, and needs steps of {:.2g} or less",
        dt, dt / t_n, t_n, t_n / fewest_steps));
  // A contact between equal grains is a spring of k = m_eff (π/t_n)²: what it gives way by at a speed, and under a weight.
  constexpr double rigid = 0.1;   // of a diameter; beyond it overlaps are no small deformations
  constexpr double small = 0.05;  // of a diameter: what the advice leads to with a linear spring
  const double frequency = std::numbers::pi / t_n, d = s.resolved_diameter();
  const double at_impact = s.fastest / frequency / d, at_rest = 2 * s.gravity / (frequency * frequency) / d;
  if (at_impact > rigid)
    told.push_back(fmt::format(
        "the fastest grains of the start overlap by {:.2g} diameters when they meet: give a stiffness about {:.2g} times as large, or start slower",
        at_impact, std::pow(at_impact / small, 2)));
  if (at_rest > rigid)
    told.push_back(fmt::format(
        "a grain sinks {:.2g} diameters into another one under its own weight: give a stiffness about {:.2g} times as large",
        at_rest, at_rest / small));
  const auto decay = slip_decay(s, dt);
  const auto* law = std::get_if<laws::RegularisedCoulomb>(&s.contact.tangential);
  if (!decay || !law || *decay < begins || (!told.empty())) return told;
  told.push_back(fmt::format(
      "gamma_s dt 7/2m = {:.2g}: slip dies away within a few steps, and the energy account of a dense flow is off by about {:.2g} % of gravity's "
      "work; give steps_per_contact = {:.0f}, contact.tangential.viscosity = {:.3g} or relaxation_steps = 12",
      *decay, 100 * expected_residual(*decay), std::ceil(t_n / dt * *decay / good),
      law->viscosity * good / *decay));
  return told;
}

double SoftMethod::seconds_per_step(const engines::Setting& s) const {
  // Measured on one core of a 2020s server with 300 grains; a single grain is bound by the cost of a step.
  constexpr double step_cost = 0.25e-6, grain_steps_per_second = 120e6, in_3d = 4;
  return step_cost + static_cast<double>(s.grains) / grain_steps_per_second * (s.dimensions == 3 ? in_3d : 1);
}

std::unique_ptr<Engine> SoftMethod::make(World<2> world, const engines::Setting& setting, int threads) const {
  return made(std::move(world), *this, setting, threads);
}
std::unique_ptr<Engine> SoftMethod::make(World<3> world, const engines::Setting& setting, int threads) const {
  return made(std::move(world), *this, setting, threads);
}

}  // namespace chute::soft
