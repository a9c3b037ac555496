#include "engines/soft/clump_engine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cereal/types/array.hpp>
#include <cereal/types/vector.hpp>
#include <cmath>
#include <numeric>

#include "common/error.hpp"
#include "common/state_archive.hpp"
#include "core/not_a_number.hpp"
#include "engines/kind/deep_start.hpp"

namespace chute::soft {
template <int D>
ClumpEngine<D>::ClumpEngine(Grains<D> bodies, Clumps<D> clumps, const SoftSetup<D>& setup)
    : setup_(setup),
      clumps_(std::move(clumps)),
      bodies_(std::move(bodies)),
      list_(setup.domain, setup.skins, setup.search, setup.isa),
      stages_(setup.domain, laws_of_grains(setup), setup.isa, slip_rule(setup.scheme)),
      integrator_(setup.scheme, setup.time_step, setup.gravity, setup.domain, setup.isa, false),
      walls_(setup.surroundings(), laws_of_grains(setup), laws_of_walls(setup),
             {setup.isa, slip_rule(setup.scheme)}),
      team_(std::make_unique<Team>(setup.threads)) {
  for (std::size_t i = 0; i < bodies_.moving; ++i) {
    const auto momentum = momentum_of(clumps_.of(i), bodies_.attitude(i), bodies_.turning(i));
    for (int k = 0; k < turns<D>; ++k) bodies_.spin[static_cast<std::size_t>(k)][i] = momentum[k];
  }
  if constexpr (D == 3) motion_.emplace(setup.scheme, setup.time_step, clumps_, setup.isa);
  numbers_.resize(bodies_.size());
  std::iota(numbers_.begin(), numbers_.end(), 0);
  make_spheres();
  sphere_sums_.resize(spheres_.size());
  body_sums_.resize(bodies_.size());
  const auto smallest = std::min_element(spheres_.radius.begin(), spheres_.radius.end());
  if (smallest != spheres_.radius.end()) stages_.watch_for(setup.deepest_overlap * *smallest);
  for (int k = 0; k < D; ++k)
    start_place_[k].assign(bodies_.position[k].begin(),
                           bodies_.position[k].begin() + static_cast<std::ptrdiff_t>(bodies_.moving));
  forces(0);
  engines::refuse_deep_start<D>(spheres_, setup_, setup.deepest_overlap, body_);
  integrator_.start(bodies_, body_sums_);
  account_.start = energy().stored();
}

/// A sphere's mass is its body's: reduced masses of contacts are made of it.
template <int D>
void ClumpEngine<D>::make_spheres() {
  for (std::size_t i = 0; i < bodies_.moving; ++i) {
    first_.push_back(spheres_.size());
    const double scale = clumps_.scale[i];
    for (const auto& member : clumps_.of(i).members) {
      spheres_.add({}, scale * member.radius, bodies_.mass[i], bodies_.inertia[i], true);
      spheres_.material.back() = bodies_.material[i];
      body_.push_back(static_cast<int>(i));
      for (int k = 0; k < D; ++k) at_[k].push_back(scale * member.at[k]);
    }
  }
  first_.push_back(spheres_.size());
  for (auto& arm : arm_) arm.resize(spheres_.size());
  for (std::size_t i = bodies_.moving; i < bodies_.size(); ++i) {
    spheres_.add(bodies_.place(i), bodies_.radius[i], bodies_.mass[i], bodies_.inertia[i], false);
    spheres_.material.back() = bodies_.material[i];
    body_.push_back(static_cast<int>(i));
  }
}

/// Where the spheres are and how they move, from their bodies.
template <int D>
void ClumpEngine<D>::lay_spheres() {
  const auto& domain = setup_.domain;
  team_->split(bodies_.moving, [&](Part range, std::size_t) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const Vec<D> place = bodies_.place(i), velocity = bodies_.speed(i);
      const auto attitude = bodies_.attitude(i);
      const auto spin = spin_of(clumps_.of(i), attitude, bodies_.turning(i));
      for (std::size_t m = first_[i]; m < first_[i + 1]; ++m) {
        Vec<D> at;
        for (int k = 0; k < D; ++k) at[k] = at_[k][m];
        const Vec<D> arm = in_space(attitude, at), swung = swing(spin, arm);
        for (int k = 0; k < D; ++k) {
          double x = place[k] + arm[k];
          if (domain.periodic(k)) {
            if (x < domain.lower[k]) x += domain.length[k];
            if (x >= domain.lower[k] + domain.length[k]) x -= domain.length[k];
          }
          arm_[k][m] = arm[k];
          spheres_.position[k][m] = x;
          spheres_.velocity[k][m] = velocity[k] + swung[k];
        }
        for (int k = 0; k < turns<D>; ++k) spheres_.spin[k][m] = spin[k];
      }
    }
  });
}

