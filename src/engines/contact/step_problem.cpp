#include "engines/contact/step_problem.hpp"

#include <algorithm>
#include <cmath>

#include "engines/contact/solver/delassus.hpp"
#include "engines/contact/solver/exact.hpp"
#include "engines/contact/solver/nsgs.hpp"
#include "engines/contact/solver/static_friction.hpp"

namespace chute::contact {
namespace {

/// Of the bound: a contact as near to its cone as this slides. The solver's local solution is on the cone to rounding.
constexpr double on_the_cone = 1e-9;

template <int D>
Vec<D> across(const Vec<turns<D>>& spin, const Vec<D>& arm) {
  if constexpr (D == 2)
    return {{-spin[0] * arm[1], spin[0] * arm[0]}};
  else
    return cross(spin, arm);
}

}  // namespace

template <int D>
StepProblem<D>::StepProblem(const ContactSetup<D>& setup, const Grains<D>& grains)
    : setup_(setup), grains_(grains) {
  for (auto& v : velocity_) v.assign(grains.size(), 0);
  for (auto& s : spin_) s.assign(grains.size(), 0);
}

template <int D>
Relative<D> StepProblem<D>::relative(const Touching<D>& t, const Bodies<D>& bodies, double time) const {
  const double R = grains_.radius[t.i];
  Relative<D> r{bodies.velocity[t.i] + across<D>(bodies.spin[t.i], -R * t.normal), {}};
  if (is_wall(t.j)) {
    r.wall = setup_.walls[t.j - grains_.size()].surface_velocity({R + t.gap, t.normal}, time);
    r.velocity = r.velocity - r.wall;
  } else if (moves(t.j)) {
    r.velocity =
        r.velocity - bodies.velocity[t.j] - across<D>(bodies.spin[t.j], grains_.radius[t.j] * t.normal);
  }
  return r;
}

template <int D>
void StepProblem<D>::add(Touching<D>& t, std::size_t k, const Relative<D>& start, double end,
                         const Bodies<D>& bodies) {
  const double h = setup_.time_step;
  const auto frame = frame_of(t.normal);
  auto contact = hard::contact_between(setup_, grains_, t.i, t.j);
  double mu_s = setup_.static_friction;
  if (!setup_.static_between.empty())
    mu_s = setup_.static_between(hard::material_of(grains_, setup_.walls, t.i),
                                 hard::material_of(grains_, setup_.walls, t.j));
  Vec<D> offset{};
  if (is_wall(t.j)) {
    const auto& own = setup_.walls[t.j - grains_.size()].surface;
    contact = contact.with(own);
    if (own.friction) mu_s = *own.friction;
    if (own.static_friction) mu_s = *own.static_friction;
    offset = -1.0 * (frame * relative(t, bodies, end).wall);
  }
  const Vec<D> u = frame * start.velocity;
  const bool bounces = setup_.impacts == Impacts::moreau && t.gap <= 0 && -u[0] > setup_.impact_velocity;
  offset[0] += bounces ? laws::restitution_at(contact.restitution, u[0]) * u[0] : std::max(t.gap, 0.0) / h;
  double slip = 0;
  for (int l = 1; l < D; ++l) slip += u[l] * u[l];
  const double mu_d = contact.tangential.friction;
  // What stuck at the last step's end sticks now, though the normal has turned a little since.
  const bool sticks = t.stuck || std::sqrt(slip) <= setup_.stick_velocity;
  posed_.push_back(k);
  a_.push_back(static_cast<std::int32_t>(t.i));
  b_.push_back(is_wall(t.j) ? -1 : static_cast<std::int32_t>(t.j));
  normal_.push_back(t.normal);
  arm_a_.push_back(-grains_.radius[t.i] * t.normal);
  arm_b_.push_back((is_wall(t.j) ? 0 : grains_.radius[t.j]) * t.normal);
  offset_.push_back(offset);
  impulse_.push_back(frame * t.impulse);
  friction_.push_back(mu_d), static_friction_.push_back(mu_s);
  bound_.push_back(sticks ? mu_s : mu_d);
  sticking_.push_back(sticks);
  two_frictions_ = two_frictions_ || mu_s > mu_d;
  start_.push_back(start);
}

template <int D>
void StepProblem<D>::pose(const Bodies<D>& bodies, std::vector<Touching<D>>& touching, double begin,
                          const Vec<D>& gravity) {
  const double h = setup_.time_step;
  posed_.clear(), a_.clear(), b_.clear(), normal_.clear(), arm_a_.clear(), arm_b_.clear(), offset_.clear(),
      impulse_.clear(), friction_.clear(), static_friction_.clear(), bound_.clear(), sticking_.clear(),
      start_.clear();
  two_frictions_ = false;
  for (std::size_t k = 0; k < touching.size(); ++k) {
    auto& t = touching[k];
    const auto start = relative(t, bodies, begin);
    const bool fast = -dot(start.velocity, t.normal) > setup_.impact_velocity;
    if (fast && t.gap > 0)
      t.impulse = {};
    else
      add(t, k, start, begin + h, bodies);
  }
  for (std::size_t i = 0; i < grains_.moving; ++i) {
    const Vec<D> v = bodies.velocity[i] + h * gravity;
    for (int k = 0; k < D; ++k) velocity_[static_cast<std::size_t>(k)][i] = v[k];
    for (int k = 0; k < turns<D>; ++k) spin_[static_cast<std::size_t>(k)][i] = bodies.spin[i][k];
  }
}

template <int D>
BodyArrays<D> StepProblem<D>::bodies() {
  BodyArrays<D> arrays;
  for (std::size_t k = 0; k < D; ++k) arrays.velocity[k] = velocity_[k];
  for (std::size_t k = 0; k < turns<D>; ++k) arrays.spin[k] = spin_[k];
  arrays.inverse_mass = grains_.inverse_mass, arrays.inverse_inertia = grains_.inverse_inertia;
  return arrays;
}
template <int D>
ContactArrays<D> StepProblem<D>::contacts() {
  return {a_, b_, normal_, arm_a_, arm_b_, bound_, offset_, impulse_};
}

template <int D>
Convergence StepProblem<D>::run(Team& team) {
  const Goal goal{setup_.tolerance, static_cast<long>(setup_.iterations),
                  setup_.reference_impulse * std::sqrt(static_cast<double>(grains_.moving))};
  const StaticFriction friction{static_friction_, friction_, sticking_, bound_};
  if (setup_.solver == SolverKind::exact) {
    auto problem = delassus(bodies(), contacts());
    const auto solve = [&](std::span<const double> bounds) {
      problem.friction.assign(bounds.begin(), bounds.end());
      auto solution = exact(problem, goal);
      impulse_ = std::move(solution.r);
      return solution.convergence;
    };
    const auto done =
        two_frictions_ ? with_static_friction(friction, solve, [&] { return impulse_; }) : solve(friction_);
    BodySystem<D>(bodies(), contacts(), team).hand_back(bodies(), contacts());
    return done;
  }
  BodySystem<D> system(bodies(), contacts(), team);
  const auto done = two_frictions_ ? nsgs(system, friction, goal, team) : nsgs(system, goal, team);
  system.hand_back(bodies(), contacts());
  return done;
}

/// Brings velocities and impulses to where they belong. Contacts do the work J·(u⁻ + u⁺)/2, exactly, for the velocity
/// within a step is the mean of both ends': what it takes from motion relative to the partner is lost.
template <int D>
void StepProblem<D>::take(Bodies<D>& bodies, std::vector<Touching<D>>& touching, double end,
                          EnergyAccount& account) {
  for (std::size_t i = 0; i < grains_.moving; ++i) {
    for (int k = 0; k < D; ++k) bodies.velocity[i][k] = velocity_[static_cast<std::size_t>(k)][i];
    for (int k = 0; k < turns<D>; ++k) bodies.spin[i][k] = spin_[static_cast<std::size_t>(k)][i];
  }
  for (std::size_t p = 0; p < posed_.size(); ++p) {
    auto& t = touching[posed_[p]];
    const auto& r = impulse_[p];
    t.impulse = out_of_frame(frame_of(t.normal), r);
    double shear = 0;
    for (int k = 1; k < D; ++k) shear += r[k] * r[k];
    shear = std::sqrt(shear);
    if (!(r[0] > 0)) {
      if (dot(t.hit, t.hit) == 0) t.state = ContactState::unknown, t.friction = 0;
      continue;
    }
    t.friction = bound_[p];
    t.state = shear >= (1 - on_the_cone) * bound_[p] * r[0] ? ContactState::slide : ContactState::stick;
    const auto now = relative(t, bodies, end);
    const Vec<D> mean = 0.5 * (start_[p].velocity + now.velocity);
    const double normal_part = r[0] * dot(mean, t.normal), all = dot(t.impulse, mean);
    account.normal_loss -= normal_part;
    account.shear_loss -= all - normal_part;
    account.wall_work += dot(t.impulse, 0.5 * (start_[p].wall + now.wall));
  }
}

template <int D>
Convergence StepProblem<D>::solve(Bodies<D>& bodies, std::vector<Touching<D>>& touching, double begin,
                                  const Vec<D>& gravity, EnergyAccount& account, Team& team) {
  pose(bodies, touching, begin, gravity);
  const auto done = run(team);
  take(bodies, touching, begin + setup_.time_step, account);
  return done;
}

template class StepProblem<2>;
template class StepProblem<3>;

}  // namespace chute::contact
