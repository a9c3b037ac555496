#include "engines/dsmc/obstacles.hpp"

#include <algorithm>
#include <cmath>

#include "engines/hard/first_contact.hpp"
#include "engines/hard/thermal_wall.hpp"
#include "engines/hard/wall_flight.hpp"

namespace chute::dsmc {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// Hits of one grain in one step; a grain that comes to rest on something would hit it without end.
constexpr int most_hits = 64;

}  // namespace

template <int D>
Obstacles<D>::Obstacles(const Grains<D>& grains, const DsmcSetup<D>& setup) : setup_(setup), grains_(grains) {
  for (std::size_t i = grains.moving; i < grains.size(); ++i) {
    beads_.push_back({grains.place(i), grains.radius[i], i});
    widest_ = std::max(widest_, grains.radius[i]);
  }
  if (beads_.empty()) return;
  const auto largest = *std::max_element(grains.radius.begin(),
                                         grains.radius.begin() + static_cast<std::ptrdiff_t>(grains.moving));
  bin_ = 2 * (widest_ + largest);
  top_ = -never;
  std::size_t all = 1;
  for (int k = 0; k + 1 < D; ++k) {
    double low = beads_[0].place[k], high = low;
    for (const auto& bead : beads_) low = std::min(low, bead.place[k]), high = std::max(high, bead.place[k]);
    const bool periodic = setup.domain.periodic(k);
    low_[k] = periodic ? setup.domain.lower[k] : low;
    const double size = periodic ? setup.domain.length[k] : high - low;
    bins_[static_cast<std::size_t>(k)] = std::max(1, static_cast<int>(size / bin_) + (periodic ? 0 : 1));
    all *= static_cast<std::size_t>(bins_[static_cast<std::size_t>(k)]);
  }
  in_bin_.resize(all);
  for (std::size_t b = 0; b < beads_.size(); ++b) {
    top_ = std::max(top_, beads_[b].place[D - 1]);
    near_beads(beads_[b].place, 0,
               [&](std::size_t bin) { in_bin_[bin].push_back(static_cast<std::uint32_t>(b)); });
  }
}

/// Visits the bins that lie within `reach` of a place along (and across) the bed, each once.
template <int D>
template <class Visit>
void Obstacles<D>::near_beads(const Vec<D>& place, double reach, const Visit& visit) const {
  std::array<int, D - 1> from{}, many{};
  for (int k = 0; k + 1 < D; ++k) {
    const auto a = static_cast<std::size_t>(k);
    const int n = bins_[a];
    const bool periodic = setup_.domain.periodic(k);
    const double side = periodic ? setup_.domain.length[k] / n : bin_;
    int first = static_cast<int>(std::floor((place[k] - reach - low_[k]) / side)),
        last = static_cast<int>(std::floor((place[k] + reach - low_[k]) / side));
    if (!periodic) first = std::clamp(first, 0, n - 1), last = std::clamp(last, 0, n - 1);
    from[a] = first, many[a] = std::min(last - first + 1, n);
  }
  const auto wrapped = [&](std::size_t a, int at) {
    return ((from[a] + at) % bins_[a] + bins_[a]) % bins_[a];
  };
  for (int x = 0; x < many[0]; ++x) {
    if constexpr (D == 2) {
      visit(static_cast<std::size_t>(wrapped(0, x)));
    } else {
      for (int y = 0; y < many[1]; ++y)
        visit(static_cast<std::size_t>(wrapped(0, x) * bins_[1] + wrapped(1, y)));
    }
  }
}

template <int D>
typename Obstacles<D>::Hit Obstacles<D>::first_hit(const hard::Flight<D>& flight, double end) const {
  Hit first{never};
  const double dt = end - flight.time;
  const double way = norm(flight.velocity) * dt + 0.5 * norm(flight.gravity) * dt * dt;
  for (std::size_t w = 0; w < setup_.walls.size(); ++w) {
    const auto& wall = setup_.walls[w];
    const auto touch = wall.nearest(flight.place, flight.time, setup_.domain);
    if (touch.height - way - wall.top_speed() * dt > flight.radius) continue;
    const double t = hard::first_contact_with_wall(flight, wall, setup_.domain, std::min(end, first.time));
    if (t < first.time && t <= end) first = {t, nullptr, w};
  }
  if (beads_.empty() || flight.place[D - 1] - way > top_ + widest_ + flight.radius) return first;
  near_beads(flight.place, way + widest_ + flight.radius, [&](std::size_t bin) {
    for (const auto b : in_bin_[bin]) {
      const auto& bead = beads_[b];
      const hard::Approach<D> approach{setup_.domain.way(bead.place, flight.place), flight.velocity,
                                       flight.gravity, flight.radius + bead.radius};
      if (flight.time + approach.earliest() >= std::min(end, first.time)) continue;
      const double t = flight.time + hard::first_contact(approach);
      if (t < first.time && t <= end) first = {t, &bead, 0};
    }
  });
  return first;
}

