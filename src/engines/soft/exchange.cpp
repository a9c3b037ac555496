#include "engines/soft/exchange.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace chute::soft {
namespace {

/// The whole number of steps that is nearest to a time.
std::int64_t steps_in(double time, double time_step) {
  return std::max<std::int64_t>(1, std::llround(time / time_step));
}
std::int64_t multiple_after(std::int64_t step, std::int64_t of) { return (step / of + 1) * of; }

}  // namespace

template <int D>
Exchange<D>::Exchange(const Surroundings<D>& around, double time_step)
    : inflow_(around.inflow),
      outflow_(around.outflow),
      domain_(around.domain),
      walls_(around.walls),
      dt_(time_step) {
  if (inflow_) steps_in_ = steps_in(inflow_->every, dt_);
  if (outflow_) steps_out_ = steps_in(outflow_->every, dt_);
}

template <int D>
std::int64_t Exchange<D>::next_after(std::int64_t step) const {
  auto next = std::numeric_limits<std::int64_t>::max();
  if (inflow_) next = std::min(next, multiple_after(step, steps_in_));
  if (outflow_) next = std::min(next, multiple_after(step, steps_out_));
  return next;
}

template <int D>
bool Exchange<D>::leaves(const Grains<D>& grains, std::size_t i) const {
  return grains.position[0][i] > outflow_->beyond || grains.position[D - 1][i] < outflow_->below;
}

template <int D>
void Exchange<D>::let_out(const Grains<D>& grains, std::size_t i) {
  ++left_;
  mass_out_ += grains.mass[i];
  for (std::size_t k = 0; k < D; ++k) momentum_out_[k] += grains.mass[i] * grains.velocity[k][i];
}

template <int D>
std::int64_t Exchange<D>::waiting(std::int64_t step) const {
  if (!inflow_) return 0;
  constexpr double rounding =
      1e-9;  // a grain that is due at this very instant comes, whatever doubles make of the product
  const double due = inflow_->rate * static_cast<double>(step) * dt_;
  return static_cast<std::int64_t>(std::floor(due * (1 + rounding))) - entered_;
}

/// The grains, moving and fixed, that one in the box may touch.
template <int D>
std::vector<typename Exchange<D>::Ball> Exchange<D>::near_box(const Grains<D>& grains) const {
  const Vec<D> middle = 0.5 * (inflow_->low + inflow_->high), half = 0.5 * (inflow_->high - inflow_->low);
  std::vector<Ball> near;
  for (std::size_t i = 0; i < grains.size(); ++i) {
    const Vec<D> place = grains.place(i), way = domain_.way(middle, place);
    bool is_near = true;
    for (int k = 0; k < D; ++k) is_near = is_near && std::abs(way[k]) < half[k] + grains.radius[i];
    if (is_near) near.push_back({place, grains.radius[i]});
  }
  return near;
}

/// A place in the box where a grain touches nobody, by trying some.
template <int D>
std::optional<Vec<D>> Exchange<D>::find_room(const std::vector<Ball>& near, double radius, double time,
                                             Random& random) const {
  // Places that are tried before a grain waits for the next instant: by chance alone discs fill at most 0.547 of a box and
  // spheres 0.384 of it, and near that most places are taken. More of them cost time and fill the box hardly better.
  constexpr int tries = 200;
  for (int attempt = 0; attempt < tries; ++attempt) {
    Vec<D> place;
    for (int k = 0; k < D; ++k)
      place[k] = random.uniform(inflow_->low[k] + radius, inflow_->high[k] - radius);
    const bool is_free = std::ranges::none_of(near, [&](const Ball& other) {
      const Vec<D> way = domain_.way(place, other.place);
      const double reach = radius + other.radius;
      return dot(way, way) < reach * reach;
    });
    if (is_free && std::ranges::none_of(walls_, [&](const Wall<D>& wall) {
          return wall.nearest(place, time, domain_).height < radius;
        }))
      return place;
  }
  return {};
}

template <int D>
std::vector<Arrival<D>> Exchange<D>::let_in(const Grains<D>& grains, std::int64_t step) {
  std::vector<Arrival<D>> arrivals;
  auto near = near_box(grains);
  for (auto left = waiting(step); left > 0; --left) {
    const auto count = static_cast<std::uint64_t>(entered_);
    const Newcomer grain = inflow_->next(count);
    Random random(inflow_->seed, Purpose::inflow, count, static_cast<std::uint64_t>(step));
    const auto place = find_room(near, grain.radius, static_cast<double>(step) * dt_, random);
    if (!place) break;  // those behind it wait, too, so that grains come in the order in which they are drawn
    Arrival<D>& arrival = arrivals.emplace_back(Arrival<D>{grain, *place, inflow_->velocity});
    for (int k = 0; k < D && inflow_->spread > 0; ++k)
      arrival.velocity[k] += inflow_->spread * random.normal();
    near.push_back({*place, grain.radius});
    ++entered_;
    mass_in_ += grain.mass;
    for (int k = 0; k < D; ++k) momentum_in_[static_cast<std::size_t>(k)] += grain.mass * arrival.velocity[k];
  }
  return arrivals;
}

template <int D>
std::vector<std::pair<std::string, double>> Exchange<D>::tells(std::size_t moving, std::int64_t step) const {
  std::vector<std::pair<std::string, double>> all{{"grains", static_cast<double>(moving)},
                                                  {"entered", static_cast<double>(entered_)},
                                                  {"left", static_cast<double>(left_)},
                                                  {"waiting", static_cast<double>(waiting(step))},
                                                  {"mass_in", mass_in_},
                                                  {"mass_out", mass_out_}};
  constexpr std::array axes{"x", "y", "z"};
  for (std::size_t k = 0; k < D; ++k) {
    all.emplace_back(std::string("momentum_in_") + axes[k], momentum_in_[k]);
    all.emplace_back(std::string("momentum_out_") + axes[k], momentum_out_[k]);
  }
  return all;
}

template class Exchange<2>;
template class Exchange<3>;

}  // namespace chute::soft
