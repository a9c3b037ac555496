#include "engines/soft/time_tiles.hpp"

#include <algorithm>
#include <thread>
#include <type_traits>

namespace chute::soft {
namespace {

/// More steps at once save little memory traffic, and need wider tiles.
constexpr std::int64_t most_steps = 64, least_steps = 4;

template <class Column>
constexpr bool is_words = !std::is_same_v<std::remove_cvref_t<Column>, Array>;

/// What forces see of the grains.
template <int D, class Each>
void for_seen(Grains<D>& grains, const Each& each) {
  for (auto& a : grains.position) each(a);
  for (auto& a : grains.velocity) each(a);
  for (auto& a : grains.spin) each(a);
}

}  // namespace

/// Every array of numbers, or of whole numbers, that a step changes.
template <int D>
template <class Each>
void TimeTiles<D>::for_state(const StepParts<D>& parts, const Each& each) {
  Grains<D>::for_columns(parts.grains, [&](const GrainField& field, auto& column) {
    if (field.changes) each(column);
  });
  for (auto& order : parts.integrator.derivatives())
    for (auto& a : order)
      if (!a.empty()) each(a);
  each(parts.sums.normal_loss);
  each(parts.sums.shear_loss);
}

template <int D>
std::int64_t TimeTiles<D>::possible(const StepParts<D>& parts, std::int64_t most) {
  if (!cut_) cut(parts.grains.moving, parts.team.size());
  most = std::min({most, most_steps, static_cast<std::int64_t>(narrowest_ / 2)});
  if (most < least_steps) return 0;
  if (seen_list_ == parts.list.near_builds() && !fits_) return 0;
  const auto lasts = [&] {  // a little less, for grains get faster
    return parts.list.lasts(parts.grains, parts.time_step) * 15 / 16;
  };
  auto steps = lasts();
  if (steps < most / 2) {
    parts.list.renew(parts.grains, parts.team);
    steps = lasts();
  }
  if (seen_list_ != parts.list.near_builds()) {
    look_at(parts.list.latest().pairs, parts.grains.moving);
    seen_list_ = parts.list.near_builds();
  }
  steps = std::min(steps, most);
  return fits_ && steps >= least_steps ? steps : 0;
}

/// Where each strip's pairs begin, and whether they all join strips next to each other.
template <int D>
void TimeTiles<D>::look_at(const search::PairList& pairs, std::size_t moving) {
  const std::size_t last = strips_.count() - 1;
  first_pair_.assign(strips_.count() + 1, pairs.size());
  fits_ = true;
  std::size_t own = 0;  // strip of the pair's first grain
  first_pair_[0] = 0;
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const auto i = static_cast<std::size_t>(pairs.i[p]), j = static_cast<std::size_t>(pairs.j[p]);
    while (i >= strips_.begin(own + 1)) first_pair_[++own] = p;
    const bool next = j < strips_.begin(std::min(own + 2, last + 1));
    fits_ = fits_ && (j >= moving || next || (own == 0 && j >= strips_.begin(last)));
  }
}

/// Cuts the strips into tiles of about equally many grains; fewer where strips are so uneven that some would
/// be too narrow.
template <int D>
void TimeTiles<D>::cut(std::size_t grains, std::size_t team) {
  cut_ = true;
  narrowest_ = 0;
  if (strips_.count() == 0) return;
  const std::size_t wanted = (std::max<std::size_t>(1, grains / grains_per_tile_) + team - 1) / team * team;
  for (std::size_t count = wanted; count > 0; count = count * 3 / 4) {
    cut_into(count);
    if (narrowest_ >= 2 * static_cast<std::size_t>(least_steps)) return;
  }
}

/// The first tile leaves one more strip at the border where the last strip meets the first: the pairs across
/// it are listed with strip 0.
template <int D>
void TimeTiles<D>::cut_into(std::size_t count) {
  const std::size_t strips = strips_.count(), grains = strips_.begin(strips);
  tiles_.resize(count);
  narrowest_ = strips;
  for (std::size_t t = 0; t < count; ++t) {
    const std::size_t first = t == 0 ? 0 : tiles_[t - 1].end;
    const std::size_t end = t + 1 == count ? strips : std::max(first, strips_.at(grains * (t + 1) / count));
    const std::size_t begin = first + (t == 0 ? 2 : 1), stop = std::max(end, std::size_t{1}) - 1;
    tiles_[t] = {first, end, begin, stop};
    narrowest_ = std::min(narrowest_, stop > begin ? stop - begin : 0);
  }
}