template <int D>
void Obstacles<D>::bounce(std::size_t i, hard::Flight<D>& flight, const Hit& hit, Random& random,
                          Tally& tally, std::vector<Impact>* impacts) const {
  const double mass = grains_.mass[i];
  laws::Collider<D> grain{flight.velocity, flight.spin, flight.radius, grains_.inverse_mass[i],
                          grains_.inverse_inertia[i]};
  laws::Collider<D> other;
  Vec<D> n;  // from the obstacle to the grain
  if (hit.bead) {
    n = setup_.domain.way(hit.bead->place, flight.place);
    n = (1 / norm(n)) * n;
    other.radius = hit.bead->radius;
  } else {
    const auto& wall = setup_.walls[hit.wall];
    const auto touch = wall.nearest(flight.place, hit.time, setup_.domain);
    n = touch.normal;
    other = hard::collider_of(wall, touch, hit.time);
  }
  if (impacts) {
    auto impact = impact_at(hit.time, n, flight.velocity - other.velocity, flight.place - flight.radius * n);
    impact.grain = static_cast<std::int64_t>(i);
    impact.bead = hit.bead ? static_cast<std::int64_t>(hit.bead->id) : wall_id(hit.wall);
    impacts->push_back(impact);
  }
  const double before = 0.5 * mass * dot(flight.velocity, flight.velocity);
  const auto& own = hit.bead ? WallSurface{} : setup_.walls[hit.wall].surface;
  if (own.temperature) {
    flight.velocity = other.velocity + hard::thermal_velocity(n, *own.temperature, mass, random);
    tally.wall_work += 0.5 * mass * dot(flight.velocity, flight.velocity) - before;
    return;
  }
  const auto contact = hit.bead ? setup_.contact : setup_.contact.with(own);
  const Vec<D> moved = other.velocity;
  const auto done = contact.tangential(-1 * n, contact.restitution, grain, other);
  tally.normal_loss += done.normal_loss, tally.shear_loss += done.shear_loss;
  tally.wall_work -= dot(done.impulse, moved);
  flight.velocity = grain.velocity, flight.spin = grain.spin;
}

template <int D>
bool Obstacles<D>::fly(std::size_t i, hard::Flight<D>& flight, double end, Random& random, Tally& tally,
                       std::vector<Impact>* impacts) const {
  for (int hits = 0; hits < most_hits; ++hits) {
    const auto hit = first_hit(flight, end);
    if (hit.time == never) {
      flight.move_to(end, setup_.domain);
      return true;
    }
    flight.move_to(hit.time, setup_.domain);
    bounce(i, flight, hit, random, tally, impacts);
  }
  return false;
}

template <int D>
bool Obstacles<D>::free(const Vec<D>& place, double radius) const {
  constexpr double rounding = 1e-9;
  for (const auto& wall : setup_.walls)
    if (wall.nearest(place, 0, setup_.domain).height < radius * (1 - rounding)) return false;
  bool clear = true;
  if (!beads_.empty())
    near_beads(place, widest_ + radius, [&](std::size_t bin) {
      for (const auto b : in_bin_[bin]) {
        const Vec<D> way = setup_.domain.way(beads_[b].place, place);
        const double reach = (radius + beads_[b].radius) * (1 - rounding);
        clear = clear && dot(way, way) >= reach * reach;
      }
    });
  return clear;
}

template <int D>
bool Obstacles<D>::near(const Vec<D>& middle, double half_diagonal, double radius) const {
  for (const auto& wall : setup_.walls)
    if (wall.nearest(middle, 0, setup_.domain).height < radius + half_diagonal) return true;
  return !beads_.empty() && middle[D - 1] - half_diagonal < top_ + widest_ + radius;
}

template class Obstacles<2>;
template class Obstacles<3>;

}  // namespace chute::dsmc
