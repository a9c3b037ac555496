#include "experiments/binary_impact.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/error.hpp"

namespace chute::experiments {
namespace {

template <int D>
double energy(const Ball<D>& i, const Ball<D>& j) {
  const auto dv = j.velocity - i.velocity;
  double sum = 0.5 * pair_of(i, j).m_eff * dot(dv, dv);
  for (const auto* b : {&i, &j})
    if (!b->fixed) sum += 0.5 * b->inertia() * dot(b->spin, b->spin);
  return sum;
}

/// The direction `along` in the contact plane of n, carried on to the plane of n_after.
template <int D>
Vec<D> turned(const Vec<D>& along, const Vec<D>& n, const Vec<D>& n_after) {
  if constexpr (D == 2) {
    const double side = along[0] * n[1] - along[1] * n[0];
    return side * Vec<2>{{n_after[1], -n_after[0]}};
  } else {
    const auto axis = cross(n, n_after);
    const double cosine = dot(n, n_after);
    return cosine * along + cross(axis, along) + (dot(axis, along) / (1 + cosine)) * axis;
  }
}

template <int D>
Ball<D> after(const Grains<D>& grains, std::size_t k, Ball<D> ball) {
  ball.velocity = grains.speed(k);
  for (int c = 0; c < turns<D>; ++c) ball.spin[c] = grains.spin[c][k];
  return ball;
}

template <int D>
Vec<D> direction(const Grains<D>& grains) {
  const auto way = grains.place(1) - grains.place(0);
  return (1 / norm(way)) * way;
}

}  // namespace

template <int D>
double BinaryImpact<D>::shortest_time() const {
  const Vec<D> dv = j.velocity - i.velocity;
  const double passing = 2 * (i.radius + j.radius) * approach() / dot(dv, dv);
  return std::min(laws::normal_impact(laws, approach(), pair()).contact_time, passing);
}

template <int D>
ImpactOutcome<D> collide(const BinaryImpact<D>& impact) {
  const auto& [law, i, j, n, steps, trace, scheme, origin, watch] = impact;
  const double v_n = -impact.approach(), reach = i.radius + j.radius;
  if (!(v_n < 0)) throw std::invalid_argument("these grains do not approach");

  ImpactOutcome<D> outcome;
  outcome.v_n_before = v_n;
  const auto slip = laws::surface_slip(n, i.collider(), j.collider());
  const double v_s = norm(slip);
  outcome.psi_before = v_s / -v_n;
  outcome.energy_before = energy(i, j);

  auto setup = free_space<D>(law, impact.shortest_time() / steps, reach);
  setup.scheme = scheme;
  const double lead = 2.5 * setup.time_step;  // the first force acts half a step after the surfaces met
  Grains<D> grains;
  add_ball(grains, i, origin - lead * i.velocity);
  add_ball(grains, j, origin + reach * n - lead * j.velocity);
  soft::SoftEngine<D> engine(std::move(grains), setup);

  if (!trace && !watch)
    engine.advance_to(static_cast<std::int64_t>(0.4 * steps));  // no contact ends so early
  bool touched = false;
  const double patience = engine.time() + 1000 * steps * setup.time_step;
  step_until<D>(engine, watch, lead, patience, "the grains do not part", [&, trace = trace] {
    const auto contacts = engine.contacts();
    touched |= !contacts.empty();
    if (trace && !contacts.empty())
      outcome.trace.push_back(
          {engine.time() - lead, contacts[0].overlap, contacts[0].normal_force, contacts[0].shear_force});
    return contacts.empty() && (touched || engine.time() > 2 * lead);
  });
  outcome.contact_time = engine.time() - lead;
  outcome.i = after(engine.state(), 0, i);
  outcome.j = after(engine.state(), 1, j);
  outcome.normal = direction(engine.state());
  outcome.v_n_after = dot(outcome.j.velocity - outcome.i.velocity, outcome.normal);
  if (v_s > 0) {
    const auto along = turned((1 / v_s) * slip, n, outcome.normal);
    const auto slip_after = laws::surface_slip(outcome.normal, outcome.i.collider(), outcome.j.collider());
    outcome.psi_after = dot(slip_after, along) / -v_n;
  }
  outcome.energy_after = energy(outcome.i, outcome.j);
  const auto account = engine.energy();
  outcome.normal_loss = account.normal_loss;
  outcome.shear_loss = account.shear_loss;
  return outcome;
}

template struct BinaryImpact<2>;
template struct BinaryImpact<3>;
template ImpactOutcome<2> collide(const BinaryImpact<2>&);
template ImpactOutcome<3> collide(const BinaryImpact<3>&);

BinaryImpact<2> Acetate::meet(const laws::ContactLaws& laws, double v, double theta, double steps) {
  BinaryImpact<2> impact;
  impact.laws = laws;
  impact.normal = {{1, 0}};
  // s = (n_y, −n_x) = (0, −1): v_s > 0, half of the motion on each grain
  impact.i = {radius, mass, {{0.5 * v * std::cos(theta), 0.5 * v * std::sin(theta)}}, {}, false};
  impact.j = {radius, mass, {{-0.5 * v * std::cos(theta), -0.5 * v * std::sin(theta)}}, {}, false};
  impact.steps = steps;
  return impact;
}

}  // namespace chute::experiments