template <int D>
void TimeTiles<D>::prepare(const StepParts<D>& parts) {
  const std::size_t moving = parts.grains.moving;
  std::size_t arrays = 0, words = 0;
  for_state(parts, [&](const auto& a) { is_words<decltype(a)> ? ++words : ++arrays; });
  saved_.resize(arrays);
  saved_words_.resize(words);
  for (auto& a : saved_) a.resize(moving);
  for (auto& w : saved_words_) w.resize(moving);
  left_.resize(tiles_.size());
  right_.resize(tiles_.size());
  scratch_.resize(parts.team.size());
  failed_ = false;
}

template <int D>
bool TimeTiles<D>::advance(const StepParts<D>& parts, std::int64_t steps) {
  prepare(parts);
  const std::size_t team = parts.team.size(), tiles = tiles_.size();
  const auto first_of = [&](std::size_t member) { return tiles * member / team; };
  next_.resize(team);
  for (std::size_t m = 0; m < team; ++m) next_[m] = first_of(m);
  done_.assign(tiles, 0);
  std::atomic<std::size_t> filled = 0;
  parts.team.run([&](std::size_t member) {
    const auto try_to_fill = [&](std::size_t border) {  // by one, when the tiles on both sides are done
      int both = 2;
      if (!std::atomic_ref(done_[border]).compare_exchange_strong(both, 3, std::memory_order_acq_rel)) return;
      ++filled;
      fill(parts, border, steps, scratch_[member]);
    };
    // Tiles of a stretch of its own, gaps as soon as they can be filled, while both sides are in the cache,
    // and then whatever others have left.
    for (std::size_t shift = 0; shift < team; ++shift) {
      const std::size_t whose = (member + shift) % team;
      for (std::size_t t; (t = std::atomic_ref(next_[whose]).fetch_add(1)) < first_of(whose + 1);) {
        shrink(parts, t, steps, scratch_[member]);
        for (const std::size_t border : {t, (t + 1) % tiles})
          std::atomic_ref(done_[border]).fetch_add(1, std::memory_order_acq_rel);
        try_to_fill(t);
      }
    }
    while (filled < tiles) {
      for (std::size_t k = 0; k < tiles; ++k) try_to_fill((first_of(member) + k) % tiles);
      std::this_thread::yield();  // whoever works on the tiles that are missing may need this processor
    }
  });
  if (failed_) put_back(parts);
  return !failed_;
}

template <int D>
void TimeTiles<D>::shrink(const StepParts<D>& parts, std::size_t tile, std::int64_t steps, Scratch& scratch) {
  const Tile& t = tiles_[tile];
  save(parts, strips_.grains(t.first, t.end));
  for (auto* history : {&left_[tile], &right_[tile]}) {
    history->numbers.clear();
    history->words.clear();
    history->at.clear();
  }
  for (std::size_t k = 0; k < static_cast<std::size_t>(steps) && !failed_; ++k) {
    keep(parts, t.begin + k, left_[tile]);
    keep(parts, t.stop - k - 1, right_[tile]);
    step(parts, {{Part{t.begin + k, t.stop - k}}, 1}, scratch);
  }
}

/// Around the border between a tile and the one before it.
template <int D>
void TimeTiles<D>::fill(const StepParts<D>& parts, std::size_t border, std::int64_t steps, Scratch& scratch) {
  const std::size_t before = (border + tiles_.size() - 1) % tiles_.size();
  const Tile &low = tiles_[before], &high = tiles_[border];
  for (std::size_t k = 0; k < static_cast<std::size_t>(steps) && !failed_; ++k) {
    const Slab slab = border == 0 ? Slab{{Part{0, high.begin + k}, Part{low.stop - k, strips_.count()}}, 2}
                                  : Slab{{Part{low.stop - k, high.begin + k}}, 1};
    const auto exchange = [&] {
      swap(parts, low.stop - k - 1, static_cast<std::int64_t>(k), right_[before]);
      swap(parts, high.begin + k, static_cast<std::int64_t>(k), left_[border]);
    };
    exchange();
    step(parts, slab, scratch);
    exchange();
  }
  right_[before] = {};  // few are needed at a time; all would be half as much memory as the grains take
  left_[border] = {};
}

