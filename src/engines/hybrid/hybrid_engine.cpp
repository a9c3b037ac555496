#include "engines/hybrid/hybrid_engine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cereal/types/array.hpp>
#include <cereal/types/vector.hpp>
#include <cmath>

#include "common/error.hpp"
#include "common/state_archive.hpp"
#include "core/not_a_number.hpp"
#include "engines/kind/deep_start.hpp"

namespace chute::hybrid {
namespace {

/// Pairs whose surfaces end a step nearer than twice what the farthest grain moves may have met in it. Lists hold them up
/// to this part of d; and where somebody moves more than half of that, up to what farthest_move allows.
constexpr double usual_margin = 0.1, fast_margin = 2 * farthest_move;

/// Skins of the neighbour lists, parts of d: grains fly some hundredths of d in a step, so a list holds for some steps.
constexpr double near_skin = 0.3, far_skin = 1;

/// Passes over what overlaps at the end of a step.
constexpr int passes = 4;

}  // namespace

template <int D>
HybridEngine<D>::Nearby::Nearby(const Grains<D>& grains, const HybridSetup<D>& setup, double margin)
    : grown(grains), list(setup.domain, {near_skin * setup.diameter, far_skin * setup.diameter}) {
  for (double& R : grown.radius) R += margin * setup.diameter / 2;
}

template <int D>
HybridEngine<D>::HybridEngine(Grains<D> grains, const HybridSetup<D>& setup)
    : setup_(setup),
      grains_(std::move(grains)),
      gravity_(setup.gravity),
      from_(grains_.moving),
      one_step_(setup_, grains_),
      usual_(grains_, setup, usual_margin),
      fast_(grains_, setup, fast_margin),
      meetings_(grains_.moving, setup.time_step),
      touches_(grains_.moving, setup.time_step),
      team_(std::make_unique<Team>(setup.threads)) {
  flights_.resize(grains_.size());
  for (std::size_t i = 0; i < grains_.size(); ++i) {
    auto& f = flights_[i];
    f.place = grains_.place(i);
    f.radius = grains_.radius[i];
    if (i >= grains_.moving) continue;
    f.velocity = grains_.speed(i);
    f.gravity = setup_.gravity;
    f.spin = grains_.turning(i);
    f.orientation = grains_.attitude(i);
    for (std::size_t k = 0; k < D; ++k) f.wraps[k] = grains_.wraps[k][i];
    hard::Flight<D>::wrap(f.place, f.wraps, setup_.domain);
  }
  engines::refuse_deep_start<D>(grains_, setup_, engines::deepest_that_is_pushed_apart);
  for (auto& f : force_) f.assign(grains_.size(), 0);
  show();
  start_place_ = unwrapped_places<D>(this->grains());
  account_.start = energy().stored();
}

template <int D>
void HybridEngine<D>::advance(std::int64_t step) {
  if (step <= step_) return;
  while (step_ < step) take_step();
  show();
  for (std::size_t i = 0; i < grains_.moving; ++i)
    if (grains_.position[D - 1][i] < setup_.floor) leave_physics(i, "it fell through the bed");
}

template <int D>
void HybridEngine<D>::take_step() {
  const double end = static_cast<double>(step_ + 1) * setup_.time_step;
  if (setup_.tilt) tilt(end - setup_.time_step / 2);
  const double farthest = fly(end);
  find_pairs(farthest > 0.5 * usual_margin * setup_.diameter ? fast_ : usual_, 2 * farthest, end);
  const auto& outcome = one_step_.collide(flights_, pairs_, end, *team_);
  for (const auto k : outcome.order) account(outcome.hits[k]);
  hits_ += outcome.collisions;
  put_off_ += outcome.put_off;
  account_.normal_loss += outcome.normal_loss;
  account_.shear_loss += outcome.shear_loss;
  account_.wall_work += outcome.wall_work;
  push_apart(end);
  if (setup_.tilt) note_work();
  ++step_;
}

/// Gravity as it is in this step, and from where it works.
template <int D>
void HybridEngine<D>::tilt(double middle) {
  gravity_ = setup_.gravity_at(middle);
  for (std::size_t i = 0; i < grains_.moving; ++i) {
    flights_[i].gravity = gravity_;
    from_[i] = unwrapped(i);
  }
}
template <int D>
void HybridEngine<D>::note_work() {
  for (std::size_t i = 0; i < grains_.moving; ++i)
    account_.gravity_work += grains_.mass[i] * dot(gravity_, unwrapped(i) - from_[i]);
}
template <int D>
Vec<D> HybridEngine<D>::unwrapped(std::size_t i) const {
  Vec<D> place = flights_[i].place;
  for (int k = 0; k < D; ++k)
    if (setup_.domain.periodic(k))
      place[k] += flights_[i].wraps[static_cast<std::size_t>(k)] * setup_.domain.length[k];
  return place;
}

/// How far the farthest grain would fly in the step, if nothing stopped it.
template <int D>
double HybridEngine<D>::fly(double end) {
  double farthest = 0;
  for (std::size_t i = 0; i < grains_.moving; ++i) {
    const auto& f = flights_[i];
    const double way = norm(f.place_at(end) - f.place);
    if (!(way <= farthest_move * setup_.diameter)) moved_too_far(i, way / setup_.diameter, farthest_move);
    farthest = std::max(farthest, way);
  }
  return farthest;
}

/// The pairs within the margin where they would fly to; exactly these, whatever the list still holds besides.
template <int D>
void HybridEngine<D>::find_pairs(Nearby& nearby, double margin, double end) {
  auto& grown = nearby.grown;
  for (std::size_t i = 0; i < grains_.moving; ++i) {
    const Vec<D> place = flights_[i].place_at(end);
    for (int k = 0; k < D; ++k) grown.position[static_cast<std::size_t>(k)][i] = place[k];
  }
  const auto& candidates = nearby.list.near(grown, *team_).pairs;
  pairs_.clear();
  const auto first = [&](std::size_t p) { return static_cast<std::size_t>(candidates.i[p]); };
  const auto second = [&](std::size_t p) { return static_cast<std::size_t>(candidates.j[p]); };
  const auto may_meet = [&](std::size_t p) {
    const Vec<D> way = setup_.domain.way(grown.place(first(p)), grown.place(second(p)));
    const double reach = grains_.radius[first(p)] + grains_.radius[second(p)] + margin;
    return dot(way, way) < reach * reach;
  };
  search::for_those({0, candidates.size()}, may_meet,
                    [&](std::size_t p) { pairs_.add(first(p), second(p)); });
}

template <int D>
Contact HybridEngine<D>::told(std::size_t i, std::size_t j, const Vec<D>& place, const Vec<D>& way,
                              const Vec<D>& force) const {
  const double distance = norm(way);
  const Vec<D> n = (1 / distance) * way;
  Contact contact;
  contact.a = static_cast<std::int64_t>(i);
  contact.b = is_wall(j) ? wall_id(j - grains_.size()) : static_cast<std::int64_t>(j);
  contact.overlap = grains_.radius[i] + (is_wall(j) ? 0 : grains_.radius[j]) - distance;
  contact.point = as_file_vector(place + (grains_.radius[i] - 0.5 * contact.overlap) * n);
  contact.branch = as_file_vector(way);
  set_force(contact, n, force);
  return contact;
}

/// What others see of the collisions of two in a step.
template <int D>
void HybridEngine<D>::account(const Hit<D>& hit) {
  const hard::Meeting* train = meetings_.running(hit.i, hit.j, hit.first);
  note_touch(hit, (1 / norm(hit.way)) * hit.way, train);
  meetings_.note(hit.i, hit.j, hit.first, as_file_vector(hit.impulse));
  if (hit.collisions > 1) {
    touches_.hold(hit.last, hit.i, hit.j);
    meetings_.note(hit.i, hit.j, hit.last, as_file_vector(hit.further));
  }
  if (collecting_collisions_)
    collisions_.push_back({told(hit.i, hit.j, hit.place, hit.way, hit.impulse + hit.further), hit.first});
}

/// An impact, or the lasting contact goes on; n from i to j.
template <int D>
void HybridEngine<D>::note_touch(const Hit<D>& hit, const Vec<D>& n, const hard::Meeting* train) {
  if (train) return touches_.hold(hit.first, hit.i, hit.j);
  const bool both = hit.j < grains_.moving;  // then the one with the lower id counts as the bead
  const double sign = both ? 1 : -1;
  Impact impact = impact_at(hit.first, sign * n, sign * hit.velocity, hit.place + grains_.radius[hit.i] * n);
  impact.grain = static_cast<std::int64_t>(both ? hit.j : hit.i);
  impact.bead = static_cast<std::int64_t>(both ? hit.i : hit.j);
  touches_.begin(impact);
  touches_.end(hit.first, hit.i, hit.j);
  if (is_wall(hit.j)) impact.bead = wall_id(hit.j - grains_.size());
  if (collecting_) impacts_.push_back(impact);
}

template <int D>
void HybridEngine<D>::move_apart(std::size_t i, const Vec<D>& way) {
  flights_[i].place = flights_[i].place + way;
  account_.projection_work -= grains_.mass[i] * dot(gravity_, way);
}

/// Takes a part of what overlaps: places only, by inverse masses, one contact after the other in their order. A grain in a
/// layer that is moved presses into the next, so there are several passes, of which all together take that part of a pair
/// that has no neighbours.
template <int D>
void HybridEngine<D>::push_apart(double end) {
  const double part = 1 - std::pow(1 - setup_.relaxation, 1.0 / passes);
  deepest_ = 0;
  find_overlapping();
  for (int pass = 0; pass < passes; ++pass) {
    const auto push = [&](double overlap) {
      if (pass == 0) deepest_ = std::max(deepest_, overlap);
      return part * std::max(0.0, overlap - slop * setup_.diameter);
    };
    push_pairs_apart(push);
    push_off_walls(end, push);
  }
}

/// Who may overlap now, or after others have been pushed.
template <int D>
void HybridEngine<D>::find_overlapping() {
  constexpr double near = 1e-2;  // of d
  overlapping_.clear();
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    const auto i = static_cast<std::size_t>(pairs_.i[p]), j = static_cast<std::size_t>(pairs_.j[p]);
    const double reach = flights_[i].radius + flights_[j].radius + near * setup_.diameter;
    const Vec<D> way = setup_.domain.way(flights_[i].place, flights_[j].place);
    if (dot(way, way) < reach * reach) overlapping_.push_back(p);
  }
}

