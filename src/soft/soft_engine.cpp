#include "soft/soft_engine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cereal/archives/portable_binary.hpp>
#include <cereal/types/array.hpp>
#include <cereal/types/utility.hpp>
#include <cereal/types/vector.hpp>
#include <cmath>

#include "common/error.hpp"
#include "core/not_a_number.hpp"

namespace chute::soft {

template <int D>
SoftEngine<D>::SoftEngine(Grains<D> grains, const SoftSetup<D>& setup)
    : setup_(setup),
      grains_(std::move(grains)),
      list_(setup.domain, setup.skins, setup.search, setup.isa),
      stages_(setup.domain, setup.laws, setup.isa,
              setup.scheme == Scheme::gear5 ? SlipRule::trapezoid : SlipRule::midpoint),
      integrator_(setup.scheme, setup.time_step, setup.gravity, setup.domain, setup.isa),
      touches_(grains_.moving, setup.contact_time),
      team_(std::make_unique<Team>(setup.threads)) {
  sums_.resize(grains_.size());
  const auto smallest = std::min_element(grains_.radius.begin(), grains_.radius.end());
  if (smallest != grains_.radius.end()) stages_.watch_for(setup.deepest_overlap * *smallest);
  for (int k = 0; k < D; ++k)
    start_place_[k].assign(grains_.position[k].begin(),
                           grains_.position[k].begin() + static_cast<std::ptrdiff_t>(grains_.moving));
  forces(0);
  integrator_.start(grains_, sums_);
  account_.start = energy().stored();
}

template <int D>
void SoftEngine<D>::advance_to(std::int64_t step) {
  if (step <= step_) return;
  integrator_.predict(grains_, sums_, *team_);
  for (;;) {
    ++step_;
    forces(setup_.time_step);
    account_.shear_loss += stages_.memory().released();
    if (contacts_.deep) check_overlaps();
    if (collecting_) find_impacts();
    if (step_ == step) break;
    integrator_.correct_and_predict(grains_, sums_, *team_);
  }
  integrator_.correct(grains_, sums_, *team_);
  check_floor();
}

/// Forces on the moving grains must be 0 before.
template <int D>
void SoftEngine<D>::forces(double duration) {
  try {
    stages_.evaluate(list_.near(grains_, *team_), grains_, contacts_, duration, *team_);
  } catch (const NotANumber& error) {
    leave_physics(error.grain, "its place is not a number: the time step is too long for these forces");
  }
  sums_.clear({grains_.moving, grains_.size()});
  stages_.apply(contacts_, grains_, duration, sums_, *team_);
}

template <int D>
void SoftEngine<D>::check_overlaps() const {
  for (std::size_t c = 0; c < contacts_.count; ++c) {
    const auto i = static_cast<std::size_t>(contacts_.i[c]), j = static_cast<std::size_t>(contacts_.j[c]);
    const double depth = contacts_.overlap[c] / std::min(grains_.radius[i], grains_.radius[j]);
    if (depth > setup_.deepest_overlap)
      leave_physics(i,
                    fmt::format("it overlaps grain {} by {:.3g} of the smaller radius (limit {}): stiffness "
                                "is too low for these velocities",
                                j, depth, setup_.deepest_overlap));
  }
}

template <int D>
void SoftEngine<D>::find_impacts() {
  // Both lists are ordered by (i, j): a merge finds the contacts that were not there a step ago, and those
  // that are there no more. Ends come first: a contact that begins finds the others as they are now.
  auto now = std::size_t{0};
  for (const auto& [i, j] : touched_) {
    while (now < contacts_.count && std::pair(contacts_.i[now], contacts_.j[now]) < std::pair(i, j)) ++now;
    if (now == contacts_.count || std::pair(contacts_.i[now], contacts_.j[now]) != std::pair(i, j))
      touches_.end(time(), static_cast<std::size_t>(i), static_cast<std::size_t>(j));
  }
  auto old = touched_.begin();
  for (std::size_t c = 0; c < contacts_.count; ++c) {
    const std::pair pair{contacts_.i[c], contacts_.j[c]};
    while (old != touched_.end() && *old < pair) ++old;
    if (old != touched_.end() && *old == pair) continue;
    impacts_.push_back(impact(c));
    touches_.begin(impacts_.back());
  }
  remember_touching();
}

/// The contact began within the last step and no force has acted yet: the predicted velocities are those of
/// free flight, so this is the state just before the impact.
template <int D>
Impact SoftEngine<D>::impact(std::size_t contact) const {
  auto grain = static_cast<std::size_t>(contacts_.i[contact]);
  auto bead = static_cast<std::size_t>(contacts_.j[contact]);
  Vec<D> n;  // from bead to grain
  for (int k = 0; k < D; ++k) n[k] = -contacts_.normal[k][contact];
  if (bead < grains_.moving) {  // of two moving grains the first counts as the bead
    std::swap(grain, bead);
    n = -1.0 * n;
  }
  Impact impact = impact_at(time(), n, grains_.speed(grain) - grains_.speed(bead),
                            grains_.place(bead) + grains_.radius[bead] * n);
  impact.grain = static_cast<std::int64_t>(grain);
  impact.bead = static_cast<std::int64_t>(bead);
  return impact;
}

template <int D>
void SoftEngine<D>::collect_impacts(bool on) {
  if (on && !collecting_) {  // what touches already is no impact
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
  for (std::size_t c = 0; c < contacts_.count; ++c) touched_.emplace_back(contacts_.i[c], contacts_.j[c]);
}

template <int D>
std::vector<Impact> SoftEngine<D>::take_impacts() {
  return std::exchange(impacts_, {});
}

template <int D>
void SoftEngine<D>::check_floor() const {
  const auto& height = grains_.position[D - 1];
  for (std::size_t i = 0; i < grains_.moving; ++i)
    if (height[i] < setup_.floor) leave_physics(i, "it fell through the bed");
}

template <int D>
void SoftEngine<D>::leave_physics(std::size_t grain, const std::string& what) const {
  throw WorkError(
      fmt::format("the run left physics at t = {:.6g} (step {}): grain {}: {}", time(), step_, grain, what));
}

template <int D>
GrainsView SoftEngine<D>::grains() const {
  return view_of(grains_, sums_.force, setup_.domain, time());
}

template <int D>
EnergyAccount SoftEngine<D>::energy() const {
  EnergyAccount e = account_;
  for (std::size_t i = 0; i < grains_.moving; ++i) {
    e.normal_loss += sums_.normal_loss[i];
    e.shear_loss += sums_.shear_loss[i];
  }
  e.add_motion(grains(), setup_.gravity, start_place_);
  e.elastic = stages_.elastic_energy(contacts_);
  return e;
}

template <int D>
std::vector<ContactRecord> SoftEngine<D>::contacts() const {
  std::vector<ContactRecord> records(contacts_.count);
  for (std::size_t c = 0; c < contacts_.count; ++c) {
    double shear = 0;
    for (const auto& component : contacts_.shear_force) shear += component[c] * component[c];
    records[c] = {contacts_.i[c], contacts_.j[c], contacts_.overlap[c], contacts_.normal_force[c],
                  turns<D> == 1 ? contacts_.shear_force[0][c] : std::sqrt(shear)};
  }
  return records;
}

/// Everything that changes during a run, for both directions of a checkpoint.
template <int D>
template <class Archive, class Self>
void SoftEngine<D>::transfer(Archive& archive, Self& self) {
  auto& g = self.grains_;
  archive(g.position, g.velocity, g.angle, g.spin, g.wraps, self.integrator_.derivatives(), self.start_place_,
          self.account_.start, self.account_.shear_loss, self.sums_.normal_loss, self.sums_.shear_loss,
          self.step_, self.collecting_, self.touched_, self.touches_, self.stages_.memory());
}

template <int D>
void SoftEngine<D>::save(std::ostream& out) const {
  cereal::PortableBinaryOutputArchive archive(out);
  transfer(archive, *this);
}

template <int D>
void SoftEngine<D>::restore(std::istream& in) {
  cereal::PortableBinaryInputArchive archive(in);
  transfer(archive, *this);
  // Contacts and forces of this instant, for whoever looks before the next step. What the contacts remember
  // is from the forces of the last step, at the predicted places; it must not see the corrected ones.
  const auto remembered = stages_.memory();
  sums_.clear({0, grains_.moving});
  forces(0);
  stages_.memory() = remembered;
}

template class SoftEngine<2>;
template class SoftEngine<3>;

}  // namespace chute::soft
