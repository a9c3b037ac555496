#include "engines/event/near_grains.hpp"

#include <algorithm>
#include <cmath>

namespace chute::event {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// Grains in a list on average, for which the leash is chosen; with more, collisions cost more, with fewer, new posts
/// come more often.
template <int D>
constexpr double usual_near = D == 2 ? 7 : 12;
/// The leash, in radii of the widest grain: no shorter in the densest packing, and no longer however thin the gas.
constexpr double shortest_leash = 0.12, longest_leash = 16;
/// A pair at the end of both leashes is still listed, whatever rounding does: this part of a length is added.
constexpr double slack = 1e-6;
/// A grain that is not farther than this part of the leash from its post when its time is up keeps it: that time is a
/// lower bound.
constexpr double well_inside = 0.75;

}  // namespace

/// The distance of posts from which on i and j do not meet.
template <int D>
double NearGrains<D>::reach(std::size_t i, std::size_t j) const {
  return (radius_[i] + radius_[j] + (j < moving_ ? 2 : 1) * leash_) * (1 + slack);
}

template <int D>
void NearGrains<D>::build(const std::vector<Flight<D>>& flights, const Domain<D>& domain, std::size_t moving,
                          bool independent, double now) {
  domain_ = domain, moving_ = moving, independent_ = independent;
  const std::size_t n = flights.size();
  radius_.resize(n);
  for (std::size_t i = 0; i < n; ++i) radius_[i] = flights[i].radius;
  widest_ = n > 0 ? *std::max_element(radius_.begin(), radius_.end()) : 1;
  posts_.assign(n, {});
  lapped_.assign(n, 0);
  for (std::size_t i = 0; i < n; ++i) put_post(i, flights[i], now);

  // As if all that can be met were spread evenly over the box; where they are not, the leash is shortened until lists
  // are no longer than meant. A list must not hold a grain twice but in two images: hence the period's bound.
  Vec<D> low = posts_.empty() ? Vec<D>{} : posts_[0].place, high = low;
  for (const auto& post : posts_)
    for (int k = 0; k < D; ++k)
      low[k] = std::min(low[k], post.place[k]), high[k] = std::max(high[k], post.place[k]);
  double volume = 1, shortest = never;
  for (int k = 0; k < D; ++k) {
    volume *= domain.periodic(k) ? domain.length[k] : high[k] - low[k] + 2 * widest_;
    if (domain.periodic(k)) shortest = std::min(shortest, domain.length[k]);
  }
  const double met = static_cast<double>(independent ? n - moving + 1 : n), ball = D == 2 ? 3.14 : 4.19;
  const double sphere = std::pow(usual_near<D> * volume / (met * ball), 1.0 / D);
  double longest = longest_leash * widest_;
  if (shortest < never) longest = std::min(longest, (shortest / (1 + 2 * slack) - 2 * widest_) / 2);
  longest = std::max(longest, 1e-3 * widest_);  // where nothing can be met
  const double least = std::min(shortest_leash * widest_, longest);
  leash_ = std::clamp((sphere - 2 * widest_) / 2, least, longest);
  for (;;) {
    lay_cells();
    fill(static_cast<std::size_t>(2 * usual_near<D>));
    std::size_t total = 0;
    for (std::size_t i = 0; i < moving; ++i) total += of(i).size();
    if (leash_ <= least || static_cast<double>(total) <= 1.3 * usual_near<D> * static_cast<double>(moving))
      return;
    leash_ = std::max(least, 0.75 * leash_);
  }
}

