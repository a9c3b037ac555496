#include "engines/event/cells.hpp"

#include <algorithm>
#include <cmath>

namespace chute::event {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// When a flight along one axis, x + v t + ½ a t² from t = 0, leaves through `wall` in the direction `way` =
/// ±1, not before `now`. It is inside, or outside by rounding: then it leaves as soon as it moves outwards.
/// Outward passages against the pull are before the flight's turning point, those with it after; that keeps a
/// flight that turns right at a wall from leaving to and fro without end.
double leaves(double x, double v, double a, double wall, int way, double now) {
  const double ahead = wall - x;
  if (a == 0) return v * way > 0 ? std::max(ahead / v, now) : never;
  const double turn = -v / a, square = v * v + 2 * a * ahead;
  const bool with_pull = a * way > 0;
  if (!with_pull && !(now < turn && square >= 0)) return never;  // on its way back, or turns before the wall
  if (square < 0) return std::max(turn, now);                    // outside by rounding
  const double speed = way * std::sqrt(square);                  // velocity at the wall
  const double t = v * way > 0 ? 2 * ahead / (speed + v) : (speed - v) / a;  // the one without cancellation
  return with_pull ? std::max({t, turn, now}) : std::max(std::min(t, turn), now);
}

}  // namespace

template <int D>
void Cells<D>::build(const std::vector<Flight<D>>& flights, const Domain<D>& domain, double reach,
                     double now) {
  domain_ = domain;
  const std::size_t n = flights.size();
  // A grain far away must not cost memory: no more cells than a few per grain.
  const double most = std::pow(4.0 * static_cast<double>(n) + 64, 1.0 / D) * 4;
  const double narrowest =
      reach * (1 + 1e-6);  // a pair that touches is in neighbouring cells whatever rounding does
  std::vector<Vec<D>> places(n);
  homes_.assign(n, {});
  for (std::size_t i = 0; i < n; ++i) {
    places[i] = flights[i].place_at(now);
    homes_[i].laps = Flight<D>::wrap(places[i], homes_[i].laps, domain);
  }
  for (int k = 0; k < D; ++k) {
    double length = domain.length[k];
    lower_[k] = domain.lower[k];
    if (!domain.periodic(k)) {
      const auto [low, high] = std::minmax_element(
          places.begin(), places.end(), [k](const Vec<D>& a, const Vec<D>& b) { return a[k] < b[k]; });
      lower_[k] = (*low)[k];
      length = std::max((*high)[k] - (*low)[k], narrowest);
    }
    count_[static_cast<std::size_t>(k)] =
        static_cast<int>(std::clamp(std::floor(length / narrowest), 1.0, most));
    width_[k] = length / count_[static_cast<std::size_t>(k)];
  }
  std::size_t cells = 1;
  for (const int c : count_) cells *= static_cast<std::size_t>(c);
  first_.assign(cells, none);
  next_.assign(n, none);
  previous_.assign(n, none);
  for (std::size_t i = n; i-- > 0;) {  // backwards: ids ascend along a chain
    for (int k = 0; k < D; ++k) {
      const auto axis = static_cast<std::size_t>(k);
      homes_[i].cell[axis] = std::clamp(static_cast<int>(std::floor((places[i][k] - lower_[k]) / width_[k])),
                                        0, count_[axis] - 1);
    }
    insert(i);
  }
}

template <int D>
typename Cells<D>::Crossing Cells<D>::crossing(std::size_t i, const Flight<D>& flight, double now) const {
  const Home& home = homes_[i];
  Crossing first;
  for (int k = 0; k < D; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    const double period = domain_.periodic(k) ? domain_.length[k] : 0;
    for (const int step : {-1, 1}) {
      const bool outermost = home.cell[axis] == (step < 0 ? 0 : count_[axis] - 1);
      if (outermost && !domain_.periodic(k)) continue;
      const double wall = lower_[k] + (home.cell[axis] + (step > 0)) * width_[k] + home.laps[axis] * period;
      const double when = flight.time + leaves(flight.place[k], flight.velocity[k], flight.gravity[k], wall,
                                               step, now - flight.time);
      if (when < first.time) first = {when, k, step};
    }
  }
  return first;
}

template <int D>
void Cells<D>::cross(std::size_t i, const Crossing& crossing) {
  remove(i);
  const auto axis = static_cast<std::size_t>(crossing.axis);
  Home& home = homes_[i];
  home.cell[axis] += crossing.step;
  if (home.cell[axis] < 0 || home.cell[axis] >= count_[axis]) {
    home.cell[axis] -= crossing.step * count_[axis];
    home.laps[axis] += crossing.step;
  }
  insert(i);
}

template <int D>
bool Cells<D>::outgrown(const std::vector<Flight<D>>& flights, std::size_t moving, double now) const {
  std::size_t outside = 0;
  for (std::size_t i = 0; i < moving; ++i) {
    const Vec<D> place = flights[i].place_at(now);
    bool out = false;
    for (int k = 0; k < D; ++k) {
      const double cells = (place[k] - lower_[k]) / width_[k];
      out = out || (!domain_.periodic(k) && (cells < -1 || cells > count_[static_cast<std::size_t>(k)] + 1));
    }
    outside += out;
  }
  return outside > 8 + moving / 20;
}

template <int D>
void Cells<D>::insert(std::size_t i) {
  const auto me = static_cast<std::int32_t>(i);
  auto& first = first_[flat(homes_[i].cell)];
  next_[i] = first;
  previous_[i] = none;
  if (first != none) previous_[static_cast<std::size_t>(first)] = me;
  first = me;
}

template <int D>
void Cells<D>::remove(std::size_t i) {
  if (next_[i] != none) previous_[static_cast<std::size_t>(next_[i])] = previous_[i];
  (previous_[i] != none ? next_[static_cast<std::size_t>(previous_[i])] : first_[flat(homes_[i].cell)]) =
      next_[i];
}

template class Cells<2>;
template class Cells<3>;

}  // namespace chute::event
