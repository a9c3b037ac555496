#include "search/neighbour_list.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "core/not_a_number.hpp"

namespace chute::search {
namespace {

/// Has any grain moved farther than the limit? A place that is not a number counts as moved. On the way, the
/// coarse places of the same grains.
template <int D>
struct SurveyKernel {
  static constexpr int words = CoarsePlaces<D>::words;
  std::array<const double*, D> now, before;
  Vec<D> length, half;
  double limit_squared;
  Vec<D> lower, per_length;
  Part range;
  std::array<std::uint64_t*, words> word;
  std::int64_t *any, *astray;

  void operator()() const {
    const auto r = now, r0 = before;
    const auto full = length, fold = half, low = lower, scale = per_length;
    const double limit = limit_squared;
    const auto [begin, end] = range;
    const auto out = word;
    std::int64_t found = 0, far = 0;
    CHUTE_VECTOR_LOOP
    for (std::size_t i = begin; i < end; ++i) {
      double d2 = 0;
      std::array<std::uint64_t, D> fraction;
      for (int k = 0; k < D; ++k) {
        const double x = r[k][i];
        const double d = Domain<D>::nearest_image(x - r0[k][i], full[k], fold[k]);
        d2 += d * d;
        const double quanta = (x - low[k]) * scale[k];
        fraction[k] = CoarsePlaces<D>::fraction(quanta);
        far |= !(std::abs(quanta) < CoarsePlaces<D>::most_quanta);
      }
      found |= !(d2 <= limit);
      for (int w = 0; w < words; ++w)
        out[w][i] = 2 * w + 1 < D ? fraction[2 * w] | fraction[2 * w + 1] << 32 : fraction[2 * w];
    }
    *any = found;
    *astray = far;
  }
};

}  // namespace

template <int D>
NeighbourList<D>::NeighbourList(const Domain<D>& domain, Skins skins, Method method, Isa isa)
    : domain_(domain), skins_(skins), method_(method), isa_(isa) {}

template <int D>
bool NeighbourList<D>::survey(const Grains<D>& grains, Part range) {
  std::int64_t any = 0, astray = 0;
  SurveyKernel<D> kernel{{},
                         {},
                         domain_.length,
                         0.5 * domain_.length,
                         skins_.near * skins_.near / 4,
                         coarse_.lower,
                         coarse_.per_length,
                         range,
                         {},
                         &any,
                         &astray};
  for (int k = 0; k < D; ++k)
    kernel.now[k] = grains.position[k].data(), kernel.before[k] = near_places_[k].data();
  for (int w = 0; w < CoarsePlaces<D>::words; ++w) kernel.word[w] = coarse_.word[w].data();
  run_kernel(isa_, kernel);
  if (astray) astray_.store(true, std::memory_order_relaxed);
  return any;
}

template <int D>
void NeighbourList<D>::remember_places(const Grains<D>& grains) {
  for (int k = 0; k < D; ++k)
    near_places_[k].assign(grains.position[k].begin(),
                           grains.position[k].begin() + static_cast<std::ptrdiff_t>(grains.moving));
}

template <int D>
void NeighbourList<D>::build_far(const Grains<D>& grains, Team& team) {
  for (std::size_t i = 0; i < grains.moving; ++i)
    for (int k = 0; k < D; ++k)
      if (!std::isfinite(grains.position[k][i])) throw NotANumber{i};
  if (method_ == Method::cells)
    grid_.find(grains, domain_, skins_.far + skins_.apart, far_, team);
  else
    all_pairs(grains, domain_, skins_.far + skins_.apart, far_);
  drift_ = 0;
  ++far_builds_;
}

template <int D>
void NeighbourList<D>::build_near(const Grains<D>& grains, Team& team) {
  const auto gather = [&](Part range, PairList& pairs) {
    pairs.clear();
    pairs.reserve(far_.size() / 2);  // whoever gathers: the parts of a list may grow into each other's share
    const auto is_near = [&](std::size_t p) {
      const auto i = static_cast<std::size_t>(far_.i[p]), j = static_cast<std::size_t>(far_.j[p]);
      const auto way = domain_.way(grains.place(i), grains.place(j));
      const double reach = grains.radius[i] + grains.radius[j] + skins_.apart;
      return dot(way, way) < (reach + skins_.near) * (reach + skins_.near);
    };
    for_those(range, is_near, [&](std::size_t p) {
      pairs.add(grains, static_cast<std::size_t>(far_.i[p]), static_cast<std::size_t>(far_.j[p]),
                skins_.apart);
    });
  };
  parts_.resize(team.size() - 1);
  team.split(far_.size(), [&](Part range, std::size_t k) { gather(range, k == 0 ? near_ : parts_[k - 1]); });
  for (const auto& part : parts_) near_.append(part);
  remember_places(grains);
  ++near_builds_;
}

template <int D>
void NeighbourList<D>::set_up_coarse(const Grains<D>& grains) {
  const auto largest = std::max_element(grains.radius.begin(), grains.radius.end());
  coarse_.set_up(domain_, largest == grains.radius.end() ? 1 : 2 * (*largest + skins_.near + skins_.apart));
  for (auto& word : coarse_.word) word.resize(grains.size());
  for (int k = 0; k < D; ++k) near_places_[k] = grains.position[k];  // of the bed, too, for this once
  survey(grains, {0, grains.size()});
}

template <int D>
Candidates<D> NeighbourList<D>::near(const Grains<D>& grains, Team& team) {
  if (!coarse_.ready()) set_up_coarse(grains);
  std::atomic<bool> moved_far = false;
  team.split(grains.moving, [&](Part range, std::size_t) {
    if (survey(grains, range)) moved_far.store(true, std::memory_order_relaxed);
  });
  if (!known_ || moved_far) renew(grains, team);
  return latest();
}

template <int D>
void NeighbourList<D>::renew(const Grains<D>& grains, Team& team) {
  // A pair closer than the near skin now was, when the far list was made, closer than that plus twice the way
  // moved since, which is at most the sum of the farthest ways between the near lists.
  if (known_) drift_ += farthest(grains);
  if (!known_ || !(drift_ <= (skins_.far - skins_.near) / 2)) build_far(grains, team);
  build_near(grains, team);
  known_ = true;
}

/// The longest way that a grain has moved since the near list was made; not a number if a place is not.
template <int D>
double NeighbourList<D>::farthest(const Grains<D>& grains) const {
  double way_squared = 0;
  for (std::size_t i = 0; i < grains.moving; ++i) {
    double d2 = 0;
    for (int k = 0; k < D; ++k) {
      const double d = Domain<D>::nearest_image(grains.position[k][i] - near_places_[k][i], domain_.length[k],
                                                0.5 * domain_.length[k]);
      d2 += d * d;
    }
    if (!(d2 <= way_squared)) way_squared = d2;
    if (std::isnan(d2)) return d2;
  }
  return std::sqrt(way_squared);
}

template <int D>
std::int64_t NeighbourList<D>::lasts(const Grains<D>& grains, double time_step) const {
  double speed_squared = 0;
  for (std::size_t i = 0; i < grains.moving; ++i) {
    double v2 = 0;
    for (int k = 0; k < D; ++k) v2 += grains.velocity[k][i] * grains.velocity[k][i];
    speed_squared = std::max(speed_squared, v2);
  }
  const double left = skins_.near / 2 - farthest(grains), step = std::sqrt(speed_squared) * time_step;
  return left > 0 ? static_cast<std::int64_t>(std::min(left / step, 1e9)) : 0;
}

template class NeighbourList<2>;
template class NeighbourList<3>;

}  // namespace chute::search
