#include "engines/contact/projection.hpp"

#include <algorithm>
#include <cmath>

namespace chute::contact {
namespace {

/// Sweeps of projected Gauss-Seidel at most; what is left is taken in the next steps.
constexpr int most_sweeps = 50;
/// Good enough: no displacement changes by more than this part of what the deepest overlap has to give.
constexpr double close_enough = 1e-2;

}  // namespace

template <int D>
void Projection<D>::add(const Touching<D>& t, double end) {
  Pair p{t.i, t.j, {}, 0, 0, grains_.inverse_mass[t.i], 0};
  const Vec<D> own = grains_.place(t.i);
  if (t.j >= grains_.size()) {
    const auto touch = setup_.walls[t.j - grains_.size()].nearest(own, end, setup_.domain);
    p.normal = touch.normal;
    p.room = touch.height - grains_.radius[t.i];
  } else {
    const Vec<D> way = setup_.domain.way(grains_.place(t.j), own);
    const double distance = norm(way);
    p.normal = (1 / distance) * way;
    p.room = distance - grains_.radius[t.i] - grains_.radius[t.j];
    p.other = grains_.inverse_mass[t.j];
  }
  const double allowed = slop * setup_.diameter, overlap = -p.room;
  if (overlap > allowed && t.gap >= 0)
    return;  // an impact of the next step, which will be moved back to its time
  deepest_ = std::max(deepest_, overlap);
  p.room += allowed + (1 - setup_.relaxation) * std::max(0.0, overlap - allowed);
  pairs_.push_back(p);
}

template <int D>
double Projection<D>::sweep() {
  double most = 0;
  for (auto& p : pairs_) {
    const bool both = p.j < grains_.moving;
    const Vec<D> apart = both ? way_[p.i] - way_[p.j] : way_[p.i];
    const double before = p.push;
    p.push = std::max(0.0, before - (p.room + dot(p.normal, apart)) / (p.one + p.other));
    const double change = p.push - before;
    if (change == 0) continue;
    most = std::max(most, std::abs(change) * (p.one + p.other));
    way_[p.i] = way_[p.i] + (p.one * change) * p.normal;
    if (both) way_[p.j] = way_[p.j] - (p.other * change) * p.normal;
  }
  return most;
}

template <int D>
const std::vector<Vec<D>>& Projection<D>::find(const std::vector<Touching<D>>& touching, double end) {
  pairs_.clear();
  deepest_ = 0;
  for (const auto& t : touching) add(t, end);
  const double excess = deepest_ - slop * setup_.diameter;
  if (!(excess > 0) || setup_.relaxation == 0) return none_;
  std::fill(way_.begin(), way_.end(), Vec<D>{});
  for (int k = 0; k < most_sweeps; ++k)
    if (sweep() <= close_enough * setup_.relaxation * excess) break;
  return way_;
}

template class Projection<2>;
template class Projection<3>;

}  // namespace chute::contact