/// One step of the strips of a slab. Pairs with a strip outside are computed here and there; what they add
/// outside is taken off again.
template <int D>
void TimeTiles<D>::step(const StepParts<D>& parts, const Slab& slab, Scratch& scratch) {
  auto& [contacts, touching] = scratch;
  std::array<Part, 2> pairs;
  for (std::size_t s = 0; s < slab.count; ++s) {
    const Part strips = slab.strips[s];
    pairs[s] = {first_pair_[strips.begin - (strips.begin > 0)], first_pair_[strips.end]};
  }
  parts.stages.evaluate(parts.list.latest(), std::span(pairs.data(), slab.count), parts.grains, contacts,
                        touching);
  parts.stages.apply_forces(contacts, parts.grains, parts.sums);
  bool fails = contacts.deep;
  for (std::size_t s = 0; s < slab.count; ++s) {
    const Part strips = slab.strips[s], own = strips_.grains(strips.begin, strips.end);
    parts.stages.apply_losses(contacts, own, parts.time_step, parts.sums);
    parts.integrator.correct_and_predict(parts.grains, parts.sums, own);
    fails |= parts.list.survey(parts.grains, own);
    if (strips.begin > 0) parts.sums.clear(strips_.grains(strips.begin - 1, strips.begin));
    if (strips.end < strips_.count()) parts.sums.clear(strips_.grains(strips.end, strips.end + 1));
  }
  if (fails) failed_.store(true, std::memory_order_relaxed);
}

/// Adds what forces see of a strip now to its history.
template <int D>
void TimeTiles<D>::keep(const StepParts<D>& parts, std::size_t strip, History& history) const {
  const Part own = strips_.grains(strip, strip + 1);
  history.at.push_back(history.numbers.size());
  for_seen(parts.grains, [&](const Array& a) {
    history.numbers.insert(history.numbers.end(), a.data() + own.begin, a.data() + own.end);
  });
  for (const auto& word : parts.list.coarse_words())
    history.words.insert(history.words.end(), word.data() + own.begin, word.data() + own.end);
}

/// Exchanges a strip as it is now with its history.
template <int D>
void TimeTiles<D>::swap(const StepParts<D>& parts, std::size_t strip, std::int64_t step,
                        History& history) const {
  const Part own = strips_.grains(strip, strip + 1);
  constexpr std::size_t fields = 2 * D + turns<D>;
  const std::size_t at = history.at[static_cast<std::size_t>(step)];
  double* number = history.numbers.data() + at;
  for_seen(parts.grains,
           [&](Array& a) { number = std::swap_ranges(a.data() + own.begin, a.data() + own.end, number); });
  std::uint64_t* kept = history.words.data() + at / fields * search::CoarsePlaces<D>::words;
  for (auto& word : parts.list.coarse_words())
    kept = std::swap_ranges(word.data() + own.begin, word.data() + own.end, kept);
}

template <int D>
template <class Copy>
void TimeTiles<D>::with_saved(const StepParts<D>& parts, const Copy& copy) {
  auto numbers = saved_.begin();
  auto words = saved_words_.begin();
  for_state(parts, [&](auto& a) {
    if constexpr (is_words<decltype(a)>)
      copy(a, *words++);
    else
      copy(a, *numbers++);
  });
}

template <int D>
void TimeTiles<D>::save(const StepParts<D>& parts, Part grains) {
  with_saved(parts, [&](const auto& now, auto& saved) {
    std::copy(now.data() + grains.begin, now.data() + grains.end, saved.data() + grains.begin);
  });
}

template <int D>
void TimeTiles<D>::put_back(const StepParts<D>& parts) {
  with_saved(parts, [](auto& now, const auto& saved) { std::copy(saved.begin(), saved.end(), now.begin()); });
  parts.sums.clear({0, parts.grains.moving});
}

template class TimeTiles<2>;
template class TimeTiles<3>;

}  // namespace chute::soft