template <int D>
search::Candidates<D> ClumpEngine<D>::candidates() {
  try {
    const auto near = list_.near(spheres_, *team_);
    if (seen_list_ != list_.near_builds()) {
      seen_list_ = list_.near_builds();
      pairs_.clear();
      for (std::size_t p = 0; p < near.pairs.size(); ++p) {
        const auto i = static_cast<std::size_t>(near.pairs.i[p]),
                   j = static_cast<std::size_t>(near.pairs.j[p]);
        if (body_[i] != body_[j]) pairs_.add(spheres_, i, j);
      }
    }
    return {pairs_, near.coarse};
  } catch (const NotANumber& error) {
    leave_physics(static_cast<std::size_t>(body_[error.grain]),
                  "its place is not a number: the time step is too long for these forces");
  }
}

template <int D>
void ClumpEngine<D>::forces(double duration) {
  lay_spheres();
  stages_.evaluate(candidates(), spheres_, contacts_, duration, *team_);
  sphere_sums_.clear({0, spheres_.size()});
  stages_.apply(contacts_, spheres_, duration, sphere_sums_, *team_);
  walls_.evaluate(spheres_, time(), duration, stages_.deepest(), sphere_sums_);
  add_up();
}

/// Forces and torques on the bodies, from those on their spheres.
template <int D>
void ClumpEngine<D>::add_up() {
  body_sums_.clear({0, bodies_.size()});
  team_->split(bodies_.moving, [&](Part range, std::size_t) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      Vec<D> force{};
      Vec<turns<D>> torque{};
      for (std::size_t m = first_[i]; m < first_[i + 1]; ++m) {
        Vec<D> arm, f;
        for (int k = 0; k < D; ++k) arm[k] = arm_[k][m], f[k] = sphere_sums_.force[k][m];
        force = force + f;
        const auto lever = leverage(arm, f);
        for (int k = 0; k < turns<D>; ++k) torque[k] += sphere_sums_.torque[k][m] + lever[k];
      }
      for (int k = 0; k < D; ++k) body_sums_.force[k][i] = force[k];
      for (int k = 0; k < turns<D>; ++k) body_sums_.torque[k][i] = torque[k];
    }
  });
  for (std::size_t i = bodies_.moving; i < bodies_.size(); ++i)
    for (int k = 0; k < D; ++k)
      body_sums_.force[k][i] = sphere_sums_.force[k][first_.back() + (i - bodies_.moving)];
}

template <int D>
void ClumpEngine<D>::turn() {
  if constexpr (D == 3)
    team_->split(bodies_.moving,
                 [&](Part range, std::size_t) { motion_->turn(bodies_, integrator_, range); });
}
template <int D>
void ClumpEngine<D>::correct_turn() {
  if constexpr (D == 3)
    team_->split(bodies_.moving,
                 [&](Part range, std::size_t) { motion_->correct(bodies_, body_sums_, integrator_, range); });
}

template <int D>
void ClumpEngine<D>::advance(std::int64_t step) {
  if (step <= step_) return;
  integrator_.predict(bodies_, body_sums_, *team_);
  turn();
  for (;;) {
    ++step_;
    forces(setup_.time_step);
    account_.shear_loss += stages_.memory().released();
    account_.shear_loss += walls_.released();
    account_.wall_work += walls_.work();
    if (setup_.tilt) tilt();
    if (contacts_.deep || walls_.deep()) check_overlaps();
    correct_turn();
    if (step_ == step) break;
    integrator_.correct_and_predict(bodies_, body_sums_, *team_);
    turn();
  }
  integrator_.correct(bodies_, body_sums_, *team_);
  lay_spheres();
  check_floor();
}

