#include "experiments/column.hpp"

#include "common/error.hpp"
#include "soft/soft_engine.hpp"

namespace chute::experiments {
namespace {

/// Do all grains move away from the wall, none faster than the next?
bool dispersing(const Grains<2>& grains) {
  double slower = 0;
  for (std::size_t k = 0; k < grains.moving; ++k) {
    if (grains.velocity[0][k] < slower) return false;
    slower = grains.velocity[0][k];
  }
  return true;
}

}  // namespace

double total_restitution(const Column& column) {
  // Linear forces: only t_0/t_n matters, as long as overlaps are small against the grains.
  constexpr double radius = 0.5, mass = 1, speed = 1, stiffness = 1e8;
  const auto law = laws::SpringDashpot::from_restitution(stiffness, column.restitution);
  const double t_n = law.contact_time(mass / 2), gap = speed * column.gap_time * t_n;
  soft::SoftSetup<2> setup;
  setup.laws = {law, laws::Frictionless{}};
  setup.time_step = t_n / column.steps_per_contact;
  setup.skins = soft::usual_skins<2>(2 * radius);
  Grains<2> grains;
  const double inertia = 0.4 * mass * radius * radius;
  for (int k = 1; k <= column.count; ++k) {
    grains.add({{k * (2 * radius + gap), 0}}, radius, mass, inertia, true);
    grains.velocity[0].back() = -speed;
  }
  grains.add({}, radius, mass, inertia, false);  // the wall: in one dimension a fixed grain is as good
  soft::SoftEngine<2> engine(std::move(grains), setup);

  const auto look = static_cast<std::int64_t>(column.steps_per_contact);
  const double patience = 1000.0 * column.count * (1 + column.gap_time);
  do {
    engine.advance_to(engine.step() + look);
    if (static_cast<double>(engine.step()) > patience * column.steps_per_contact)
      throw WorkError("the column does not disperse");
  } while (!engine.contacts().empty() || !dispersing(engine.state()));

  double sum = 0;
  for (std::size_t k = 0; k < engine.state().moving; ++k) sum += engine.state().velocity[0][k];
  return sum / (column.count * speed);
}

}  // namespace chute::experiments
