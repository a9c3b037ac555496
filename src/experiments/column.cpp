#include "experiments/column.hpp"

#include <cmath>

#include "common/error.hpp"

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

double Column::contact_time() const {
  return laws::normal_impact(laws, speed, pair_of(grain, grain)).contact_time;
}

ColumnOutcome hit_wall(const Column& column) {
  const auto& grain = column.grain;
  const double t_n = column.contact_time(), gap = column.speed * column.gap_time * t_n;
  const double dt = t_n / column.steps_per_contact;
  Grains<2> grains;
  Ball<2> ball = grain;
  ball.velocity = {{-column.speed, 0}};
  for (int k = 1; k <= column.count; ++k) add_ball(grains, ball, {{k * (2 * grain.radius + gap), 0}});
  Ball<2> wall = grain;  // in one dimension a fixed grain is as good
  wall.velocity = {}, wall.fixed = true;
  add_ball(grains, wall, {});
  soft::SoftEngine<2> engine(std::move(grains), free_space<2>(column.laws, dt, 2 * grain.radius));

  const double patience = 1000.0 * column.count * (1 + column.gap_time) * t_n, lead = gap / column.speed;
  const auto between =
      static_cast<std::int64_t>(std::ceil(column.steps_per_contact));  // looks: one per contact time
  step_until<2>(engine, column.watch, lead, patience, "the column does not disperse", [&] {
    return engine.step() % between == 0 && engine.contacts().empty() && dispersing(engine.state());
  });

  double momentum = 0, energy = 0;
  for (const double v : std::span(engine.state().velocity[0]).first(engine.state().moving))
    momentum += v / column.speed, energy += v * v / (column.speed * column.speed);
  return {momentum / column.count, std::sqrt(energy / column.count), engine.time() - lead};
}

}  // namespace chute::experiments
