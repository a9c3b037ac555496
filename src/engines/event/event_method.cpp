#include "engines/event/event_method.hpp"

#include "engines/event/event_engine.hpp"
#include "engines/kind/memory.hpp"

namespace chute::event {
namespace {

double cut_off(const EventMethod& method, const engines::Setting& s) {
  return method.contact_time.value_or(s.contact.impact(s.reference()).contact_time);
}

template <int D>
std::unique_ptr<Engine> made(World<D> world, const EventMethod& method, const engines::Setting& setting) {
  EventSetup<D> setup{world.surroundings()};
  const auto contact = [&](double e_n, const laws::Walton& tangential) {
    hard::HardContact made{laws::ConstantRestitution{e_n}, tangential};
    if (method.restitution_velocity)
      made.restitution =
          laws::PowerLawRestitution{1 - e_n, *method.restitution_velocity, method.restitution_exponent};
    return made;
  };
  setup.contact = contact(method.e_n(setting), method.walton(setting));
  if (setting.by_pair())
    setup.between = setting.for_pairs(setup.contact, [&](const engines::MeetingMaterials& two) {
      return contact(method.e_n(setting, two), method.walton(setting, two));
    });
  setup.contact_time = cut_off(method, setting);
  setup.tick = method.step(setting);
  setup.seed = setting.seed;
  return std::make_unique<EventEngine<D>>(std::move(world.grains), setup);
}

}  // namespace

Offers EventMethod::offers() const {
  return {.contacts = true,
          .collisions = true,
          .impacts = true,
          .independent = true,
          .walls = true,
          .wall_shapes = true,
          .wall_motion = true,
          .wall_surfaces = true,
          .wall_sticking = true,
          .wall_temperatures = true,
          .materials = true};
}

std::vector<Fact> EventMethod::facts(const engines::Setting& s) const {
  auto list = walton_facts(s);
  const auto pairs = pair_facts(s);
  list.insert(list.end(), pairs.begin(), pairs.end());
  list.push_back({"t_c", cut_off(*this, s), s.in("s", "sqrt(d/g)"),
                  "collisions of a pair that follow each other faster are elastic"});
  list.push_back(engines::memory_of_grains(s, 1000, 1300));
  return list;
}

std::unique_ptr<Engine> EventMethod::make(World<2> world, const engines::Setting& setting, int) const {
  return made(std::move(world), *this, setting);
}
std::unique_ptr<Engine> EventMethod::make(World<3> world, const engines::Setting& setting, int) const {
  return made(std::move(world), *this, setting);
}

}  // namespace chute::event
