#include "engines/hybrid/step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "engines/hard/first_contact.hpp"
#include "engines/hard/wall_flight.hpp"

namespace chute::hybrid {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// Fewer pairs than this are looked at sooner by one thread than the others are woken; each takes some 10 ns.
constexpr std::size_t looks_worth_sharing = 4096;

/// An approach slower than this part of what gravity gives in a step is rounding: the grains touch and do not collide.
constexpr double rounding = 1e-9;

/// A gap below this part of the squared reach may be closed already, but for rounding.
constexpr double closed = 1e-12;

/// What has to be added to the way between two places to make it the one to the nearest image.
template <int D>
Vec<D> image_of(const Vec<D>& way, const Domain<D>& domain) {
  Vec<D> image;
  for (int k = 0; k < D; ++k) {
    const double half = domain.length[k] / 2;
    image[k] = way[k] > half ? -domain.length[k] : way[k] < -half ? domain.length[k] : 0;
  }
  return image;
}

}  // namespace

template <int D>
void Step<D>::take_off() {
  bodies_.resize(grains_.size());
  for (std::size_t i = 0; i < grains_.size(); ++i) {
    const auto& f = (*flights_)[i];
    auto& b = bodies_[i];
    b.place = f.place, b.velocity = f.velocity, b.spin = f.spin;
    b.radius = f.radius, b.inverse_mass = grains_.inverse_mass[i];
    b.inverse_inertia = grains_.inverse_inertia[i];
    b.time = 0, b.collisions = 0;
  }
}

template <int D>
void Step<D>::arrive() {
  for (std::size_t i = 0; i < grains_.moving; ++i) {
    auto& f = (*flights_)[i];
    const auto& b = bodies_[i];
    f.place = b.place, f.velocity = b.velocity, f.spin = b.spin;
    f.orientation = turned<D>(f.orientation, b.spin, length_ - b.time);
    f.place = b.place + length_ * (b.velocity + (0.5 * length_) * gravity_);
    f.velocity = b.velocity + length_ * gravity_;
    f.time = end_;
    hard::Flight<D>::wrap(f.place, f.wraps, setup_.domain);
  }
}

/// The pairs, and the grains with each wall that they can reach, by grain.
template <int D>
void Step<D>::list_partners(const search::PairNames& pairs) {
  partners_.clear();
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const auto i = static_cast<std::uint32_t>(pairs.i[p]), j = static_cast<std::uint32_t>(pairs.j[p]);
    partners_.push_back(
        {.i = i, .j = j, .image = image_of<D>(bodies_[j].place - bodies_[i].place, setup_.domain)});
  }
  const double fall = 0.5 * norm(setup_.gravity) * length_ * length_;
  for (std::size_t w = 0; w < setup_.walls.size(); ++w) {
    const auto& wall = setup_.walls[w];
    for (std::size_t i = 0; i < grains_.moving; ++i) {
      const auto& b = bodies_[i];
      // Twice the way: a collision may throw it on, and at most a resting pile presses it anew.
      const double reach = b.radius + 2 * ((norm(b.velocity) + wall.top_speed()) * length_ + fall) +
                           farthest_move * setup_.diameter;
      if (wall.nearest(b.place, begin_, setup_.domain).height < reach)
        partners_.push_back(
            {.i = static_cast<std::uint32_t>(i), .j = static_cast<std::uint32_t>(grains_.size() + w)});
    }
  }
  first_.assign(grains_.moving + 1, 0);
  const auto each_grain = [&](auto&& visit) {
    for (std::uint32_t p = 0; p < partners_.size(); ++p) {
      visit(partners_[p].i, p);
      if (moves(partners_[p].j)) visit(partners_[p].j, p);
    }
  };
  each_grain([&](std::uint32_t i, std::uint32_t) { ++first_[i + 1]; });
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  of_.resize(first_.back());
  auto next = first_;
  each_grain([&](std::uint32_t i, std::uint32_t p) { of_[next[i]++] = p; });
}

