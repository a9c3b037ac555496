#include "engines/contact/contact_engine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cereal/types/array.hpp>
#include <cereal/types/vector.hpp>
#include <cmath>

#include "common/error.hpp"
#include "common/state_archive.hpp"
#include "core/not_a_number.hpp"
#include "engines/kind/deep_start.hpp"

namespace chute::contact {
namespace {

/// Surfaces nearer than this part of d in the middle of a step may touch within it.
constexpr double margin = 0.1;

/// Skins of the neighbour list, parts of d: grains move some hundredths of d in a step.
constexpr double near_skin = 0.15, far_skin = 0.5;

/// A grain may not move farther than this part of d in a step: it might pass another.
constexpr double farthest_move = 0.3;

}  // namespace

void SolverRecord::add(const Convergence& step) {
  ++steps;
  iterations += step.iterations;
  most_iterations = std::max<std::int64_t>(most_iterations, step.iterations);
  unconverged += !step.reached;
  worst_residual = std::max(worst_residual, step.residual);
  last_iterations = step.iterations;
  last_residual = step.residual;
}

template <int D>
ContactEngine<D>::ContactEngine(Grains<D> grains, const ContactSetup<D>& setup)
    : setup_(setup),
      grains_(std::move(grains)),
      grown_(grains_),
      list_(setup.domain, {near_skin * setup.diameter, far_skin * setup.diameter}),
      walton_(setup_, grains_),
      problem_(setup_, grains_),
      projection_(setup_, grains_),
      touches_(grains_.moving, setup.time_step),
      struck_grains_(grains_.moving, 0),
      team_(std::make_unique<Team>(setup.threads)) {
  for (double& R : grown_.radius) R += margin * setup_.diameter / 2;
  const auto moving = grains_.moving;
  bodies_.middle.resize(moving), bodies_.velocity.resize(moving), bodies_.spin.resize(moving);
  for (auto& f : force_) f.assign(grains_.size(), 0);
  wrap_into(setup_.domain, grains_);
  engines::refuse_deep_start<D>(grains_, setup_, engines::deepest_that_is_pushed_apart);
  start_place_ = unwrapped_places<D>(this->grains());
  account_.start = energy().stored();
}

template <int D>
void ContactEngine<D>::advance(std::int64_t step) {
  if (step <= step_) return;
  while (step_ < step) take_step();
  show();
  for (std::size_t i = 0; i < grains_.moving; ++i)
    if (grains_.position[D - 1][i] < setup_.floor) leave_physics(i, "it fell through the bed");
}

template <int D>
void ContactEngine<D>::take_step() {
  const double h = setup_.time_step, begin = static_cast<double>(step_) * h;
  const Vec<D> gravity = setup_.gravity_at(begin + h / 2);
  fly_half();
  find_touching(begin + h / 2);
  bounce(begin, gravity);
  record_.add(problem_.solve(bodies_, touching_, begin, gravity, account_, *team_));
  note_touches(begin);
  arrive(gravity);
  push_apart(begin + h, gravity);
  ++step_;
}

/// To the middle of the step.
template <int D>
void ContactEngine<D>::fly_half() {
  const double half = setup_.time_step / 2;
  for (std::size_t i = 0; i < grains_.moving; ++i) {
    bodies_.velocity[i] = grains_.speed(i);
    bodies_.spin[i] = grains_.turning(i);
    const Vec<D> way = half * bodies_.velocity[i];
    if (!(norm(way) <= farthest_move / 2 * setup_.diameter))
      moved_too_far(i, 2 * norm(way) / setup_.diameter, farthest_move);
    bodies_.middle[i] = grains_.place(i) + way;
    for (int k = 0; k < D; ++k) grown_.position[static_cast<std::size_t>(k)][i] = bodies_.middle[i][k];
  }
}

/// Direction and gap as the grains are in the middle of the step.
template <int D>
void ContactEngine<D>::measure(Touching<D>& t, double middle) const {
  if (is_wall(t.j)) {
    const auto touch = wall_of(t.j).nearest(bodies_.middle[t.i], middle, setup_.domain);
    t.normal = touch.normal;
    t.gap = touch.height - grains_.radius[t.i];
    return;
  }
  const Vec<D> other = moves(t.j) ? bodies_.middle[t.j] : grains_.place(t.j);
  const Vec<D> way = setup_.domain.way(other, bodies_.middle[t.i]);
  const double distance = norm(way);
  t.normal = (1 / distance) * way;
  t.gap = distance - grains_.radius[t.i] - grains_.radius[t.j];
}

/// What the contact was in the step before: it starts from those impulses. `at` goes along with the order of both lists.
template <int D>
void ContactEngine<D>::remember(Touching<D>& t, std::size_t& at) const {
  while (at < last_.size() && last_[at].before(t)) ++at;
  if (at == last_.size() || last_[at].i != t.i || last_[at].j != t.j) return;
  t.impulse = last_[at].impulse;
  t.was_pressed = last_[at].pressed();
  t.stuck = last_[at].state == ContactState::stick && dot(t.impulse, t.impulse) > 0;
}

/// All that are within the margin in the middle of the step; exactly these, whatever the list holds besides.
template <int D>
void ContactEngine<D>::find_touching(double middle) {
  std::swap(touching_, last_);
  touching_.clear();
  const auto& candidates = list_.near(grown_, *team_).pairs;
  const double within = margin * setup_.diameter;
  std::size_t p = 0;
  for (std::uint32_t i = 0; i < grains_.moving; ++i) {
    for (; p < candidates.size() && candidates.i[p] == static_cast<std::int32_t>(i); ++p) {
      Touching<D> t{i, static_cast<std::uint32_t>(candidates.j[p])};
      measure(t, middle);
      if (t.gap < within) touching_.push_back(t);
    }
    for (std::size_t w = 0; w < setup_.walls.size(); ++w) {
      Touching<D> t{i, static_cast<std::uint32_t>(grains_.size() + w)};
      measure(t, middle);
      if (t.gap < within) touching_.push_back(t);
    }
  }
  std::size_t at = 0;
  for (auto& t : touching_) remember(t, at);
}

/// Walton's impacts, and what changes by them.
template <int D>
void ContactEngine<D>::bounce(double begin, const Vec<D>& gravity) {
  struck_.clear();
  if (setup_.impacts != Impacts::walton) return;
  walton_.collide(bodies_, touching_, {begin, gravity}, account_, struck_);
  if (struck_.empty()) return;
  std::fill(struck_grains_.begin(), struck_grains_.end(), 0);
  for (const auto& s : struck_)
    for (const std::size_t g : {touching_[s.touching].i, touching_[s.touching].j})
      if (moves(g)) struck_grains_[g] = 1;
  for (auto& t : touching_) {
    if (!struck_grains_[t.i] && !(moves(t.j) && struck_grains_[t.j])) continue;
    measure(t, begin + setup_.time_step / 2);
    t.stuck = false;
  }
}

/// The other half of the way, with the velocities of the step's end.
template <int D>
void ContactEngine<D>::arrive(const Vec<D>& gravity) {
  const double half = setup_.time_step / 2;
  for (std::size_t i = 0; i < grains_.moving; ++i) {
    const Vec<D> from = grains_.place(i), to = bodies_.middle[i] + half * bodies_.velocity[i];
    if (setup_.tilt) account_.gravity_work += grains_.mass[i] * dot(gravity, to - from);
    const auto orientation =
        turned<D>(turned<D>(grains_.attitude(i), grains_.turning(i), half), bodies_.spin[i], half);
    for (int k = 0; k < D; ++k) {
      grains_.position[static_cast<std::size_t>(k)][i] = to[k];
      grains_.velocity[static_cast<std::size_t>(k)][i] = bodies_.velocity[i][k];
    }
    for (int k = 0; k < turns<D>; ++k) grains_.spin[static_cast<std::size_t>(k)][i] = bodies_.spin[i][k];
    for (int k = 0; k < orientation_numbers<D>; ++k)
      grains_.orientation[static_cast<std::size_t>(k)][i] = orientation[k];
  }
}

/// What overlaps is moved apart.
template <int D>
void ContactEngine<D>::push_apart(double end, const Vec<D>& gravity) {
  const auto& ways = projection_.find(touching_, end);
  for (std::size_t i = 0; i < ways.size(); ++i) {
    for (int k = 0; k < D; ++k) grains_.position[static_cast<std::size_t>(k)][i] += ways[i][k];
    const double work = grains_.mass[i] * dot(gravity, ways[i]);
    account_.projection_work -= work;
    if (setup_.tilt) account_.gravity_work += work;
  }
  deepest_ = projection_.deepest();
  wrap_into(setup_.domain, grains_);
}

/// The begin of a contact; `velocity` of i relative to its partner before.
template <int D>
void ContactEngine<D>::note_impact(const Touching<D>& t, double time, const Vec<D>& velocity) {
  const bool both = moves(t.j);  // then the one with the lower id counts as the bead
  const double sign = both ? -1 : 1;
  Impact impact =
      impact_at(time, sign * t.normal, sign * velocity, bodies_.middle[t.i] - grains_.radius[t.i] * t.normal);
  impact.grain = static_cast<std::int64_t>(both ? t.j : t.i);
  impact.bead = static_cast<std::int64_t>(both ? t.i : t.j);
  touches_.begin(impact);
  touches_.end(time, t.i, t.j);
  if (is_wall(t.j)) impact.bead = wall_id(t.j - grains_.size());
  if (collecting_) impacts_.push_back(impact);
}

/// What presses and did not in the step before is an impact; what did goes on. Velocities of the grains are still those
/// of the step's begin.
template <int D>
void ContactEngine<D>::note_touches(double begin) {
  for (const auto& s : struck_) {
    auto& t = touching_[s.touching];
    if (!t.was_pressed) note_impact(t, s.time, s.velocity);
    t.was_pressed = true;
  }
  const double middle = begin + setup_.time_step / 2;
  for (const auto& t : touching_) {
    if (!t.pressed()) continue;
    if (t.was_pressed) {
      touches_.hold(middle, t.i, t.j);
    } else {
      Vec<D> velocity = grains_.speed(t.i);
      if (moves(t.j)) velocity = velocity - grains_.speed(t.j);
      if (is_wall(t.j)) velocity = velocity - wall_of(t.j).drift(begin);
      note_impact(t, middle, velocity);
    }
  }
}

template <int D>
Contact ContactEngine<D>::told(const Touching<D>& t) const {
  const Vec<D> place = grains_.place(t.i);
  Vec<D> way;
  if (is_wall(t.j)) {
    const auto touch = wall_of(t.j).nearest(place, time(), setup_.domain);
    way = -touch.height * touch.normal;
  } else {
    way = setup_.domain.way(place, grains_.place(t.j));
  }
  const double distance = norm(way);
  Contact contact;
  contact.a = static_cast<std::int64_t>(t.i);
  contact.b = is_wall(t.j) ? wall_id(t.j - grains_.size()) : static_cast<std::int64_t>(t.j);
  contact.overlap = grains_.radius[t.i] + (is_wall(t.j) ? 0 : grains_.radius[t.j]) - distance;
  contact.point = as_file_vector(place + ((grains_.radius[t.i] - 0.5 * contact.overlap) / distance) * way);
  contact.branch = as_file_vector(way);
  set_force(contact, -1.0 * t.normal, (-1 / setup_.time_step) * (t.impulse + t.hit));
  contact.state = t.state;
  contact.impulse_time = setup_.time_step;
  if (t.friction > 0)
    contact.mobilisation = std::abs(contact.shear_force) / (t.friction * contact.normal_force);
  return contact;
}

template <int D>
std::vector<Contact> ContactEngine<D>::contacts() const {
  std::vector<Contact> list;
  for (const auto& t : touching_)
    if (t.pressed()) list.push_back(told(t));
  return list;
}

template <int D>
std::vector<std::pair<std::string, double>> ContactEngine<D>::tells() const {
  std::size_t pressed = 0, sliding = 0;
  for (const auto& t : touching_) {
    pressed += t.pressed();
    sliding += t.pressed() && t.state == ContactState::slide;
  }
  const auto number = [](auto n) { return static_cast<double>(n); };
  const auto& r = record_;
  return {{"sliding_share", pressed ? number(sliding) / number(pressed) : 0},
          {"iterations", number(r.last_iterations)},
          {"residual_of_solver", r.last_residual},
          {"mean_iterations", r.steps ? number(r.iterations) / number(r.steps) : 0},
          {"most_iterations", number(r.most_iterations)},
          {"worst_residual", r.worst_residual},
          {"unconverged", number(r.unconverged)},
          {"deepest_overlap", deepest_}};
}

/// Forces of the latest step on each grain.
template <int D>
void ContactEngine<D>::show() {
  for (auto& f : force_) std::fill(f.begin(), f.end(), 0.0);
  for (const auto& t : touching_) {
    if (!t.pressed()) continue;
    const Vec<D> force = (1 / setup_.time_step) * (t.impulse + t.hit);
    for (int k = 0; k < D; ++k) {
      auto& column = force_[static_cast<std::size_t>(k)];
      column[t.i] += force[k];
      if (!is_wall(t.j)) column[t.j] -= force[k];
    }
  }
}

template <int D>
GrainsView ContactEngine<D>::grains() const {
  return view_of(grains_, force_, setup_.domain, time());
}

template <int D>
EnergyAccount ContactEngine<D>::energy() const {
  EnergyAccount e = account_;
  e.add_motion(grains(), setup_.tilt ? Vec<D>{} : setup_.gravity, start_place_);
  return e;
}

/// Everything that changes during a run, for both directions of a checkpoint.
template <int D>
template <class Archive, class Self>
void ContactEngine<D>::transfer(Archive& archive, Self& self) {
  archive(kept(self.grains_), self.touching_, self.touches_, kept(self.start_place_), self.account_,
          self.record_, self.step_, self.deepest_);
}

template <int D>
void ContactEngine<D>::save(std::ostream& out) const {
  StateOutput archive(out);
  transfer(archive, *this);
}

template <int D>
void ContactEngine<D>::restore(std::istream& in) {
  StateInput archive(in);
  transfer(archive, *this);
  for (const auto& t : touching_) {
    must_name(std::array{t.i}, grains_.size());
    must_name(std::array{t.j}, grains_.size() + setup_.walls.size());
  }
  show();
}

template class ContactEngine<2>;
template class ContactEngine<3>;

}  // namespace chute::contact
