#include "engines/event/event_method.hpp"

#include "engines/event/event_engine.hpp"
#include "engines/hard/contacts_of.hpp"
#include "engines/kind/memory.hpp"

namespace chute::event {
namespace {

double cut_off(const EventMethod& method, const engines::Setting& s) {
  return method.contact_time.value_or(s.contact.impact(s.reference()).contact_time);
}

template <int D>
std::unique_ptr<Engine> made(World<D> world, const EventMethod& method, const engines::Setting& setting) {
  EventSetup<D> setup{world.surroundings()};
  hard::set_contacts(setup, method, setting);
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