template <int D>
template <class Push>
void HybridEngine<D>::push_pairs_apart(const Push& push) {
  for (const auto p : overlapping_) {
    const auto i = static_cast<std::size_t>(pairs_.i[p]), j = static_cast<std::size_t>(pairs_.j[p]);
    const double reach = flights_[i].radius + flights_[j].radius;
    const Vec<D> way = setup_.domain.way(flights_[i].place, flights_[j].place);
    if (dot(way, way) >= reach * reach) continue;
    const double distance = norm(way);
    const Vec<D> apart =
        push(reach - distance) / (distance * (grains_.inverse_mass[i] + grains_.inverse_mass[j])) * way;
    move_apart(i, -grains_.inverse_mass[i] * apart);
    if (j < grains_.moving) move_apart(j, grains_.inverse_mass[j] * apart);
  }
}

template <int D>
template <class Push>
void HybridEngine<D>::push_off_walls(double end, const Push& push) {
  for (const auto& wall : setup_.walls)
    for (std::size_t i = 0; i < grains_.moving; ++i) {
      const auto touch = wall.nearest(flights_[i].place, end, setup_.domain);
      if (touch.height < flights_[i].radius)
        move_apart(i, push(flights_[i].radius - touch.height) * touch.normal);
    }
}

template <int D>
std::vector<std::pair<std::string, double>> HybridEngine<D>::tells() const {
  return {{"collisions", static_cast<double>(hits_)},
          {"collisions_put_off", static_cast<double>(put_off_)},
          {"deepest_overlap", deepest_}};
}