/// The same as a flight, from the last collision on: what walls ask for.
template <int D>
hard::Flight<D> Step<D>::flight(std::size_t i) const {
  const auto& b = bodies_[i];
  hard::Flight<D> f;
  f.place = b.place + b.time * (b.velocity + (0.5 * b.time) * gravity_);
  f.velocity = b.velocity + b.time * gravity_;
  f.gravity = gravity_;
  f.radius = b.radius;
  f.time = begin_ + b.time;
  return f;
}

template <int D>
std::int32_t Step<D>::version(const Partners& p) const {
  return bodies_[p.i].collisions + (moves(p.j) ? bodies_[p.j].collisions : 0);
}

/// When the two meet, after both of their local times; infinity if not within the step. Partners that overlap meet at
/// once if they approach. Where they part, gravity can bring them together again with no more than what it gives in a
/// step, which is a contact that rests: the next step finds it.
template <int D>
double Step<D>::contact(const Partners& p) const {
  const auto& a = bodies_[p.i];
  if (is_wall(p.j)) {
    const double t = hard::first_contact_with_wall(flight(p.i), wall_of(p.j), setup_.domain, end_);
    return t == never ? never : std::max(t - begin_, a.time);
  }
  const auto& b = bodies_[p.j];
  const double from = std::max(a.time, b.time), left = length_ - from;  // of a fixed grain it stays 0
  const Relative now = relative(p, from);
  const double reach = a.radius + b.radius, closing = dot(now.way, now.velocity);
  if (p.presses) return unsettled(p, closing) ? from : never;
  const double gap = dot(now.way, now.way) - reach * reach;
  if (gap <= 0) return closing < -negligible_ * reach ? from : never;
  // Nearly all looks end here: the square of the distance falls within a time T by at most 2 T |d·v| + T² |d·a|, the
  // first only if they approach.
  if (moves(p.j)) {
    if (closing >= 0 || gap + 2 * left * closing > closed * reach * reach) return never;
    const double s = from + hard::first_contact(hard::Approach<D>{now.way, now.velocity, {}, reach});
    return s <= length_ ? s : never;
  }
  const double pull = -dot(now.way, gravity_);
  if (gap + 2 * left * std::min(closing, 0.0) + left * left * std::min(pull, 0.0) > closed * reach * reach)
    return never;
  const double s = from + hard::first_contact(hard::Approach<D>{now.way, now.velocity, -1 * gravity_, reach});
  return s <= length_ ? s : never;
}

/// Whether two that rest on each other still approach, or part though they press.
template <int D>
bool Step<D>::unsettled(const Partners& p, double closing) const {
  const double off = settled * given_ * (bodies_[p.i].radius + bodies_[p.j].radius);
  return closing < -off || (closing > off && p.pressed > 0);
}

template <int D>
bool Step<D>::spent(const Partners& p) const {
  return p.collisions >= setup_.collisions_per_pair || bodies_[p.i].collisions >= collisions_per_grain ||
         (moves(p.j) && bodies_[p.j].collisions >= collisions_per_grain);
}

/// Who of those to look at meets within the step, in order of time; of several at once those with lower ids first:
/// partners are numbered so.
template <int D>
void Step<D>::find_events(Team& team) {
  times_.resize(to_check_.size());
  Team& members = to_check_.size() < looks_worth_sharing ? Team::alone() : team;
  members.split(to_check_.size(), [&](Part range, std::size_t) {
    for (auto k = range.begin; k < range.end; ++k) times_[k] = contact(partners_[to_check_[k]]);
  });
  events_.clear();
  for (std::size_t k = 0; k < to_check_.size(); ++k)
    if (times_[k] < never) events_.push_back({times_[k], to_check_[k], version(partners_[to_check_[k]])});
  std::sort(events_.begin(), events_.end(), [](const Event& a, const Event& b) {
    return a.time != b.time ? a.time < b.time : a.partners < b.partners;
  });
}

