#include "experiments/brake_failure.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "common/error.hpp"

namespace chute::experiments {

laws::Pair BrakeFailure::pair() const {
  Ball<2> wall;
  wall.radius = wall_radius, wall.fixed = true;
  return pair_of(ball, wall);
}
double BrakeFailure::approach() const { return ball.velocity[0] * std::sqrt(1 - sine * sine); }
double BrakeFailure::shortest_time() const {
  const double chord = 2 * reach() * std::sqrt(1 - sine * sine);
  return std::min(laws::normal_impact(laws, approach(), pair()).contact_time, chord / ball.velocity[0]);
}

BrakeFailureOutcome skim(const BrakeFailure& experiment) {
  const double reach = experiment.reach(), spacing = 2 * experiment.wall_radius;
  const double dt = experiment.shortest_time() / experiment.steps, lead = 2.5 * dt;
  Grains<2> grains;
  const double first = -reach * std::sqrt(1 - experiment.sine * experiment.sine);
  add_ball(grains, experiment.ball, {{first - lead * experiment.ball.velocity[0], reach * experiment.sine}});
  Ball<2> wall;
  wall.radius = experiment.wall_radius, wall.mass = experiment.ball.mass, wall.fixed = true;
  for (int k = 0; k < experiment.count; ++k) add_ball(grains, wall, {{k * spacing, 0}});
  soft::SoftEngine<2> engine(std::move(grains), free_space<2>(experiment.laws, dt, spacing));

  BrakeFailureOutcome outcome;
  std::set<std::int64_t> touched;
  const double end = (experiment.count - 1) * spacing + reach;
  const double patience = 100 * (end - first) / experiment.ball.velocity[0] + 1000 * experiment.steps * dt;
  step_until<2>(engine, experiment.watch, lead, patience, "the ball does not leave the wall", [&] {
    const auto contacts = engine.contacts();
    for (const auto& contact : contacts) {
      touched.insert(contact.b);
      outcome.deepest = std::max(outcome.deepest, contact.overlap);
      outcome.duration = engine.time() - lead;
    }
    const auto place = engine.state().place(0);
    const bool outside = place[0] > end || place[0] < 2 * first - reach || std::abs(place[1]) > reach;
    return contacts.empty() && outside;
  });
  outcome.touched = static_cast<int>(touched.size());
  outcome.ball = experiment.ball;
  outcome.ball.velocity = engine.state().speed(0);
  outcome.ball.spin[0] = engine.state().spin[0][0];
  return outcome;
}

}  // namespace chute::experiments
