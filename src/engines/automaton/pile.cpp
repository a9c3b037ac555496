#include "engines/automaton/pile.hpp"

#include "core/random.hpp"
#include "engines/automaton/lattice.hpp"

namespace chute::automaton {

Pile::Pile(const PileSetup& setup)
    : setup_(setup),
      sites_(static_cast<std::size_t>(setup.length)),
      drawn_(sites_.size(), 0),
      steep_(sites_.size() + 1) {
  for (std::size_t i = 0; i < sites_.size(); ++i) draw(i);
}

void Pile::take_word(std::size_t i) {
  Random random(setup_.seed, Purpose::engine, i, static_cast<std::uint64_t>(drawn_[i]++));
  sites_[i].bits = random() | std::uint64_t{1} << 63;
}

/// A new threshold. Even chances take one bit of a random word, which serves for 63 of them.
void Pile::draw(std::size_t i) {
  auto& site = sites_[i];
  if (setup_.probability_low != 0.5) {
    Random random(setup_.seed, Purpose::engine, i, static_cast<std::uint64_t>(drawn_[i]++));
    site.z_c = random.uniform() < setup_.probability_low ? setup_.low : setup_.high;
    return;
  }
  if (site.bits == 1) take_word(i);
  site.z_c = setup_.low + static_cast<int>(site.bits & 1) * (setup_.high - setup_.low);
  site.bits >>= 1;
}

std::int64_t Pile::relax() {
  std::int64_t topplings = 0;
  const std::size_t last = sites_.size() - 1;
  // A site is noted when it crosses its threshold, and topples until it is stable, so that none is noted twice; the place
  // past the last is written to and not counted.
  std::uint32_t *const bottom = steep_.data(), *top = bottom;
  const auto steepen = [&](std::size_t i) {
    auto& site = sites_[i];
    *top = static_cast<std::uint32_t>(i);
    top += ++site.z == site.z_c + 1;
  };
  if (sites_[0].z > sites_[0].z_c) *top++ = 0;
  while (top != bottom) {
    const std::size_t i = *--top;
    auto& site = sites_[i];
    while (site.z > site.z_c) {
      site.z -= i == last ? 1 : 2;
      ++topplings;
      draw(i);
      if (i > 0) steepen(i - 1);
      if (i < last) steepen(i + 1);
    }
  }
  return topplings;
}

void Pile::update(std::int64_t update) {
  ++sites_[0].z;
  last_ = relax();
  topplings_ += last_;
  avalanches_.push_back({update, last_});
}

std::vector<std::pair<std::string, double>> Pile::tells() const {
  double mass = 0, height = 0;
  for (std::size_t i = sites_.size(); i-- > 0;) mass += height += sites_[i].z;
  return {{"mass", mass},
          {"slope", height / static_cast<double>(sites_.size())},
          {"height", height},
          {"topplings", static_cast<double>(topplings_)},
          {"last_avalanche", static_cast<double>(last_)}};
}

void Pile::show(Grains<2>& grains) const {
  int height = 0;
  std::vector<int> heights(sites_.size());
  for (std::size_t i = sites_.size(); i-- > 0;) heights[i] = height += sites_[i].z;
  for (std::size_t i = 0; i < sites_.size(); ++i)
    for (int k = 0; k < heights[i]; ++k) {
      grains.add({{static_cast<double>(i) + 0.5, k + 0.5}}, 0.5, 1, 0.1, true);
      grains.material.back() = k + 1 == heights[i] && sites_[i].z == sites_[i].z_c;  // those about to fall
    }
}

}  // namespace chute::automaton
