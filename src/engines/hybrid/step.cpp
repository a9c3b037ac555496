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
constexpr std::uint32_t nobody = std::numeric_limits<std::uint32_t>::max();

/// Fewer islands than this are done sooner by one thread than the others are woken, each taking about a microsecond.
constexpr std::size_t islands_worth_sharing = 64;

/// An approach slower than this part of what gravity gives in a step is rounding: the grains touch and do not collide.
constexpr double rounding = 1e-9;

}  // namespace

/// The pairs, and the grains with each wall that they can reach, by grain.
template <int D>
void Step<D>::list_partners(const search::PairNames& pairs, double begin) {
  partners_.clear();
  for (std::size_t p = 0; p < pairs.size(); ++p)
    partners_.push_back({static_cast<std::uint32_t>(pairs.i[p]), static_cast<std::uint32_t>(pairs.j[p])});
  const double dt = end_ - begin, fall = 0.5 * norm(setup_.gravity) * dt * dt;
  for (std::size_t w = 0; w < setup_.walls.size(); ++w) {
    const auto& wall = setup_.walls[w];
    for (std::size_t i = 0; i < grains_.moving; ++i) {
      const auto& f = flight(i);
      // Twice the way: a collision may throw it on, and at most a resting pile presses it anew.
      const double reach = f.radius + 2 * ((norm(f.velocity) + wall.top_speed()) * dt + fall) +
                           farthest_move * setup_.diameter;
      if (wall.nearest(f.place, begin, setup_.domain).height < reach)
        partners_.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(grains_.size() + w)});
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

template <int D>
std::int64_t Step<D>::version(const Partners& p) {
  return flight(p.i).collisions + (moves(p.j) ? flight(p.j).collisions : 0);
}

/// Nearly all looks end here: the square of the distance falls within a time T by at most 2 T |d·v| + T² |d·a|, the
/// first only if they approach. Of two that do not approach and feel no gravity between them nothing falls.
template <int D>
static bool cannot_meet(const hard::Approach<D>& approach, double time) {
  const double closing = dot(approach.d, approach.v), pull = dot(approach.d, approach.a);
  if (closing >= 0 && pull >= 0) return dot(approach.a, approach.a) == 0 || approach.gap(0) > 0;
  const double least =
      approach.gap(0) + 2 * time * std::min(closing, 0.0) + time * time * std::min(pull, 0.0);
  return least > 1e-12 * approach.reach * approach.reach;
}

/// When the two meet, after both of their local times; infinity if not within the step.
template <int D>
double Step<D>::contact(const Partners& p) {
  const auto& a = flight(p.i);
  if (is_wall(p.j))
    return hard::first_contact_with_wall(a, setup_.walls[p.j - grains_.size()], setup_.domain, end_);
  const auto& b = flight(p.j);
  const double from = moves(p.j) ? std::max(a.time, b.time) : a.time;
  hard::Approach<D> approach;
  const Vec<D> place_a = a.place_at(from), place_b = moves(p.j) ? b.place_at(from) : b.place;
  approach.d = setup_.domain.way(place_b, place_a);
  approach.v = a.velocity_at(from);
  if (moves(p.j)) approach.v = approach.v - b.velocity_at(from);
  approach.a = moves(p.j) ? Vec<D>{} : a.gravity;
  approach.reach = a.radius + b.radius;
  if (cannot_meet(approach, end_ - from)) return never;
  const double t = from + hard::first_contact(approach);
  return t <= end_ ? t : never;
}

template <int D>
std::uint32_t Step<D>::root(std::uint32_t i) {
  while (root_[i] != i) i = root_[i] = root_[root_[i]];
  return i;
}

/// Finds who of these partners meet within the step, and puts them into islands. Returns how many islands there are.
template <int D>
std::size_t Step<D>::gather(const std::vector<std::uint32_t>& to_check) {
  std::vector<Event> events;
  std::iota(root_.begin(), root_.end(), 0);
  for (const auto p : to_check) {
    const auto& partners = partners_[p];
    const double t = contact(partners);
    if (t == never) continue;
    events.push_back({t, p, version(partners)});
    if (moves(partners.j)) {
      const auto a = root(partners.i), b = root(partners.j);
      root_[std::max(a, b)] = std::min(a, b);
    }
  }
  std::vector<std::uint32_t> number(root_.size(), nobody);
  std::size_t count = 0;
  for (const auto& event : events) {
    auto& island = number[root(partners_[event.partners].i)];
    if (island == nobody) {
      island = static_cast<std::uint32_t>(count++);
      if (islands_.size() < count) islands_.emplace_back();
      islands_[island].events.clear(), islands_[island].hits.clear(), islands_[island].put_off = 0;
    }
    islands_[island].events.push_back(event);
  }
  // From here on a grain's root is its island; who is in none has nobody.
  for (std::uint32_t i = 0; i < root_.size(); ++i) number[i] = number[root(i)];
  root_ = number;
  return count;
}

template <int D>
const typename Step<D>::Outcome& Step<D>::collide(std::vector<hard::Flight<D>>& flights,
                                                  const search::PairNames& pairs, double end, Team& team) {
  flights_ = &flights;
  outcome_.hits.clear();
  outcome_.put_off = 0;
  end_ = end;
  list_partners(pairs, end - setup_.time_step);
  root_.resize(grains_.moving);
  grain_collisions_.assign(grains_.moving, 0);
  done_.assign(partners_.size(), 0);
  std::vector<std::uint32_t> to_check(partners_.size());
  std::iota(to_check.begin(), to_check.end(), 0);
  for (std::size_t count; (count = gather(to_check)) > 0;) {
    moved_.assign(grains_.moving, 0);
    Team& members = count < islands_worth_sharing ? Team::alone() : team;
    members.run([&](std::size_t member) {
      for (std::size_t k = member; k < count; k += members.size()) collide(islands_[k]);
    });
    to_check.clear();
    std::vector<std::uint32_t> moved;
    for (std::size_t k = 0; k < count; ++k) {
      outcome_.put_off += islands_[k].put_off;
      for (const auto& hit : islands_[k].hits) {
        outcome_.hits.push_back(hit);
        for (const auto g : {hit.i, hit.j})
          if (moves(g) && !moved_[g]) moved_[g] = 1, moved.push_back(static_cast<std::uint32_t>(g));
      }
    }
    // Within an island all is looked at; what remains are moved grains with those outside.
    for (const auto i : moved)
      for (auto p = first_[i]; p < first_[i + 1]; ++p) {
        const auto& partners = partners_[of_[p]];
        if (moves(partners.j) && root_[partners.i] != root_[partners.j]) to_check.push_back(of_[p]);
      }
    std::sort(to_check.begin(), to_check.end());
    to_check.erase(std::unique(to_check.begin(), to_check.end()), to_check.end());
    std::erase_if(to_check, [&](std::uint32_t p) {
      const auto& partners = partners_[p];
      const auto spent = [&](std::uint32_t g) {
        return moves(g) && grain_collisions_[g] >= collisions_per_grain;
      };
      return partners.collisions >= setup_.collisions_per_pair || spent(partners.i) || spent(partners.j);
    });
  }
  std::sort(outcome_.hits.begin(), outcome_.hits.end(), [](const Hit<D>& a, const Hit<D>& b) {
    return std::tie(a.time, a.i, a.j) < std::tie(b.time, b.i, b.j);
  });
  return outcome_;
}

namespace {

/// The earliest event comes out of the heap first, of several the one with the lower ids: partners are numbered so.
constexpr auto later = [](const auto& a, const auto& b) {
  return std::tie(a.time, a.partners) > std::tie(b.time, b.partners);
};

}  // namespace

template <int D>
void Step<D>::push(Island& island, std::uint32_t p) {
  const double t = contact(partners_[p]);
  if (t == never) return;
  island.events.push_back({t, p, version(partners_[p])});
  std::push_heap(island.events.begin(), island.events.end(), later);
}

template <int D>
void Step<D>::collide(Island& island) {
  std::make_heap(island.events.begin(), island.events.end(), later);
  while (!island.events.empty()) {
    std::pop_heap(island.events.begin(), island.events.end(), later);
    const Event event = island.events.back();
    island.events.pop_back();
    Partners& p = partners_[event.partners];
    if (event.version != version(p)) continue;
    const auto spent = [&](std::uint32_t g) {
      return moves(g) && grain_collisions_[g] >= collisions_per_grain;
    };
    if (p.collisions >= setup_.collisions_per_pair || spent(p.i) || spent(p.j)) {
      ++island.put_off;
      continue;
    }
    if (!collide(island, p, event.time)) continue;
    const auto own = root_[p.i];
    const auto look = [&](std::uint32_t i, std::uint32_t but) {
      for (auto k = first_[i]; k < first_[i + 1]; ++k) {
        const auto& near = partners_[of_[k]];
        const auto other = near.i == i ? near.j : near.i;
        if (other != but && (!moves(other) || root_[other] == own)) push(island, of_[k]);
      }
    };
    push(island, event.partners);
    look(p.i, p.j);
    if (moves(p.j)) look(p.j, p.i);
  }
}

/// Lets two collide now; false if they only touch.
template <int D>
bool Step<D>::collide(Island& island, Partners& p, double time) {
  auto& a = flight(p.i);
  Hit<D> hit{time, p.i, p.j, a.place_at(time), {}, {}, {}, 0};
  laws::Collider<D> i{a.velocity_at(time), a.spin, a.radius, grains_.inverse_mass[p.i],
                      grains_.inverse_inertia[p.i]},
      j;
  auto contact = setup_.contact;
  if (is_wall(p.j)) {
    const auto& wall = setup_.walls[p.j - grains_.size()];
    const auto touch = wall.nearest(hit.place, time, setup_.domain);
    contact = contact.with(wall.surface);
    hit.way = -touch.height * touch.normal;
    j = hard::collider_of(wall, touch, time);
  } else {
    const auto& b = flight(p.j);
    hit.way = setup_.domain.way(hit.place, moves(p.j) ? b.place_at(time) : b.place);
    j = {moves(p.j) ? b.velocity_at(time) : Vec<D>{}, b.spin, b.radius, grains_.inverse_mass[p.j],
         grains_.inverse_inertia[p.j]};
  }
  const Vec<D> n = (1 / norm(hit.way)) * hit.way, surface = j.velocity;
  hit.velocity = j.velocity - i.velocity;
  const double v_n = dot(hit.velocity, n), given = norm(setup_.gravity) * setup_.time_step;
  if (!(v_n < -rounding * given)) return false;
  const bool rests = -v_n < resting * given;
  const laws::Walton law = rests ? laws::Walton{contact.tangential.friction, 0} : contact.tangential;
  hit.done = law(n, rests ? 0 : laws::restitution_at(contact.restitution, v_n), i, j);
  if (is_wall(p.j)) hit.wall_work = -dot(hit.done.impulse, surface);
  const auto go_on = [&](std::size_t k, const laws::Collider<D>& after) {
    auto& f = flight(k);
    f.place = f.place_at(time), f.orientation = f.orientation_at(time), f.time = time;
    f.velocity = after.velocity, f.spin = after.spin;
    ++f.collisions, ++grain_collisions_[k];
  };
  go_on(p.i, i);
  if (moves(p.j)) go_on(p.j, j);
  ++p.collisions;
  island.hits.push_back(hit);
  return true;
}

template class Step<2>;
template class Step<3>;

}  // namespace chute::hybrid