/// Gravity as it is now, and its work in this step.
template <int D>
void ClumpEngine<D>::tilt() {
  const Vec<D> g = setup_.gravity_at(time());
  integrator_.set_gravity(g);
  for (std::size_t i = 0; i < bodies_.moving; ++i)
    account_.gravity_work += setup_.time_step * bodies_.mass[i] * dot(g, bodies_.speed(i));
}

template <int D>
template <class Each>
void ClumpEngine<D>::for_contacts(const Each& each) const {
  const auto all = [&](const Contacts<D>& contacts) {
    for (std::size_t c = 0; c < contacts.count; ++c) each(contacts, c);
  };
  all(contacts_);
  walls_.for_lists(all);
}

template <int D>
void ClumpEngine<D>::check_overlaps() const {
  for_contacts([&](const Contacts<D>& contacts, std::size_t c) {
    if (const auto what =
            too_deep(setup_, spheres_.radius, contacts, c, [&](std::size_t j) { return body_[j]; }))
      leave_physics(static_cast<std::size_t>(body_[static_cast<std::size_t>(contacts.i[c])]), *what);
  });
}

template <int D>
void ClumpEngine<D>::check_floor() const {
  const auto& height = bodies_.position[D - 1];
  for (std::size_t i = 0; i < bodies_.moving; ++i)
    if (height[i] < setup_.floor) leave_physics(i, "it fell through the bed");
}

template <int D>
const Grains<D>& ClumpEngine<D>::state() const {
  told_ = bodies_;
  for (std::size_t i = 0; i < bodies_.moving; ++i) {
    const auto momentum = bodies_.turning(i), spin = spin_of(clumps_.of(i), bodies_.attitude(i), momentum);
    for (int k = 0; k < turns<D>; ++k) told_.spin[k][i] = spin[k];
    const double square = dot(spin, spin);
    if (square > 0) told_.inertia[i] *= dot(momentum, spin) / square;
  }
  return told_;
}

template <int D>
Vec<turns<D>> ClumpEngine<D>::angular_momentum() const {
  Vec<turns<D>> sum{};
  const auto view = view_of(bodies_, body_sums_.force, setup_.domain, time());
  for (std::size_t i = 0; i < bodies_.moving; ++i) {
    Vec<D> place;
    for (int k = 0; k < D; ++k) place[k] = view.unwrapped(i, static_cast<std::size_t>(k));
    sum = sum + bodies_.mass[i] * leverage(place, bodies_.speed(i)) + bodies_.inertia[i] * bodies_.turning(i);
  }
  return sum;
}

template <int D>
GrainsView ClumpEngine<D>::grains() const {
  auto view = view_of(state(), body_sums_.force, setup_.domain, time());
  view.fields.push_back({{&fields::body, FieldKind::scalar, false, false}, {}, numbers_});
  return view;
}

template <int D>
GrainsView ClumpEngine<D>::drawn() const {
  told_spheres_ = spheres_;
  for (std::size_t i = 0; i < bodies_.moving; ++i) {
    double all = 0;
    const auto volume = [&](std::size_t m) { return std::pow(spheres_.radius[m], 3); };
    for (std::size_t m = first_[i]; m < first_[i + 1]; ++m) all += volume(m);
    for (std::size_t m = first_[i]; m < first_[i + 1]; ++m) {
      told_spheres_.mass[m] = bodies_.mass[i] * (volume(m) / all);
      for (int k = 0; k < D; ++k) told_spheres_.velocity[k][m] = bodies_.velocity[k][i];
      for (int k = 0; k < orientation_numbers<D>; ++k)
        told_spheres_.orientation[k][m] = bodies_.orientation[k][i];
    }
  }
  auto view = view_of(told_spheres_, sphere_sums_.force, setup_.domain, time());
  view.fields.push_back({{&fields::body, FieldKind::scalar, false, false}, {}, body_});
  return view;
}

