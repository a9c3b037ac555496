#include "engines/event/event_engine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cereal/types/array.hpp>
#include <cereal/types/vector.hpp>
#include <cmath>

#include "common/error.hpp"
#include "common/state_archive.hpp"
#include "engines/hard/first_contact.hpp"
#include "engines/hard/thermal_wall.hpp"
#include "engines/hard/wall_flight.hpp"
#include "engines/kind/deep_start.hpp"

namespace chute::event {
namespace {

/// A collapse shows as a grain that collides this often within a short time, in units of the time in which a
/// grain falls its own size: bounces of 1e-6 of it rise to 1e-13 of that size, and a little below, rounding
/// of places keeps kicking the grain about, so that a collapse need not end. A contact time of more than some
/// 1e-5 of it keeps clear of this.
constexpr std::int64_t collapse_collisions = 1000;
constexpr double collapse_time = 1e-3;

/// Two grains whose distance at their collision is off by more than this part of R_i + R_j have missed it: an
/// error of this engine, not of the scene.
constexpr double missed = 1e-6;

/// Grains may overlap by this part of the smaller radius at the start: rounding of places that were meant to touch.
constexpr double touching = 2e-9;

/// Lower bound of the rebound in a lasting contact, in units of g t_c. The bounce then lasts at least t_c/2
/// on a level bead, safely within the train; 1/2 would end it.
constexpr double least_rebound = 0.25;

}  // namespace

template <int D>
EventEngine<D>::EventEngine(Grains<D> grains, const EventSetup<D>& setup)
    : setup_(setup),
      grains_(std::move(grains)),
      meetings_(grains_.moving, setup.contact_time),
      touches_(grains_.moving, setup.contact_time) {
  if (!grains_.independent) {
    engines::refuse_deep_start<D>(grains_, setup_, engines::deepest_of_soft_grains);
    engines::push_apart<D>(grains_, setup_, touching);
  }
  const std::size_t n = grains_.size(), moving = grains_.moving;
  flights_.resize(n);
  double widest_moving = 0, widest_fixed = 0;
  for (std::size_t i = 0; i < n; ++i) {
    Flight<D>& f = flights_[i];
    f.place = grains_.place(i);
    f.radius = grains_.radius[i];
    double& widest = i < moving ? widest_moving : widest_fixed;
    widest = std::max(widest, f.radius);
    if (i < moving) {
      f.velocity = grains_.speed(i);
      f.gravity = setup_.gravity;
      f.spin = grains_.turning(i);
      f.orientation = grains_.attitude(i);
      for (std::size_t k = 0; k < D; ++k) f.wraps[k] = grains_.wraps[k][i];
    }
    Flight<D>::wrap(f.place, f.wraps, setup_.domain);
  }
  reach_ = widest_moving +
           (moving > 1 && !grains_.independent ? std::max(widest_moving, widest_fixed) : widest_fixed);
  for (int k = 0; k < D; ++k) {
    if (setup_.domain.length[k] < 2 * reach_)
      throw WorkError(
          fmt::format("a periodic domain of length {} is too short for grains of radius {}: needed {}",
                      setup_.domain.length[k], widest_moving, 2 * reach_));
    force_[static_cast<std::size_t>(k)].assign(n, 0);
  }
  outlook_.resize(moving);
  courses_.resize(n);
  show();
  start_place_ = unwrapped_places<D>(this->grains());
  account_.start = energy().stored();
  const double g = norm(setup_.gravity);
  double fastest = 0;
  for (std::size_t i = 0; i < moving; ++i) fastest = std::max(fastest, norm(flights_[i].velocity));
  still_ = collapse_time * (g > 0 ? std::sqrt(reach_ / g) : reach_ / fastest);
  lay_out();
  engines::refuse_deep_start<D>(grains_, setup_, touching);
}

/// When two grains meet, if not surely later than `limit`. Computed from the later of their last collisions,
/// and always the same way round: the same bytes whoever asks, and when.
template <int D>
double EventEngine<D>::contact_with(std::size_t i, const Near& near, double limit) {
  constexpr double never = std::numeric_limits<double>::infinity();
  constexpr double margin = 1e-9;  // bounds that tell most pairs apart are exact but for rounding
  ++work_.candidates;
  const auto j = static_cast<std::size_t>(near.other);
  const bool swapped = j < i;
  const std::size_t low = swapped ? j : i, high = swapped ? i : j;
  const Course &a = courses_[low], &b = courses_[high];
  const bool both = high < grains_.moving;
  const double from = std::max(a.time, b.time), t_a = from - a.time, t_b = from - b.time;
  const Vec<D>& g = setup_.gravity;
  hard::Approach<D> approach;
  for (int k = 0; k < D; ++k) {
    const double g_b = both ? g[k] : 0;
    const double place_a = a.place[k] + t_a * (a.velocity[k] + (0.5 * t_a) * g[k]);
    const double place_b = b.place[k] + t_b * (b.velocity[k] + (0.5 * t_b) * g_b);
    approach.d[k] = place_a - place_b;
    approach.v[k] = (a.velocity[k] + t_a * g[k]) - (b.velocity[k] + t_b * g_b);
    approach.a[k] = g[k] - g_b;
  }
  if (near_.is_shifted(i, near)) {
    const auto shift = near_.shift(i, near);
    for (int k = 0; k < D; ++k)
      if (const int periods = shift[static_cast<std::size_t>(k)]; periods != 0)
        approach.d[k] -= (swapped ? -periods : periods) * setup_.domain.length[k];
  }
  approach.reach = a.radius + b.radius;
  if (both) {
    const double closing = dot(approach.d, approach.v);
    if (!(closing < 0)) return never;
    const double reach2 = approach.reach * approach.reach, c = dot(approach.d, approach.d) - reach2;
    const double v2 = dot(approach.v, approach.v);
    if (closing * closing + margin * reach2 * v2 < v2 * c) return never;  // they pass each other
    if (c > (2 + margin) * -closing * (limit - from)) return never;       // not so soon, if they met head on
  } else if (from + approach.earliest() * (1 - margin) > limit) {
    return never;  // it saves most of the quartics
  }
  ++work_.predictions;
  return from + (both ? hard::first_contact_linear(approach) : hard::first_contact(approach));
}

template <int D>
double EventEngine<D>::contact_with_wall(std::size_t i, std::size_t wall, double limit) const {
  return hard::first_contact_with_wall(flights_[i], setup_.walls[wall], setup_.domain, limit);
}

template <int D>
void EventEngine<D>::look_at(std::size_t i, const Near& near) {
  Prospect& first = outlook_[i].first;
  const auto j = static_cast<std::size_t>(near.other);
  const double t = contact_with(i, near, first.time);
  if (t < first.time || (t == first.time && t < std::numeric_limits<double>::infinity() && j < first.other))
    first = {t, j, flights_[j].collisions};
}

/// Looks for grain i's earliest collision among all near it, the likely one first.
template <int D>
void EventEngine<D>::look(std::size_t i, std::size_t likely) {
  outlook_[i].first = {};
  const auto near = near_.of(i);
  for (const Near& other : near) __builtin_prefetch(&courses_[static_cast<std::size_t>(other.other)]);
  if (likely != i)
    for (const Near& other : near)
      if (static_cast<std::size_t>(other.other) == likely) look_at(i, other);
  for (const Near& other : near)
    if (static_cast<std::size_t>(other.other) != likely) look_at(i, other);
  Prospect& first = outlook_[i].first;
  for (std::size_t w = 0; w < setup_.walls.size(); ++w)
    if (const double t = contact_with_wall(i, w, first.time); t < first.time)
      first = {t, grains_.size() + w, 0};
}

/// When something must be done about grain i.
template <int D>
double EventEngine<D>::plan(std::size_t i) {
  outlook_[i].moves = near_.leaves(i, flights_[i], now_);
  const double next = std::min(outlook_[i].first.time, outlook_[i].moves);
  if (std::isnan(next)) leave_physics(i, "its place is not a number");
  return next;
}

template <int D>
void EventEngine<D>::set_course(std::size_t i) {
  const Flight<D>& f = flights_[i];
  courses_[i] = {f.place, f.velocity, f.time, f.radius};
}

template <int D>
void EventEngine<D>::lay_out() {
  ++work_.layouts;
  for (std::size_t i = 0; i < grains_.size(); ++i) set_course(i);
  near_.build(flights_, setup_.domain, grains_.moving, grains_.independent, now_);
  std::vector<double> times(grains_.moving);
  for (std::size_t i = 0; i < grains_.moving; ++i) look(i, i), times[i] = plan(i);
  queue_.start(times);
  next_look_ = work_.collisions + work_.moves + 16 * static_cast<std::int64_t>(grains_.moving);
}

template <int D>
void EventEngine<D>::advance(std::int64_t step) {
  if (step <= step_) return;
  const double until = static_cast<double>(step) * setup_.tick;
  while (!queue_.empty() && queue_.next().time <= until) {
    const auto [time, i] = queue_.next();
    now_ = std::max(now_, time);
    const Prospect& next = outlook_[i].first;
    if (outlook_[i].moves < next.time) {
      ++work_.moves;
      if (near_.follow(i, flights_[i], now_))
        for (const Near& near : near_.of(i)) look_at(i, near);
      queue_.set(i, plan(i));
    } else if (!is_wall(next.other) && flights_[next.other].collisions != next.other_collisions) {
      ++work_.outdated;
      look(i, i);
      queue_.set(i, plan(i));
    } else {
      collide(i, next.other);
    }
    if (work_.collisions + work_.moves >= next_look_) {
      next_look_ += 16 * static_cast<std::int64_t>(grains_.moving);
      if (near_.outgrown(flights_, now_)) lay_out();
    }
  }
  step_ = step;
  show();
  for (std::size_t i = 0; i < grains_.moving; ++i)
    if (grains_.position[D - 1][i] < setup_.floor) leave_physics(i, "it fell through the bed");
}

template <int D>
laws::Collider<D> EventEngine<D>::collider(std::size_t i, const Vec<D>& n) const {
  if (is_wall(i)) return hard::collider_of(wall_of(i), {0, -1.0 * n}, now_);
  const Flight<D>& f = flights_[i];
  return {f.velocity, f.spin, f.radius, grains_.inverse_mass[i], grains_.inverse_inertia[i]};
}

/// The collision itself, with the cut-off against collapse; n from a to b.
template <int D>
laws::Collision<D> EventEngine<D>::exchange(const Vec<D>& n, const HardContact& contact, const Meeting* train,
                                            laws::Collider<D>& a, laws::Collider<D>& b) {
  const double v_n = dot(b.velocity - a.velocity, n);
  const double e_n = laws::restitution_at(contact.restitution, v_n);
  if (!train) return contact.tangential(n, e_n, a, b);
  const double since = now_ - train->last, t_c = meetings_.contact_time();
  if (since < t_c) ++work_.elastic;
  const double cut_off = laws::ContactTimeCutoff{t_c}(e_n, since, since);
  const double least = since < t_c ? least_rebound * norm(setup_.gravity) * t_c : 0;
  if (v_n < 0) return contact.tangential(n, std::max(cut_off, least / -v_n), a, b);
  // A touch without approach: rounding, or grains that do not rebound at all. A normal push parts them.
  laws::Collision<D> push;
  const double m_eff = 1 / (a.inverse_mass + b.inverse_mass), rebound = std::max(v_n, least);
  push.impulse = (m_eff * (rebound - v_n)) * n;
  push.normal_loss = 0.5 * m_eff * (v_n * v_n - rebound * rebound);
  laws::apply_impulse(n, push.impulse, a, b);
  return push;
}

/// Grain i leaves a wall that heats, whose surface moves; n from the grain to the wall. Which random numbers it takes says
/// the time, which no other hit has.
template <int D>
laws::Collision<D> EventEngine<D>::warm(std::size_t i, const Vec<D>& n, double T, const Vec<D>& surface,
                                        laws::Collider<D>& a) {
  Random random(setup_.seed, Purpose::engine, i,
                std::bit_cast<std::uint64_t>(now_) & ((std::uint64_t{1} << 56) - 1));
  const double m = grains_.mass[i], before = dot(a.velocity, a.velocity);
  const Vec<D> leaves = surface + hard::thermal_velocity<D>(-1.0 * n, T, m, random);
  laws::Collision<D> done;
  done.impulse = m * (a.velocity - leaves);
  a.velocity = leaves;
  account_.wall_work += 0.5 * m * (dot(leaves, leaves) - before) + dot(done.impulse, surface);
  return done;
}

template <int D>
void EventEngine<D>::collide(std::size_t first, std::size_t second) {
  ++work_.collisions;
  const std::size_t i = std::min(first, second), j = std::max(first, second);
  const bool both = j < grains_.moving;
  for (const std::size_t k : {i, j})
    if (k < grains_.moving) near_.unwind(k, flights_[k].move_to(now_, setup_.domain));
  const Vec<D> way = way_to(j, flights_[i].place, is_wall(j) ? Vec<D>{} : flights_[j].place, now_);
  const double distance = norm(way), reach = flights_[i].radius + (is_wall(j) ? 0 : flights_[j].radius);
  if (!(std::abs(distance - reach) <= missed * reach))
    leave_physics(i, fmt::format("it met {} at a distance of {} instead of {}",
                                 is_wall(j) ? "a wall" : fmt::format("grain {}", j), distance, reach));
  const Vec<D> n = (1 / distance) * way;

  const Meeting* train = meetings_.running(i, j, now_);
  note_touch(i, j, n, train);
  laws::Collider<D> a = collider(i, n), b = collider(j, n);
  const Vec<D> surface = b.velocity;
  const auto own = is_wall(j) ? wall_of(j).surface : WallSurface{};
  const auto done = own.temperature
                        ? warm(i, n, *own.temperature, surface, a)
                        : exchange(n, hard::contact_between(setup_, grains_, i, j).with(own), train, a, b);
  if (is_wall(j)) account_.wall_work -= dot(done.impulse, surface);
  if (collecting_) {
    const auto id = [&](std::size_t k) {
      return is_wall(k) ? wall_id(k - grains_.size()) : static_cast<std::int64_t>(k);
    };
    partings_.push_back(
        {now_, id(both ? j : i), id(both ? i : j), dot(b.velocity - a.velocity, n), train != nullptr});
  }
  meetings_.note(i, j, now_, as_file_vector(done.impulse));
  if (collecting_collisions_) collisions_.push_back({told(i, j, flights_[i].place, way, done.impulse), now_});
  account_.normal_loss += done.normal_loss;
  account_.shear_loss += done.shear_loss;

  flights_[i].velocity = a.velocity, flights_[i].spin = a.spin, ++flights_[i].collisions;
  if (both) flights_[j].velocity = b.velocity, flights_[j].spin = b.spin, ++flights_[j].collisions;
  check_collapse(i);
  if (both) check_collapse(j);
  for (const std::size_t k : {i, j})
    if (k < grains_.moving) set_course(k);
  for (const std::size_t k : {i, j})
    if (k < grains_.moving) look(k, k == i ? j : i), queue_.set(k, plan(k));
}

/// The shortest way from a place to a grain at `to`, or to a wall.
template <int D>
Vec<D> EventEngine<D>::way_to(std::size_t partner, const Vec<D>& from, const Vec<D>& to, double t) const {
  if (!is_wall(partner)) return setup_.domain.way(from, to);
  const auto nearest = wall_of(partner).nearest(from, t, setup_.domain);
  return -nearest.height * nearest.normal;
}

template <int D>
Contact EventEngine<D>::told(std::size_t i, std::size_t partner, const Vec<D>& place, const Vec<D>& way,
                             const Vec<D>& force) const {
  const Vec<D> n = (1 / norm(way)) * way;
  Contact contact;
  contact.a = static_cast<std::int64_t>(i);
  contact.b = is_wall(partner) ? wall_id(partner - grains_.size()) : static_cast<std::int64_t>(partner);
  contact.point = as_file_vector(place + grains_.radius[i] * n);
  contact.branch = as_file_vector(way);
  set_force(contact, n, force);
  return contact;
}

/// An impact, or the rolling contact goes on; n from i to j.
template <int D>
void EventEngine<D>::note_touch(std::size_t i, std::size_t j, const Vec<D>& n, const Meeting* train) {
  if (train) return touches_.hold(now_, i, j);
  const bool both = j < grains_.moving;  // then the one with the lower id counts as the bead
  const auto grain = both ? j : i, bead = both ? i : j;
  const Vec<D> out = both ? n : -1.0 * n;
  const Flight<D>& hitting = flights_[grain];
  const Vec<D> v = hitting.velocity - collider(bead, n).velocity;
  Impact impact = impact_at(now_, out, v, hitting.place - hitting.radius * out);
  impact.grain = static_cast<std::int64_t>(grain);
  impact.bead = static_cast<std::int64_t>(bead);
  touches_.begin(impact);
  touches_.end(now_, i, j);
  if (is_wall(bead)) impact.bead = wall_id(bead - grains_.size());
  if (collecting_) impacts_.push_back(impact);
}

template <int D>
void EventEngine<D>::check_collapse(std::size_t i) {
  Outlook& burst = outlook_[i];
  if (now_ - burst.burst_begin > still_) burst.burst_begin = now_, burst.burst_collisions = 0;
  if (++burst.burst_collisions > collapse_collisions)
    leave_physics(
        i, fmt::format("inelastic collapse: it collides ever more often ({} times within {:.2g}); give a "
                       "contact time, or a longer one, below which collisions are elastic",
                       burst.burst_collisions, still_));
}

template <int D>
std::vector<Impact> EventEngine<D>::take_impacts() {
  return std::exchange(impacts_, {});
}

/// Brings what others see to the current tick. The flights stay as they are.
template <int D>
void EventEngine<D>::show() {
  const double t = time();
  for (std::size_t i = 0; i < grains_.size(); ++i) {
    const Flight<D>& f = flights_[i];
    Vec<D> place = f.place_at(t);
    const Vec<D> velocity = f.velocity_at(t);
    const auto orientation = f.orientation_at(t);
    auto wraps = f.wraps;
    Flight<D>::wrap(place, wraps, setup_.domain);
    for (int k = 0; k < D; ++k) {
      const auto axis = static_cast<std::size_t>(k);
      grains_.position[axis][i] = place[k];
      grains_.velocity[axis][i] = velocity[k];
      if (i < grains_.moving) grains_.wraps[axis][i] = wraps[axis];
      force_[axis][i] = 0;
    }
    for (int k = 0; k < orientation_numbers<D>; ++k)
      grains_.orientation[static_cast<std::size_t>(k)][i] = orientation[k];
    for (int k = 0; k < turns<D>; ++k) grains_.spin[static_cast<std::size_t>(k)][i] = f.spin[k];
  }
  for (const auto& c : contacts())
    for (std::size_t k = 0; k < D; ++k) {
      force_[k][static_cast<std::size_t>(c.a)] -= c.force[k];
      if (!chute::is_wall(c.b)) force_[k][static_cast<std::size_t>(c.b)] += c.force[k];
    }
}

template <int D>
GrainsView EventEngine<D>::grains() const {
  return view_of(grains_, force_, setup_.domain, time());
}

template <int D>
EnergyAccount EventEngine<D>::energy() const {
  EnergyAccount e = account_;
  e.add_motion(grains(), setup_.gravity, start_place_);
  return e;
}

template <int D>
std::vector<Contact> EventEngine<D>::contacts() const {
  std::vector<Contact> lasting;
  for (std::size_t i = 0; i < grains_.moving; ++i)
    for (const Meeting& m : meetings_.of(i)) {
      if (!m.lasting() || !meetings_.runs(m, time())) continue;
      const auto j = static_cast<std::size_t>(m.other);
      Vec<D> force;
      for (int k = 0; k < D; ++k) force[k] = m.impulse[static_cast<std::size_t>(k)] / (m.last - m.first);
      const Vec<D> way = way_to(j, grains_.place(i), is_wall(j) ? Vec<D>{} : grains_.place(j), time());
      lasting.push_back(told(i, j, grains_.place(i), way, force));
      lasting.back().overlap = grains_.radius[i] + (is_wall(j) ? 0 : grains_.radius[j]) - norm(way);
    }
  std::sort(lasting.begin(), lasting.end(),
            [](const Contact& a, const Contact& b) { return std::pair(a.a, a.b) < std::pair(b.a, b.b); });
  return lasting;
}

/// Everything that changes during a run, for both directions of a checkpoint. Lists, queue and predictions
/// follow from it.
template <int D>
template <class Archive, class Self>
void EventEngine<D>::transfer(Archive& archive, Self& self) {
  for (std::size_t i = 0; i < self.grains_.moving; ++i) {
    auto& f = self.flights_[i];
    archive(f.place.c, f.velocity.c, f.spin.c, f.orientation.c, f.wraps, f.time);
    archive(self.outlook_[i].burst_begin, self.outlook_[i].burst_collisions);
  }
  archive(kept(self.start_place_), self.meetings_, self.touches_, self.account_, self.now_, self.step_);
}

template <int D>
void EventEngine<D>::save(std::ostream& out) const {
  StateOutput archive(out);
  transfer(archive, *this);
}

template <int D>
void EventEngine<D>::restore(std::istream& in) {
  StateInput archive(in);
  transfer(archive, *this);
  show();
  lay_out();
}

template class EventEngine<2>;
template class EventEngine<3>;

}  // namespace chute::event
