#include "engines/contact/contact_method.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engines/contact/contact_engine.hpp"
#include "engines/kind/memory.hpp"

namespace chute::contact {
namespace {

/// A further thread pays for so many moving grains: fewer contacts are solved by one anyway.
constexpr std::int64_t grains_per_thread = 1000;

double impact_velocity_of(const ContactMethod& method, const engines::Setting& s) {
  constexpr double steps_of_gravity = 4;
  return method.impact_velocity.value_or(steps_of_gravity * s.gravity * method.step(s));
}
double stick_velocity_of(const ContactMethod& method, const engines::Setting& s) {
  constexpr double still = 1e-6;
  return method.stick_velocity.value_or(still * std::sqrt(s.gravity * s.mean_diameter));
}

/// μ_s where two materials meet: their own, or that of sliding where that is their own.
double static_friction_of(const ContactMethod& method, const engines::Setting& s,
                          const engines::MeetingMaterials& two) {
  const double mu = method.walton(s, two).friction;
  if (two.own && two.own->static_friction) return *two.own->static_friction;
  return method.own_friction(two) ? mu : method.static_friction.value_or(mu);
}

template <int D>
std::unique_ptr<Engine> made(World<D> world, const ContactMethod& method, const engines::Setting& s,
                             int threads) {
  ContactSetup<D> setup{world.surroundings()};
  setup.contact = {laws::ConstantRestitution{method.e_n(s)}, method.walton(s)};
  setup.static_friction = method.static_friction.value_or(setup.contact.tangential.friction);
  if (s.by_pair()) {
    setup.between = s.for_pairs(setup.contact, [&](const engines::MeetingMaterials& two) {
      return hard::HardContact{laws::ConstantRestitution{method.e_n(s, two)}, method.walton(s, two)};
    });
    setup.static_between = s.for_pairs(setup.static_friction, [&](const engines::MeetingMaterials& two) {
      return static_friction_of(method, s, two);
    });
  }
  setup.time_step = method.step(s);
  setup.diameter = s.resolved_diameter();
  setup.reference_impulse = setup.time_step * s.mean_mass * s.gravity;
  setup.impact_velocity = impact_velocity_of(method, s);
  setup.stick_velocity = stick_velocity_of(method, s);
  setup.tolerance = method.tolerance, setup.iterations = method.iterations;
  setup.relaxation = method.relaxation;
  setup.impacts = method.impacts, setup.solver = method.solver;
  setup.threads = s.useful_threads(threads, grains_per_thread);
  return std::make_unique<ContactEngine<D>>(std::move(world.grains), setup);
}

}  // namespace

Offers ContactMethod::offers() const {
  return {.contacts = true,
          .impacts = true,
          .walls = true,
          .wall_shapes = true,
          .wall_motion = true,
          .wall_surfaces = true,
          .wall_sticking = true,
          .static_friction = true,
          .materials = true,
          .tilting = true,
          .threads = true};
}

std::optional<Refusal> ContactMethod::refusal(const engines::Setting& s) const {
  const double mu = walton(s).friction;
  const auto too_little = [](double mu_s, double mu_d, const std::string& key) -> std::optional<Refusal> {
    if (mu_s >= mu_d) return {};
    return Refusal{key,
                   fmt::format("{:.6g} is less than the friction of sliding, {:.6g}: what sticks holds at "
                               "least as much",
                               mu_s, mu_d)};
  };
  if (static_friction)
    if (auto r = too_little(*static_friction, mu, "engine.static_friction")) return r;
  for (std::size_t w = 0; w < s.wall_surfaces.size(); ++w) {
    const auto& own = s.wall_surfaces[w];
    if (own.static_friction)
      if (auto r = too_little(*own.static_friction, own.friction.value_or(mu),
                              fmt::format("wall[{}].static_friction", w)))
        return r;
  }
  for (const auto& two : s.meetings())
    if (two.own && two.own->static_friction)
      if (auto r = too_little(*two.own->static_friction, walton(s, two).friction,
                              fmt::format("contact.between[{}].static_friction", two.place)))
        return r;
  return {};
}

double ContactMethod::step(const engines::Setting& s) const {
  if (time_step) return *time_step;
  constexpr double usual = 0.01, way = 0.02;  // of √(d/g); without gravity, of d in a step
  const double d = s.mean_diameter;
  double longest = s.duration / 100;
  if (s.gravity > 0)
    longest = std::min(longest, usual * std::sqrt(d / s.gravity));
  else if (s.fastest > 0)
    longest = std::min(longest, way * d / s.fastest);
  return engines::step_dividing(s.between_outputs, longest);
}

std::vector<Fact> ContactMethod::facts(const engines::Setting& s) const {
  const auto tangential = walton(s);
  const double h = step(s);
  std::vector<Fact> list{
      {"e_n", e_n(s), "",
       impacts == Impacts::walton ? "restitution of fast approaches, one collision after the other (Walton)"
                                  : "restitution of fast approaches, all at once (Moreau)"},
      {"mu_d", tangential.friction, "", "friction of contacts that slide"},
      {"mu_s", static_friction.value_or(tangential.friction), "", "friction that contacts at rest reach"},
      {"beta", tangential.beta, "", "tangential restitution of Walton's collisions that stick"},
      {"h", h, s.in("s", "sqrt(d/g)"), "time step"},
      {"v_impact", impact_velocity_of(*this, s), s.in("m/s", "sqrt(g d)"), "faster approaches bounce"},
      {"v h/d", s.fastest * h / s.mean_diameter, "",
       "way of the fastest grain of the start in a step; 0.3 is where a run stops"},
      {"tolerance", tolerance, "h m g √N", "residual of all contacts at the end of each step"},
      engines::memory_of_grains(s, 1800, 3000)};
  const auto pairs = pair_facts(s);
  list.insert(list.end(), pairs.begin(), pairs.end());
  return list;
}

double ContactMethod::seconds_per_step(const engines::Setting& s) const {
  // Measured on one core of a 2020s server with 300 grains of a dense flow, converged to 1e-6.
  constexpr double per_grain = 5e-6, in_3d = 4;
  return per_grain * static_cast<double>(s.grains) * (s.dimensions == 3 ? in_3d : 1);
}

std::unique_ptr<Engine> ContactMethod::make(World<2> world, const engines::Setting& setting,
                                            int threads) const {
  return made(std::move(world), *this, setting, threads);
}
std::unique_ptr<Engine> ContactMethod::make(World<3> world, const engines::Setting& setting,
                                            int threads) const {
  return made(std::move(world), *this, setting, threads);
}

}  // namespace chute::contact