/// Brings what others see to the latest step.
template <int D>
void HybridEngine<D>::show() {
  for (std::size_t i = 0; i < grains_.size(); ++i) {
    const auto& f = flights_[i];
    for (int k = 0; k < D; ++k) {
      const auto axis = static_cast<std::size_t>(k);
      grains_.position[axis][i] = f.place[k];
      grains_.velocity[axis][i] = f.velocity[k];
      if (i < grains_.moving) grains_.wraps[axis][i] = f.wraps[axis];
      force_[axis][i] = 0;
    }
    for (std::size_t k = 0; k < orientation_numbers<D>; ++k)
      grains_.orientation[k][i] = f.orientation[static_cast<int>(k)];
    for (std::size_t k = 0; k < turns<D>; ++k) grains_.spin[k][i] = f.spin[static_cast<int>(k)];
  }
  for (const auto& c : contacts())
    for (std::size_t k = 0; k < D; ++k) {
      force_[k][static_cast<std::size_t>(c.a)] -= c.force[k];
      if (!chute::is_wall(c.b)) force_[k][static_cast<std::size_t>(c.b)] += c.force[k];
    }
}

template <int D>
GrainsView HybridEngine<D>::grains() const {
  return view_of(grains_, force_, setup_.domain, time());
}

template <int D>
EnergyAccount HybridEngine<D>::energy() const {
  EnergyAccount e = account_;
  e.add_motion(grains(), setup_.tilt ? Vec<D>{} : setup_.gravity, start_place_);
  return e;
}

