#include "engines/contact/impacts.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace chute::contact {

template <int D>
Vec<D> WaltonImpacts<D>::place(std::size_t i, double after) const {
  if (!moves(i)) return grains_.place(i);
  const double since_middle = after - setup_.time_step / 2;
  return bodies_->middle[i] + since_middle * bodies_->velocity[i] + (0.5 * after * after) * begin_.gravity;
}
template <int D>
Vec<D> WaltonImpacts<D>::velocity(std::size_t i, double after) const {
  return moves(i) ? bodies_->velocity[i] + after * begin_.gravity : Vec<D>{};
}

template <int D>
typename WaltonImpacts<D>::Standing WaltonImpacts<D>::standing(const Touching<D>& t, double after) const {
  const Vec<D> own = place(t.i, after), speed = velocity(t.i, after);
  if (is_wall(t.j)) {
    const auto touch = wall_of(t.j).nearest(own, begin_.time + after, setup_.domain);
    return {touch.normal, touch.height - grains_.radius[t.i],
            dot(speed - wall_of(t.j).drift(begin_.time + after), touch.normal)};
  }
  const Vec<D> way = setup_.domain.way(place(t.j, after), own);
  const double distance = norm(way);
  const Vec<D> n = (1 / distance) * way;
  return {n, distance - grains_.radius[t.i] - grains_.radius[t.j], dot(speed - velocity(t.j, after), n)};
}

template <int D>
bool WaltonImpacts<D>::approaches(const Touching<D>& t) const {
  const auto now = standing(t, setup_.time_step / 2);
  return now.gap <= 0 && -now.rate > setup_.impact_velocity;
}

/// When they touched, after the step's begin: Newton's method backwards from the overlap in the middle. What overlapped
/// half a step before already, when it was no impact yet, collides there.
template <int D>
double WaltonImpacts<D>::touch_time(const Touching<D>& t) const {
  constexpr int most = 8;
  const double latest = setup_.time_step / 2, earliest = -setup_.time_step / 2;
  double after = latest;
  for (int k = 0; k < most; ++k) {
    const auto now = standing(t, after);
    if (!(now.rate < 0)) break;
    const double next = std::clamp(after - now.gap / now.rate, earliest, latest);
    if (next == after) break;
    after = next;
  }
  return after;
}

template <int D>
void WaltonImpacts<D>::collide(Bodies<D>& bodies, std::vector<Touching<D>>& touching, const Begin& begin,
                               EnergyAccount& account, std::vector<Struck<D>>& struck) {
  bodies_ = &bodies, begin_ = begin;
  const auto was_struck = [&](std::size_t g, int in) { return moves(g) && struck_round_[g] == in; };
  for (int round = 0; round < most_rounds; ++round) {
    events_.clear();
    for (std::size_t k = 0; k < touching.size(); ++k) {
      const auto& t = touching[k];
      const bool changed = round == 0 || was_struck(t.i, round - 1) || was_struck(t.j, round - 1);
      if (changed && approaches(t)) events_.push_back({touch_time(t), k});
    }
    if (events_.empty()) break;
    std::sort(events_.begin(), events_.end(), [](const Event& a, const Event& b) {
      return std::tie(a.after, a.touching) < std::tie(b.after, b.touching);
    });
    // Who is passed over because its partner was hit in this round is looked at in the next: the partner has changed.
    for (const auto& event : events_) {
      auto& t = touching[event.touching];
      if (was_struck(t.i, round) || was_struck(t.j, round)) continue;
      struck.push_back(collide(t, event, account));
      for (const std::size_t g : {t.i, t.j})
        if (moves(g)) struck_round_[g] = round;
    }
  }
  if (!struck.empty()) std::fill(struck_round_.begin(), struck_round_.end(), -1);
}

template <int D>
Struck<D> WaltonImpacts<D>::collide(Touching<D>& t, const Event& event, EnergyAccount& account) {
  const double after = event.after;
  auto contact = hard::contact_between(setup_, grains_, t.i, t.j);
  const auto now = standing(t, after);
  const Vec<D> n = -1.0 * now.normal;  // Walton's: from i to j
  laws::Collider<D> i{velocity(t.i, after), bodies_->spin[t.i], grains_.radius[t.i],
                      grains_.inverse_mass[t.i], grains_.inverse_inertia[t.i]},
      j;
  if (is_wall(t.j)) {
    const auto& wall = wall_of(t.j);
    contact = contact.with(wall.surface);
    j = hard::collider_of(wall, wall.nearest(place(t.i, after), begin_.time + after, setup_.domain),
                          begin_.time + after);
  } else {
    j = {velocity(t.j, after), moves(t.j) ? bodies_->spin[t.j] : Vec<turns<D>>{}, grains_.radius[t.j],
         grains_.inverse_mass[t.j], grains_.inverse_inertia[t.j]};
  }
  const Vec<D> before = i.velocity - j.velocity, surface = j.velocity;
  const auto done =
      contact.tangential(n, laws::restitution_at(contact.restitution, dot(before, now.normal)), i, j);
  account.normal_loss += done.normal_loss;
  account.shear_loss += done.shear_loss;
  if (is_wall(t.j)) account.wall_work -= dot(done.impulse, surface);
  t.hit = t.hit - done.impulse;
  t.normal = now.normal;
  t.state = done.sliding ? ContactState::slide : ContactState::stick;
  t.friction = contact.tangential.friction;
  const auto go_on = [&](std::size_t k, const laws::Collider<D>& then) {
    const Vec<D> was = bodies_->velocity[k], is = then.velocity - after * begin_.gravity;
    bodies_->middle[k] = bodies_->middle[k] + (setup_.time_step / 2 - after) * (is - was);
    bodies_->velocity[k] = is;
    bodies_->spin[k] = then.spin;
  };
  go_on(t.i, i);
  if (moves(t.j)) go_on(t.j, j);
  return {begin_.time + after, event.touching, before};
}

template class WaltonImpacts<2>;
template class WaltonImpacts<3>;

}  // namespace chute::contact