/// Lets everybody who meets collide, each pair once. Whoever has collided since the look is looked at again.
template <int D>
void Step<D>::do_events() {
  for (const auto& event : events_) {
    Partners& p = partners_[event.partners];
    meet(p, event.version == version(p) ? event.time : contact(p));
  }
}

/// Looks again at all partners of those who have moved since their last turn, and lets who meets collide at once: a pair
/// later in the sweep sees what those before it did. False if nobody had moved.
template <int D>
bool Step<D>::sweep() {
  if (movers_.empty()) return false;
  std::swap(moved_, moved_before_);
  std::swap(movers_, movers_before_);
  movers_.clear();
  // Where many have moved, looking through all is faster than sorting.
  if (4 * movers_before_.size() > grains_.moving) {
    for (auto& p : partners_)
      if (moved_before_[p.i] | moved_before_[p.j]) look_again(p);
  } else {
    list_to_check();
    for (const auto k : to_check_) look_again(partners_[k]);
  }
  for (const auto i : movers_before_) moved_before_[i] = 0;
  return true;
}

template <int D>
void Step<D>::look_again(Partners& p) {
  if (!p.presses) return meet(p, contact(p));
  const double s = std::max(bodies_[p.i].time, bodies_[p.j].time);
  const Relative now = relative(p, s);
  const double closing = dot(now.way, now.velocity);
  if (!unsettled(p, closing)) return;
  if (spent(p)) {
    ++outcome_.put_off;
    return;
  }
  const double distance = norm(now.way);
  if (-closing < resting * given_ * distance)
    press(p, s, now, distance);
  else if (!collide(p, s))
    return;
  note_moved(p);
}

/// Lets two collide if they do meet and the bounds allow it.
template <int D>
void Step<D>::meet(Partners& p, double s) {
  if (s == never) return;
  if (spent(p)) {
    ++outcome_.put_off;
    return;
  }
  if (collide(p, s)) note_moved(p);
}

template <int D>
void Step<D>::note_moved(const Partners& p) {
  for (const auto g : {p.i, p.j})
    if (moves(g) && !moved_[g]) moved_[g] = 1, movers_.push_back(g);
}

/// All partners of those who have moved, each once.
template <int D>
void Step<D>::list_to_check() {
  to_check_.clear();
  for (const auto i : movers_before_)
    for (auto k = first_[i]; k < first_[i + 1]; ++k) {
      const auto& p = partners_[of_[k]];
      const auto other = p.i == i ? p.j : p.i;
      if (i < other || !moved_before_[other]) to_check_.push_back(of_[k]);
    }
  std::sort(to_check_.begin(), to_check_.end());
}

template <int D>
const typename Step<D>::Outcome& Step<D>::collide(std::vector<hard::Flight<D>>& flights,
                                                  const search::PairNames& pairs, double end, Team& team) {
  flights_ = &flights;
  outcome_.hits.clear();
  outcome_.collisions = outcome_.put_off = 0;
  outcome_.normal_loss = outcome_.shear_loss = outcome_.wall_work = 0;
  end_ = end, length_ = setup_.time_step, begin_ = end - length_;
  gravity_ = grains_.moving > 0 ? flights[0].gravity : Vec<D>{};
  given_ = norm(setup_.gravity) * length_, negligible_ = rounding * given_;
  take_off();
  list_partners(pairs);
  moved_.assign(grains_.size() + setup_.walls.size(), 0);
  moved_before_.assign(moved_.size(), 0);
  movers_.clear();
  lean();
  to_check_.resize(partners_.size());
  std::iota(to_check_.begin(), to_check_.end(), 0);
  find_events(team);
  do_events();
  while (sweep()) {
  }
  remember();
  arrive();
  outcome_.order.resize(outcome_.hits.size());
  std::iota(outcome_.order.begin(), outcome_.order.end(), 0);
  std::sort(outcome_.order.begin(), outcome_.order.end(), [this](std::uint32_t m, std::uint32_t n) {
    const auto &a = outcome_.hits[m], &b = outcome_.hits[n];
    return std::tie(a.first, a.i, a.j) < std::tie(b.first, b.i, b.j);
  });
  return outcome_;
}