template <int D>
void NearGrains<D>::lay_cells() {
  const std::size_t n = posts_.size();
  // A grain far away must not cost memory: no more cells than a few per grain.
  const double most = std::pow(4.0 * static_cast<double>(n) + 64, 1.0 / D) * 4;
  const double narrowest = 2 * (widest_ + leash_) * (1 + 2 * slack);
  for (int k = 0; k < D; ++k) {
    double length = domain_.length[k];
    lower_[k] = domain_.lower[k];
    if (!domain_.periodic(k)) {
      const auto [low, high] =
          std::minmax_element(posts_.begin(), posts_.end(),
                              [k](const Post& a, const Post& b) { return a.place[k] < b.place[k]; });
      lower_[k] = low->place[k];
      length = std::max(high->place[k] - low->place[k], narrowest);
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
  for (std::size_t i = n; i-- > 0;) insert(i);
}

/// All lists from the cells.
template <int D>
void NearGrains<D>::fill(std::size_t expected) {
  near_.assign(moving_ * expected, {});
  for (std::size_t i = 0; i < moving_; ++i) {
    Post& post = posts_[i];
    post.begin = i * expected, post.count = 0, post.room = static_cast<std::int32_t>(expected);
  }
  for (std::size_t i = 0; i < moving_; ++i)
    around(i, [&](std::int32_t j, const std::array<std::int8_t, D>& image) { add(i, {j, image}); });
}

template <int D>
void NearGrains<D>::add(std::size_t i, const Near& near) {
  Post& row = posts_[i];
  if (row.count == row.room) {  // moves to the end, with twice the room
    const std::size_t begin = near_.size();
    near_.resize(begin + 2 * static_cast<std::size_t>(row.room) + 4);
    std::copy_n(near_.begin() + static_cast<std::ptrdiff_t>(row.begin), row.count,
                near_.begin() + static_cast<std::ptrdiff_t>(begin));
    row.begin = begin, row.room = 2 * row.room + 4;
  }
  near_[row.begin + static_cast<std::size_t>(row.count++)] = near;
}

/// visit(j, image) for every grain whose post is near that of i.
template <int D>
template <class Visit>
void NearGrains<D>::around(std::size_t i, const Visit& visit) const {
  const Cell home = cell_at(posts_[i].place);
  for (int way = 0; way < (D == 2 ? 9 : 27); ++way) {
    std::array<std::int8_t, D> image{};
    Cell cell = home;
    bool exists = true;
    for (int k = 0, w = way; k < D; ++k, w /= 3) {
      const auto axis = static_cast<std::size_t>(k);
      cell[axis] += w % 3 - 1;
      if (cell[axis] >= 0 && cell[axis] < count_[axis]) continue;
      if (!domain_.periodic(k)) {
        exists = false;
        break;
      }
      image[axis] = static_cast<std::int8_t>(cell[axis] < 0 ? -1 : 1);
      cell[axis] -= image[axis] * count_[axis];
    }
    if (!exists) continue;
    for (auto j = first_[flat(cell)]; j != none; j = next_[static_cast<std::size_t>(j)]) {
      const auto other = static_cast<std::size_t>(j);
      if (other == i || (independent_ && other < moving_)) continue;
      Vec<D> way_to = posts_[other].place -
                      posts_[i].place;  // to the last bit the opposite of the way from there to here
      for (int k = 0; k < D; ++k)
        if (const auto periods = image[static_cast<std::size_t>(k)]; periods != 0)
          way_to[k] += periods * domain_.length[k];
      const double far = reach(i, other);
      if (dot(way_to, way_to) < far * far) visit(j, image);
    }
  }
}

template <int D>
Vec<D> NearGrains<D>::from_post(std::size_t i, const Flight<D>& flight, double now) const {
  Vec<D> way = flight.place_at(now) - posts_[i].place;
  for (int k = 0; k < D; ++k)
    if (const int laps = posts_[i].laps[static_cast<std::size_t>(k)]; laps != 0)
      way[k] -= laps * domain_.length[k];
  return way;
}

template <int D>
double NearGrains<D>::leaves(std::size_t i, const Flight<D>& flight, double now) const {
  const Vec<D> r = from_post(i, flight, now), v = flight.velocity_at(now);
  const double pull = norm(flight.gravity);
  if (pull == 0) {  // |r + v t| = leash
    const double along = dot(r, v), v2 = dot(v, v), inside = leash_ * leash_ - dot(r, r);
    if (!(v2 > 0)) return never;
    if (inside <= 0) return now;
    const double root = std::sqrt(along * along + v2 * inside);
    return now + (along > 0 ? inside / (root + along) : (root - along) / v2);
  }
  // As if it flew straight away from its post, ever faster.
  const double left = leash_ - norm(r), speed = norm(v);
  return left > 0 ? now + 2 * left / (speed + std::sqrt(speed * speed + 2 * pull * left)) : now;
}

template <int D>
bool NearGrains<D>::follow(std::size_t i, const Flight<D>& flight, double now) {
  if (norm(from_post(i, flight, now)) < well_inside * leash_) return false;
  const auto me = static_cast<std::int32_t>(i);
  for (const Near& near : of(i)) {
    const auto j = static_cast<std::size_t>(near.other);
    if (j >= moving_) continue;
    Post& row = posts_[j];
    Near *begin = near_.data() + row.begin, *end = begin + row.count;
    row.count = static_cast<std::int32_t>(
        std::remove_if(begin, end, [&](const Near& n) { return n.other == me; }) - begin);
  }
  posts_[i].count = 0;
  remove(i);
  put_post(i, flight, now);
  insert(i);
  around(i, [&](std::int32_t j, const std::array<std::int8_t, D>& image) {
    add(i, {j, image});
    const auto other = static_cast<std::size_t>(j);
    if (other >= moving_) return;
    Near back{me, {}};
    for (std::size_t k = 0; k < D; ++k) back.image[k] = static_cast<std::int8_t>(-image[k]);
    add(other, back);
  });
  return true;
}

template <int D>
void NearGrains<D>::put_post(std::size_t i, const Flight<D>& flight, double now) {
  Post& post = posts_[i];
  post.place = flight.place_at(now), post.laps = {};
  Flight<D>::wrap(post.place, post.laps, domain_);
  lapped_[i] = post.laps != std::array<int, D>{};
}

template <int D>
typename NearGrains<D>::Cell NearGrains<D>::cell_at(const Vec<D>& place) const {
  Cell c;
  for (int k = 0; k < D; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    const double at = std::floor((place[k] - lower_[k]) / width_[k]);
    c[axis] = static_cast<int>(std::clamp(at, 0.0, static_cast<double>(count_[axis] - 1)));
  }
  return c;
}

template <int D>
bool NearGrains<D>::outgrown(const std::vector<Flight<D>>& flights, double now) const {
  std::size_t outside = 0;
  for (std::size_t i = 0; i < moving_; ++i) {
    const Vec<D> place = flights[i].place_at(now);
    bool out = false;
    for (int k = 0; k < D; ++k) {
      const double cells = (place[k] - lower_[k]) / width_[k];
      out = out || (!domain_.periodic(k) && (cells < -1 || cells > count_[static_cast<std::size_t>(k)] + 1));
    }
    outside += out;
  }
  return outside > 8 + moving_ / 20;
}

template <int D>
void NearGrains<D>::insert(std::size_t i) {
  const auto me = static_cast<std::int32_t>(i);
  const auto cell = flat(cell_at(posts_[i].place));
  auto& first = first_[cell];
  posts_[i].cell = static_cast<std::int32_t>(cell);
  next_[i] = first;
  previous_[i] = none;
  if (first != none) previous_[static_cast<std::size_t>(first)] = me;
  first = me;
}

template <int D>
void NearGrains<D>::remove(std::size_t i) {
  if (next_[i] != none) previous_[static_cast<std::size_t>(next_[i])] = previous_[i];
  (previous_[i] != none ? next_[static_cast<std::size_t>(previous_[i])]
                        : first_[static_cast<std::size_t>(posts_[i].cell)]) = next_[i];
}

template class NearGrains<2>;
template class NearGrains<3>;

}  // namespace chute::event
