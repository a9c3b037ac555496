#include "engines/soft/soft_method.hpp"

#include <algorithm>
#include <cmath>

#include "engines/soft/soft_engine.hpp"

namespace chute::soft {
namespace {

/// The laws of contacts with a wall that has friction or restitution of its own; empty if it has none. A restitution is
/// that of the reference pair where it depends on the pair.
std::optional<laws::ContactLaws> own_laws(const engines::Setting& setting, const WallSurface& own) {
  if (!own.friction && !own.restitution) return {};
  laws::ContactSpec contact = setting.contact;
  if (own.restitution) laws::set_restitution(contact.normal, *own.restitution);
  auto laws = contact.laws(setting.reference());
  if (own.friction) *laws::friction(laws.shear) = *own.friction;
  return laws;
}

template <int D>
std::unique_ptr<Engine> made(World<D> world, const SoftMethod& method, const engines::Setting& setting,
                             int threads) {
  SoftSetup<D> setup{world.surroundings()};
  setup.laws = setting.contact.laws(setting.reference());
  const auto beds_own = setup.walls.size() - setting.wall_surfaces.size();  // a flat bed is the first
  setup.wall_laws.resize(beds_own);
  for (const auto& own : setting.wall_surfaces) setup.wall_laws.push_back(own_laws(setting, own));
  setup.scheme = method.integrator;
  setup.time_step = method.step(setting);
  setup.skins = usual_skins<D>(setting.mean_diameter);
  setup.deepest_overlap = method.deepest_overlap;
  setup.contact_time = setting.contact.impact(setting.reference()).contact_time;
  setup.threads = setting.useful_threads(threads, SoftMethod::grains_per_thread);
  return std::make_unique<SoftEngine<D>>(std::move(world.grains), setup);
}

}  // namespace

Offers SoftMethod::offers() const {
  return {.contacts = true,
          .impacts = true,
          .independent = true,
          .walls = true,
          .wall_shapes = true,
          .wall_motion = true,
          .wall_surfaces = true,
          .tilting = true,
          .threads = true};
}

std::optional<Refusal> SoftMethod::refusal(const engines::Setting& s) const {
  for (std::size_t w = 0; w < s.wall_surfaces.size(); ++w) {
    const auto& own = s.wall_surfaces[w];
    const auto refuse = [&](const char* key, const char* what) {
      return Refusal{"wall[" + std::to_string(w) + "]." + key, what};
    };
    auto shear = s.contact.laws(s.reference()).shear;
    if (own.friction && !laws::friction(shear))
      return refuse("friction", "the law of [contact.tangential] has no friction");
    auto normal = s.contact.normal;
    if (own.restitution && *own.restitution == 0)
      return refuse("restitution", "0 is not allowed for soft grains, must be > 0");
    if (own.restitution && !laws::set_restitution(normal, *own.restitution))
      return refuse("restitution", "the law of [contact.normal] takes no restitution");
  }
  return {};
}

double SoftMethod::step(const engines::Setting& s) const {
  if (time_step) return *time_step;
  const double t_n = s.contact.impact(s.reference(), s.shortest().pair).contact_time;
  return engines::step_dividing(s.between_outputs, t_n / steps_per_contact);
}

std::vector<Fact> SoftMethod::facts(const engines::Setting& s) const {
  auto list = laws::impact_facts(s.contact, s.si, s.pairs);
  const double dt = step(s), t_n = s.contact.impact(s.reference(), s.shortest().pair).contact_time;
  if (s.stiffest)
    list.push_back(
        {"t_n/dt least", t_n / dt, "", "steps in the contact of " + s.stiffest->name + ", which sets dt"});
  const auto rest = laws::step_facts(s.contact, s.si, s.pairs.front(), dt);
  list.insert(list.end(), rest.begin(), rest.end());
  return list;
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