/// Those who rested on each other in the step before, and still touch, begin with the impulses of that.
template <int D>
void Step<D>::lean() {
  std::size_t at = 0;
  for (auto& p : partners_) {
    if (is_wall(p.j)) return;  // they come last
    const auto earlier = [&](const Pressing<D>& q) { return q.i < p.i || (q.i == p.i && q.j < p.j); };
    while (at < pressings_.size() && earlier(pressings_[at])) ++at;
    if (at == pressings_.size()) return;
    const auto& last = pressings_[at];
    if (last.i != p.i || last.j != p.j) continue;
    const Relative before = relative(p, 0);
    const double distance = norm(before.way);
    if (distance > bodies_[p.i].radius + bodies_[p.j].radius) continue;
    auto [i, j] = colliders(p, before);
    const Vec<D> n = (1 / distance) * before.way;
    press_to(p, 0, before, {n, laws::surface_slip(n, i, j), dot(before.velocity, n)}, last.normal,
             last.shear - dot(last.shear, n) * n, i, j);
  }
}

template <int D>
void Step<D>::remember() {
  pressings_.clear();
  for (const auto& p : partners_)
    if (p.presses && p.pressed > 0) pressings_.push_back({p.i, p.j, p.pressed, p.sheared});
}

/// Lets two collide now; false if they only touch.
template <int D>
bool Step<D>::collide(Partners& p, double s) {
  auto& a = bodies_[p.i];
  laws::Collider<D> i{a.velocity + s * gravity_, a.spin, a.radius, a.inverse_mass, a.inverse_inertia}, j;
  Relative before;
  const auto& usual = hard::contact_between(setup_, grains_, p.i, p.j);
  laws::Walton law = usual.tangential;
  const laws::Restitution* restitution = &usual.restitution;
  laws::Restitution own;
  if (is_wall(p.j)) {
    const auto contact = usual.with(wall_of(p.j).surface);
    law = contact.tangential, own = contact.restitution, restitution = &own;
    const Vec<D> place = a.place + s * (a.velocity + (0.5 * s) * gravity_);
    const auto touch = wall_of(p.j).nearest(place, begin_ + s, setup_.domain);
    before.way = -touch.height * touch.normal;
    j = hard::collider_of(wall_of(p.j), touch, begin_ + s);
    before.velocity = j.velocity - i.velocity;
  } else {
    const auto& b = bodies_[p.j];
    before = relative(p, s);
    j = {i.velocity + before.velocity, b.spin, b.radius, b.inverse_mass, b.inverse_inertia};
  }
  const Vec<D> n = (1 / norm(before.way)) * before.way, surface = j.velocity;
  const double v_n = dot(before.velocity, n);
  const bool rests = -v_n < resting * given_;
  if (rests && !is_wall(p.j) && (p.presses || v_n < -negligible_))
    return press(p, s, before, norm(before.way)), true;
  if (!(v_n < -negligible_)) return false;
  p.presses = false;
  if (rests) law.beta = 0;
  const auto done = law(n, rests ? 0 : laws::restitution_at(*restitution, v_n), i, j);
  outcome_.normal_loss += done.normal_loss, outcome_.shear_loss += done.shear_loss;
  if (is_wall(p.j)) outcome_.wall_work -= dot(done.impulse, surface);
  ++outcome_.collisions;
  pass(p, s, before, done.impulse, i.spin, j.spin);
  return true;
}

/// Two grains as a law of collisions sees them, from the first: it acts on how they move against each other alone.
template <int D>
std::pair<laws::Collider<D>, laws::Collider<D>> Step<D>::colliders(const Partners& p,
                                                                   const Relative& before) const {
  const auto &a = bodies_[p.i], &b = bodies_[p.j];
  return {{{}, a.spin, a.radius, a.inverse_mass, a.inverse_inertia},
          {before.velocity, b.spin, b.radius, b.inverse_mass, b.inverse_inertia}};
}