template <int D>
std::vector<Contact> HybridEngine<D>::contacts() const {
  std::vector<Contact> lasting;
  for (std::size_t i = 0; i < grains_.moving; ++i)
    for (const auto& m : meetings_.of(i)) {
      if (!m.lasting() || !meetings_.runs(m, time())) continue;
      const auto j = static_cast<std::size_t>(m.other);
      Vec<D> force, way;
      for (int k = 0; k < D; ++k) force[k] = m.impulse[static_cast<std::size_t>(k)] / (m.last - m.first);
      if (is_wall(j)) {
        const auto touch = wall_of(j).nearest(grains_.place(i), time(), setup_.domain);
        way = -touch.height * touch.normal;
      } else {
        way = setup_.domain.way(grains_.place(i), grains_.place(j));
      }
      lasting.push_back(told(i, j, grains_.place(i), way, force));
    }
  std::sort(lasting.begin(), lasting.end(),
            [](const Contact& a, const Contact& b) { return std::pair(a.a, a.b) < std::pair(b.a, b.b); });
  return lasting;
}

/// Everything that changes during a run, for both directions of a checkpoint.
template <int D>
template <class Archive, class Self>
void HybridEngine<D>::transfer(Archive& archive, Self& self) {
  for (std::size_t i = 0; i < self.grains_.moving; ++i) {
    auto& f = self.flights_[i];
    archive(f.place.c, f.velocity.c, f.spin.c, f.orientation.c, f.wraps, f.time);
  }
  archive(kept(self.start_place_), self.meetings_, self.touches_, self.account_, self.step_, self.hits_,
          self.put_off_, self.deepest_, self.one_step_.pressings());
}

template <int D>
void HybridEngine<D>::save(std::ostream& out) const {
  StateOutput archive(out);
  transfer(archive, *this);
}

template <int D>
void HybridEngine<D>::restore(std::istream& in) {
  StateInput archive(in);
  transfer(archive, *this);
  show();
}

template class HybridEngine<2>;
template class HybridEngine<3>;

}  // namespace chute::hybrid
