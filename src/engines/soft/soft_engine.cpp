#include "engines/soft/soft_engine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cereal/types/array.hpp>
#include <cereal/types/utility.hpp>
#include <cereal/types/vector.hpp>
#include <cmath>
#include <numeric>
#include <type_traits>

#include "common/error.hpp"
#include "common/state_archive.hpp"
#include "core/not_a_number.hpp"
#include "engines/kind/deep_start.hpp"

namespace chute::soft {

/// The smallest radius, 0 without grains.
template <int D>
static double smallest(const Grains<D>& grains) {
  const auto found = std::min_element(grains.radius.begin(), grains.radius.end());
  return found == grains.radius.end() ? 0 : *found;
}

template <int D>
static double reach_of(const SoftSetup<D>& setup, const Grains<D>& grains) {
  return reach_of_ends(setup, smallest(grains));
}

template <int D>
SoftEngine<D>::SoftEngine(Grains<D> grains, const SoftSetup<D>& setup)
    : setup_(setup),
      grains_(std::move(grains)),
      stages_(setup.domain, laws_of_grains(setup, reach_of(setup, grains_)), setup.isa,
              slip_rule(setup.scheme)),
      list_(setup.domain, {setup.skins.near, setup.skins.far, stages_.apart()}, setup.search, setup.isa),
      integrator_(setup.scheme, setup.time_step, setup.gravity, setup.domain, setup.isa),
      walls_(setup.surroundings(), laws_of_grains(setup, stages_.apart()),
             laws_of_walls(setup, reach_of(setup, grains_)), {setup.isa, slip_rule(setup.scheme)}),
      exchange_(setup.surroundings(), setup.time_step),
      grains_at_start_(static_cast<std::int64_t>(grains_.size())),
      touches_(grains_.moving, setup.contact_time),
      team_(std::make_unique<Team>(setup.threads)),
      tiles_(std::make_unique<TimeTiles<D>>(*strips_, setup.many.grains_per_tile)) {
  sums_.resize(grains_.size());
  if (exchange_.any()) {
    ids_.resize(grains_.size());
    std::iota(ids_.begin(), ids_.end(), 0);
  }
  watch_overlaps();
  for (int k = 0; k < D; ++k)
    start_place_[k].assign(grains_.position[k].begin(),
                           grains_.position[k].begin() + static_cast<std::ptrdiff_t>(grains_.moving));
  engines::refuse_deep_start<D>(grains_, setup_, setup.deepest_overlap);
  forces(0);
  integrator_.start(grains_, sums_);
  account_.start = energy().stored();
}

template <int D>
void SoftEngine<D>::watch_overlaps() {
  if (grains_.size() > 0) stages_.watch_for(setup_.deepest_overlap * smallest(grains_));
}

template <int D>
void SoftEngine<D>::advance(std::int64_t step) {
  while (step_ < step) {
    advance_same_grains(exchange_.any() ? std::min(step, exchange_.next_after(step_)) : step);
    if (exchange_.lets_out_after(step_)) let_out();
    if (exchange_.lets_in_after(step_)) let_in();
  }
}

template <int D>
void SoftEngine<D>::advance_same_grains(std::int64_t step) {
  integrator_.predict(grains_, sums_, *team_);
  for (;;) {
    // Whenever somebody came or went the order is that of the ids again.
    const bool renewed = exchange_.any() && order_.empty();
    if (sorts() && (step_ % setup_.many.sort_every == 0 || renewed)) sort();
    if (advance_in_tiles(step)) continue;
    ++step_;
    forces(setup_.time_step, collecting_ || step_ == step);
    account_.shear_loss += stages_.memory().released();
    account_.shear_loss += walls_.released();
    account_.wall_work += walls_.work();
    if (setup_.tilt) tilt();
    if (contacts_.deep || walls_.deep()) {
      if (!whole_) stages_.locate(candidates(), grains_, contacts_);
      check_overlaps();
    }
    if (collecting_) find_impacts();
    if (step_ == step) break;
    integrator_.correct_and_predict(grains_, sums_, *team_);
  }
  integrator_.correct(grains_, sums_, *team_);
  check_floor();
}

/// Gravity as it is now, and its work in this step.
template <int D>
void SoftEngine<D>::tilt() {
  const Vec<D> g = setup_.gravity_at(time());
  integrator_.set_gravity(g);
  for (std::size_t i = 0; i < grains_.moving; ++i)
    account_.gravity_work += setup_.time_step * grains_.mass[i] * dot(g, grains_.speed(i));
}

template <int D>
search::Candidates<D> SoftEngine<D>::candidates() {
  try {
    return list_.near(grains_, *team_);
  } catch (const NotANumber& error) {
    leave_physics(static_cast<std::size_t>(name_at(error.grain)),
                  "its place is not a number: the time step is too long for these forces");
  }
}

/// Forces on the moving grains must be 0 before. Where there are many contacts that remember and nobody looks at them
/// before the next step, they go piece by piece.
template <int D>
void SoftEngine<D>::forces(double duration, bool looked_at) {
  constexpr std::size_t least_pieces = 4;
  const auto near = candidates();
  if (whole_)
    sums_.clear_fixed(contacts_, grains_.moving);
  else
    sums_.clear({grains_.moving, grains_.size()});
  whole_ = looked_at || team_->size() > 1 || !stages_.memory().needed() ||
           near.pairs.size() < least_pieces * setup_.many.pairs_in_piece;
  if (whole_) {
    stages_.evaluate(near, grains_, contacts_, duration, *team_);
    stages_.apply(contacts_, grains_, duration, sums_, *team_);
  } else {
    stages_.evaluate_and_apply(near, grains_, setup_.many.pairs_in_piece, piece_, duration, sums_);
    contacts_.deep = piece_.deep;
  }
  walls_.evaluate(grains_, time(), duration, stages_.deepest(), sums_);
}

/// Collecting impacts remembers grains by their ids from step to step.
template <int D>
bool SoftEngine<D>::sorts() const {
  return grains_.moving >= setup_.many.sort_from && !collecting_;
}

/// Takes some of the steps on the way to `step`, from predicted places to predicted places, if it can. A block that must
/// be undone has cost its steps for nothing; where that happens again and again, single steps follow for ever longer.
template <int D>
bool SoftEngine<D>::advance_in_tiles(std::int64_t step) {
  constexpr std::int64_t first_pause = 64,
                         longest_pause = 4096;  // steps: a block's, and some hundred times that
  const auto& many = setup_.many;
  const bool pays = team_->size() > 1 || grains_.moving > 2 * many.grains_per_tile;
  if (!many.tiles || !pays || stages_.memory().needed() || walls_.any() || setup_.tilt || order_.empty() ||
      step_ < no_tiles_until_ || !sorts())
    return false;
  const StepParts<D> parts{grains_, sums_, list_, stages_, integrator_, *team_, setup_.time_step};
  const std::int64_t unsorted = many.sort_every - step_ % many.sort_every;
  candidates();  // up to date
  const std::int64_t steps = tiles_->possible(parts, std::min(step - 1 - step_, unsorted));
  if (steps == 0) return false;
  if (!tiles_->advance(parts, steps)) {
    ++undone_;
    tile_pause_ = std::clamp(2 * tile_pause_, first_pause, longest_pause);
    no_tiles_until_ = step_ + tile_pause_;
    return false;
  }
  tile_pause_ = 0;
  step_ += steps;
  tiled_steps_ += steps;
  return true;
}

template <int D>
void SoftEngine<D>::sort() {
  reorder(strips_->sort(grains_, setup_.domain));
  tiles_->sorted();
}

template <int D>
void SoftEngine<D>::reorder(std::span<const std::int32_t> from) {
  if (order_.empty()) {
    order_.resize(grains_.moving);
    std::iota(order_.begin(), order_.end(), 0);
  }
  grains_.reorder(from);
  for (auto& order : integrator_.derivatives())
    for (auto& a : order)
      if (!a.empty()) chute::reorder(a, from);
  chute::reorder(sums_.normal_loss, from);
  chute::reorder(sums_.shear_loss, from);
  chute::reorder(order_, from);
  if (stages_.memory().needed()) {
    std::vector<std::int32_t> place(from.size());
    for (std::size_t k = 0; k < from.size(); ++k)
      place[static_cast<std::size_t>(from[k])] = static_cast<std::int32_t>(k);
    stages_.memory().reorder(place);
    walls_.reorder(place);
  }
  list_.forget();
}

/// The order of ids again, with the contacts of this instant.
template <int D>
void SoftEngine<D>::back_to_ids() {
  if (order_.empty()) return;
  reorder(places());
  order_.clear();
  look_again();
}

/// Contacts and forces of this instant, for whoever looks before the next step. What the contacts remember is from the
/// forces of the last step, at the predicted places; it must not see the corrected ones.
template <int D>
void SoftEngine<D>::look_again() {
  const auto remembered = stages_.memory();
  const auto remembered_of_walls = walls_.memories();
  sums_.clear({0, grains_.moving});
  forces(0);
  stages_.memory() = remembered;
  walls_.remember(remembered_of_walls);
}

template <int D>
void SoftEngine<D>::check_overlaps() const {
  for_contacts([&](const Contacts<D>& contacts, std::size_t c) {
    if (const auto what =
            too_deep(setup_, grains_.radius, contacts, c, [&](std::size_t j) { return name_at(j); }))
      leave_physics(static_cast<std::size_t>(name_at(static_cast<std::size_t>(contacts.i[c]))), *what);
  });
}

/// each(contacts, c) for all contacts: of grains, then with walls. Pairs that touch within half a step only are none.
template <int D>
template <class Each>
void SoftEngine<D>::for_contacts(const Each& each) const {
  const auto all = [&](const Contacts<D>& contacts) {
    for (std::size_t c = 0; c < contacts.count; ++c)
      if (contacts.overlap[c] > 0) each(contacts, c);
  };
  all(contacts_);
  walls_.for_lists(all);
}

template <int D>
void SoftEngine<D>::find_impacts() {
  // Both lists are ordered by (i, j): a merge finds the contacts that were not there a step ago, and those
  // that are there no more. Ends come first: a contact that begins finds the others as they are now.
  std::swap(touched_, touched_before_);
  remember_touching();
  const auto id = [](std::int32_t k) { return static_cast<std::size_t>(k); };
  auto now = touched_.begin();
  for (const auto& pair : touched_before_) {
    while (now != touched_.end() && *now < pair) ++now;
    if (now != touched_.end() && *now == pair) continue;
    touches_.end(time(), id(pair.first), id(pair.second));
    const Impact ended = impact(id(pair.first), id(pair.second));
    partings_.push_back({ended.time, ended.grain, bead_id(ended.bead), ended.v_n});
  }
  auto old = touched_before_.begin();
  for (const auto& pair : touched_) {
    while (old != touched_before_.end() && *old < pair) ++old;
    if (old != touched_before_.end() && *old == pair) continue;
    Impact begun = impact(id(pair.first), id(pair.second));
    touches_.begin(begun);
    begun.bead = bead_id(begun.bead);
    impacts_.push_back(begun);
  }
}

/// The contact of i and j, or of i and a wall, began within the last step and no force has acted yet: the predicted
/// velocities are those of free flight, so this is the state just before the impact.
template <int D>
Impact SoftEngine<D>::impact(std::size_t i, std::size_t j) const {
  std::size_t grain = i, bead = j;
  Vec<D> n, v = grains_.speed(i), surface = grains_.place(i);  // n from bead to grain
  if (j >= grains_.size()) {
    const auto touch = walls_.touch(j - grains_.size(), surface, time());
    n = touch.nearest.normal;
    v = v - touch.velocity;
    surface = surface - grains_.radius[i] * n;
  } else {
    const Vec<D> way = setup_.domain.way(grains_.place(i), grains_.place(j));
    n = -(1 / norm(way)) * way;
    v = v - grains_.speed(j);
    if (j < grains_.moving) {  // of two moving grains the first counts as the bead
      std::swap(grain, bead);
      n = -1.0 * n, v = -1.0 * v;
    }
    surface = grains_.place(bead) + grains_.radius[bead] * n;
  }
  Impact impact = impact_at(time(), n, v, surface);
  impact.grain = static_cast<std::int64_t>(grain);
  impact.bead = static_cast<std::int64_t>(bead);
  return impact;
}

template <int D>
void SoftEngine<D>::collect_impacts(bool on) {
  if (on && !collecting_) {  // what touches already is no impact
    back_to_ids();
    remember_touching();
    touches_ = TouchLog(grains_.moving, setup_.contact_time);
    for (const auto& [i, j] : touched_)
      touches_.touch(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
  }
  collecting_ = on;
}

template <int D>
void SoftEngine<D>::remember_touching() {
  touched_.clear();
  for_contacts([&](const Contacts<D>& contacts, std::size_t c) {
    touched_.emplace_back(contacts.i[c], contacts.j[c]);
  });
  if (walls_.count() > 0) std::sort(touched_.begin(), touched_.end());
}

template <int D>
std::vector<Impact> SoftEngine<D>::take_impacts() {
  return std::exchange(impacts_, {});
}

template <int D>
void SoftEngine<D>::check_floor() const {
  const auto& height = grains_.position[D - 1];
  for (std::size_t i = 0; i < grains_.moving; ++i)
    if (height[i] < setup_.floor)
      leave_physics(static_cast<std::size_t>(name_at(i)), "it fell through the bed");
}

/// Where each grain is kept, by its id.
template <int D>
std::vector<std::int32_t> SoftEngine<D>::places() const {
  std::vector<std::int32_t> place(order_.size());
  for (std::size_t k = 0; k < order_.size(); ++k)
    place[static_cast<std::size_t>(order_[k])] = static_cast<std::int32_t>(k);
  return place;
}

template <int D>
const Grains<D>& SoftEngine<D>::state() const {
  if (order_.empty()) return grains_;
  by_id_ = grains_;
  by_id_.reorder(places());
  return by_id_;
}

template <int D>
GrainsView SoftEngine<D>::grains() const {
  const auto named = [&](GrainsView view) {
    view.id = ids_;
    return view;
  };
  if (order_.empty()) return named(view_of(grains_, sums_.force, setup_.domain, time()));
  force_by_id_ = sums_.force;
  for (auto& f : force_by_id_) chute::reorder(f, places());
  return named(view_of(state(), force_by_id_, setup_.domain, time()));
}

template <int D>
std::vector<std::pair<std::string, double>> SoftEngine<D>::tells() const {
  if (!exchange_.any()) return {};
  return exchange_.tells(grains_.moving, step_);
}

template <int D>
EnergyAccount SoftEngine<D>::energy() const {
  EnergyAccount e = account_;
  for (std::size_t i = 0; i < grains_.moving; ++i) {
    e.normal_loss += sums_.normal_loss[i];
    e.shear_loss += sums_.shear_loss[i];
  }
  e.add_motion(grains(), setup_.tilt ? Vec<D>{} : setup_.gravity, start_place_);
  e.elastic = stages_.elastic_energy(contacts_) + walls_.elastic_energy();
  return e;
}

template <int D>
Contact SoftEngine<D>::told(const Contacts<D>& contacts, std::size_t c) const {
  auto i = static_cast<std::size_t>(contacts.i[c]), j = static_cast<std::size_t>(contacts.j[c]);
  const bool wall = j >= grains_.size();
  Vec<D> n, force = force_on_second(contacts, c);
  for (int k = 0; k < D; ++k) n[k] = contacts.normal[k][c];
  Contact contact;
  contact.overlap = contacts.overlap[c];
  contact.a = static_cast<std::int64_t>(id_at(i));
  contact.b = wall ? wall_id(j - grains_.size()) : static_cast<std::int64_t>(id_at(j));
  if (!wall && contact.b < contact.a) {  // where grains are kept in another order
    std::swap(contact.a, contact.b), std::swap(i, j);
    n = -1.0 * n, force = -1.0 * force;
  }
  const double arm = grains_.radius[i] - 0.5 * contact.overlap;
  const double length =
      wall ? grains_.radius[i] - contact.overlap : grains_.radius[i] + grains_.radius[j] - contact.overlap;
  contact.point = as_file_vector(grains_.place(i) + arm * n);
  contact.branch = as_file_vector(length * n);
  set_force(contact, n, force);
  return contact;
}

template <int D>
std::vector<Contact> SoftEngine<D>::contacts() const {
  std::vector<Contact> told_of;
  told_of.reserve(contacts_.count + walls_.count());
  for_contacts([&](const Contacts<D>& contacts, std::size_t c) { told_of.push_back(told(contacts, c)); });
  if (!order_.empty())
    std::sort(told_of.begin(), told_of.end(),
              [](const Contact& a, const Contact& b) { return std::pair(a.a, a.b) < std::pair(b.a, b.b); });
  return told_of;
}

/// Where grains come and go: how many there are, which, and what they are, which else follows from the scene.
template <int D>
template <class Archive, class Self>
void SoftEngine<D>::transfer_who_is_there(Archive& archive, Self& self) {
  auto moving = self.grains_.moving;
  archive(moving, self.exchange_);
  if constexpr (std::is_same_v<Archive, StateInput>) {
    archive.must_hold(moving);
    self.resize({}, moving);
  }
  archive(kept(self.ids_));
  Grains<D>::for_columns(self.grains_, [&](const GrainField& field, auto& column) {
    if (!field.changes) archive(kept(column));
  });
}

/// Everything that changes during a run, for both directions of a checkpoint.
template <int D>
template <class Archive, class Self>
void SoftEngine<D>::transfer(Archive& archive, Self& self) {
  if (self.exchange_.any()) transfer_who_is_there(archive, self);
  archive(self.order_, kept(self.grains_), kept(self.integrator_.derivatives()), kept(self.start_place_),
          self.account_, kept(self.sums_.normal_loss), kept(self.sums_.shear_loss), self.step_,
          self.collecting_, self.touched_, self.touches_, self.stages_.memory(), self.walls_);
}

namespace {
/// Does each of [0, count) stand in it once?
bool is_order(std::span<const std::int32_t> order, std::size_t count) {
  std::vector<bool> seen(count, false);
  for (const auto id : order) {
    if (id < 0 || static_cast<std::size_t>(id) >= count || seen[static_cast<std::size_t>(id)]) return false;
    seen[static_cast<std::size_t>(id)] = true;
  }
  return order.size() == count;
}
}  // namespace

template <int D>
void SoftEngine<D>::save(std::ostream& out) const {
  StateOutput archive(out);
  transfer(archive, *this);
}

template <int D>
void SoftEngine<D>::restore(std::istream& in) {
  back_to_ids();  // for the constants, which are not in the archive
  StateInput archive(in);
  transfer(archive, *this);
  if (!order_.empty() && !is_order(order_, grains_.moving)) wrong_state();
  for (const auto& [i, j] : touched_) must_name(std::array{i, j}, grains_.size() + walls_.count());
  if (exchange_.any())
    watch_overlaps();
  else if (!order_.empty())
    Grains<D>::for_columns(grains_, [&](const GrainField& field, auto& column) {
      if (!field.changes) chute::reorder(column, order_);
    });
  list_.forget();
  look_again();
}

template class SoftEngine<2>;
template class SoftEngine<3>;

}  // namespace chute::soft