template <int D>
EnergyAccount ClumpEngine<D>::energy() const {
  EnergyAccount e = account_;
  for (std::size_t m = 0; m < spheres_.moving; ++m) {
    e.normal_loss += sphere_sums_.normal_loss[m];
    e.shear_loss += sphere_sums_.shear_loss[m];
  }
  e.add_motion(grains(), setup_.tilt ? Vec<D>{} : setup_.gravity, start_place_);
  e.elastic = stages_.elastic_energy(contacts_) + walls_.elastic_energy();
  return e;
}

template <int D>
Contact ClumpEngine<D>::told(const Contacts<D>& contacts, std::size_t c) const {
  const auto i = static_cast<std::size_t>(contacts.i[c]), j = static_cast<std::size_t>(contacts.j[c]);
  const bool wall = j >= spheres_.size();
  const auto arm_of = [&](std::size_t m) {
    Vec<D> arm{};
    if (m < spheres_.moving)
      for (int k = 0; k < D; ++k) arm[k] = arm_[k][m];
    return arm;
  };
  Vec<D> n;
  for (int k = 0; k < D; ++k) n[k] = contacts.normal[k][c];
  Contact contact;
  contact.overlap = contacts.overlap[c];
  contact.a = body_[i];
  contact.b = wall ? wall_id(j - spheres_.size()) : body_[j];
  const double R = spheres_.radius[i], reach = R - 0.5 * contact.overlap;
  const double length = wall ? R - contact.overlap : R + spheres_.radius[j] - contact.overlap;
  contact.point = as_file_vector(bodies_.place(static_cast<std::size_t>(body_[i])) + arm_of(i) + reach * n);
  contact.branch = as_file_vector(arm_of(i) + length * n - (wall ? Vec<D>{} : arm_of(j)));
  set_force(contact, n, force_on_second(contacts, c));
  return contact;
}

template <int D>
std::vector<Contact> ClumpEngine<D>::contacts() const {
  std::vector<Contact> all;
  all.reserve(contacts_.count + walls_.count());
  for_contacts([&](const Contacts<D>& contacts, std::size_t c) { all.push_back(told(contacts, c)); });
  const auto of_walls = all.begin() + static_cast<std::ptrdiff_t>(contacts_.count);
  std::stable_sort(all.begin(), of_walls, [](const Contact& a, const Contact& b) {
    return std::pair(a.a, a.b) < std::pair(b.a, b.b);
  });
  return all;
}

template <int D>
std::vector<std::pair<std::string, double>> ClumpEngine<D>::tells() const {
  std::int64_t touched = 0;
  std::pair<std::int64_t, std::int64_t> before{-1, -1};
  auto all = contacts();
  std::ranges::sort(all, {}, [](const Contact& c) { return std::pair(c.a, c.b); });
  for (const auto& contact : all) {
    const std::pair pair(contact.a, contact.b);
    const bool both = !is_wall(contact.b) && contact.b < static_cast<std::int64_t>(bodies_.moving);
    if (pair != before) touched += both ? 2 : 1;
    before = pair;
  }
  return {{"partners", static_cast<double>(touched) / static_cast<double>(bodies_.moving)}};
}

/// As SoftEngine: what contacts remember is from the predicted places, and must not see the corrected ones.
template <int D>
void ClumpEngine<D>::look_again() {
  const auto remembered = stages_.memory();
  const auto remembered_of_walls = walls_.memories();
  forces(0);
  stages_.memory() = remembered;
  walls_.remember(remembered_of_walls);
}

/// Everything that changes during a run, for both directions of a checkpoint.
template <int D>
template <class Archive, class Self>
void ClumpEngine<D>::transfer(Archive& archive, Self& self) {
  archive(kept(self.bodies_), kept(self.integrator_.derivatives()), kept(self.start_place_), self.account_,
          kept(self.sphere_sums_.normal_loss), kept(self.sphere_sums_.shear_loss), self.step_,
          self.stages_.memory(), self.walls_);
}

template <int D>
void ClumpEngine<D>::save(std::ostream& out) const {
  StateOutput archive(out);
  transfer(archive, *this);
}

template <int D>
void ClumpEngine<D>::restore(std::istream& in) {
  StateInput archive(in);
  transfer(archive, *this);
  list_.forget();
  look_again();
}

template class ClumpEngine<2>;
template class ClumpEngine<3>;

}  // namespace chute::soft