/// One turn of two that rest on each other: what takes away their approach and their slip, as far as the sum of all turns
/// of the step may.
template <int D>
void Step<D>::press(Partners& p, double s, const Relative& before, double distance) {
  auto [i, j] = colliders(p, before);
  if (p.normal_mass == 0)
    p.normal_mass = 1 / (i.inverse_mass + j.inverse_mass), p.shear_mass = laws::slip_mass(i, j),
    p.friction = hard::contact_between(setup_, grains_, p.i, p.j).tangential.friction;
  const Vec<D> n = (1 / distance) * before.way;
  const double v_n = dot(before.velocity, n);
  const Vec<D> slip = laws::surface_slip(n, i, j);
  const double pressed = std::max(0.0, p.pressed - over_relaxation * p.normal_mass * v_n);
  Vec<D> sheared = p.sheared - p.shear_mass * slip;
  const double shear2 = dot(sheared, sheared), most = p.friction * pressed;
  if (shear2 > most * most) sheared = (most / std::sqrt(shear2)) * sheared;
  ++outcome_.collisions;
  press_to(p, s, before, {n, slip, v_n}, pressed, sheared, i, j);
}

/// Makes the impulses of the step these in all.
template <int D>
void Step<D>::press_to(Partners& p, double s, const Relative& before, const Touch& touch, double pressed,
                       const Vec<D>& sheared, laws::Collider<D>& i, laws::Collider<D>& j) {
  p.presses = true;
  const auto& [n, slip, v_n] = touch;
  const Vec<D> sideways = sheared - p.sheared, impulse = (pressed - p.pressed) * n + sideways;
  laws::apply_impulse(n, impulse, i, j);
  const double mean_v_n = 0.5 * (v_n + dot(j.velocity - i.velocity, n));
  outcome_.normal_loss -= (pressed - p.pressed) * mean_v_n;
  outcome_.shear_loss -= dot(sideways, mean_v_n * n + 0.5 * (slip + laws::surface_slip(n, i, j)));
  p.pressed = pressed, p.sheared = sheared;
  pass(p, s, before, impulse, i.spin, j.spin);
}

/// Hands on an impulse: the flights go on with other velocities.
template <int D>
void Step<D>::pass(Partners& p, double s, const Relative& before, const Vec<D>& impulse,
                   const Vec<turns<D>>& spin_i, const Vec<turns<D>>& spin_j) {
  note(p, s, before, impulse);
  const auto go_on = [&](std::size_t k, const Vec<D>& gets, const Vec<turns<D>>& spin)
      __attribute__((always_inline)) {
    auto& body = bodies_[k];
    auto& f = (*flights_)[k];
    if (s > body.time) f.orientation = turned<D>(f.orientation, body.spin, s - body.time);
    const Vec<D> gained = body.inverse_mass * gets;
    body.place = body.place - s * gained, body.velocity = body.velocity + gained;
    body.spin = spin, body.time = s;
    ++body.collisions;
  };
  go_on(p.i, -1 * impulse, spin_i);
  if (moves(p.j)) go_on(p.j, impulse, spin_j);
  ++p.collisions;
}

template <int D>
void Step<D>::note(Partners& p, double s, const Relative& before, const Vec<D>& impulse) {
  if (p.collisions == 0) {
    const auto& a = bodies_[p.i];
    const Vec<D> place = a.place + s * (a.velocity + (0.5 * s) * gravity_);
    p.hit = static_cast<std::uint32_t>(outcome_.hits.size());
    outcome_.hits.push_back({begin_ + s, begin_ + s, p.i, p.j, place, before.way, before.velocity, impulse});
    return;
  }
  auto& hit = outcome_.hits[p.hit];
  hit.last = begin_ + s;
  hit.further = hit.further + impulse;
  ++hit.collisions;
}

template class Step<2>;
template class Step<3>;

}  // namespace chute::hybrid
