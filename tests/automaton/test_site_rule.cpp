// What happens at one site, against the rules written out a second time as a story with dice.
#include <Random123/philox.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "core/random.hpp"
#include "engines/automaton/lattice.hpp"
#include "engines/automaton/philox_row.hpp"
#include "engines/automaton/site_rule.hpp"

using namespace chute;
using namespace chute::automaton;

namespace {

/// A site as a person would write it down.
struct Plain {
  std::array<bool, 6> mover{};
  int rest = 0;
  Site coded() const {
    unsigned bits = 0;
    for (int k = 0; k < 6; ++k) bits |= static_cast<unsigned>(mover[k]) << k;
    return static_cast<Site>(bits | static_cast<unsigned>(rest) << 6);
  }
  static Plain decoded(Site s) {
    Plain p;
    for (int k = 0; k < 6; ++k) p.mover[k] = s >> k & 1;
    p.rest = s >> 6;
    return p;
  }
  int moving() const { return static_cast<int>(std::count(mover.begin(), mover.end(), true)); }
  std::array<double, 2> momentum() const {
    std::array<double, 2> p{};
    for (int k = 0; k < 6; ++k)
      if (mover[k]) p[0] += std::cos(k * std::numbers::pi / 3), p[1] += std::sin(k * std::numbers::pi / 3);
    return p;
  }
};
bool same(std::array<double, 2> a, std::array<double, 2> b) {
  return std::hypot(a[0] - b[0], a[1] - b[1]) < 1e-9;
}

template <class Dice>
std::size_t one_of(std::size_t n, Dice& dice) {
  return std::uniform_int_distribution<std::size_t>(0, n - 1)(dice);
}
template <class Dice>
bool chance(double p, Dice& dice) {
  return std::uniform_real_distribution<>()(dice) < p;
}

/// One update of one site, with gravity along direction G.
template <class Dice>
Plain played(Plain s, double p, double g, int G, Dice& dice) {
  std::vector<Plain> sets;
  for (int m = 0; m < 64; ++m) {
    Plain other = Plain::decoded(static_cast<Site>(m));
    other.rest = s.rest;
    if (other.moving() == s.moving() && same(other.momentum(), s.momentum())) sets.push_back(other);
  }
  s = sets[one_of(sets.size(), dice)];
  std::vector<Plain> losses;
  for (int k = 0; k < 3; ++k)
    if (s.rest == 0 && s.mover[k] && s.mover[k + 3]) {
      Plain t = s;
      t.mover[k] = t.mover[k + 3] = false, t.rest = 2;
      losses.push_back(t);
    }
  for (int k = 0; k < 6; ++k)
    if (s.rest <= 1 && s.mover[(k + 5) % 6] && s.mover[(k + 1) % 6] && !s.mover[k]) {
      Plain t = s;
      t.mover[(k + 5) % 6] = t.mover[(k + 1) % 6] = false, t.mover[k] = true, ++t.rest;
      losses.push_back(t);
    }
  if (!losses.empty() && chance(p, dice)) s = losses[one_of(losses.size(), dice)];
  const int count = s.moving() + s.rest;
  if (count == 0 || !chance(g, dice)) return s;
  auto which = static_cast<int>(one_of(static_cast<std::size_t>(count), dice));
  if (which < s.rest) {
    if (!s.mover[G]) s.mover[G] = true, --s.rest;
    return s;
  }
  which -= s.rest;
  int k = 0;
  for (;; ++k)
    if (s.mover[k] && which-- == 0) break;
  const double x = std::cos(k * std::numbers::pi / 3) + std::cos(G * std::numbers::pi / 3),
               y = std::sin(k * std::numbers::pi / 3) + std::sin(G * std::numbers::pi / 3);
  if (std::hypot(x, y) < 1e-9) {
    if (s.rest < 2) s.mover[k] = false, ++s.rest;
    return s;
  }
  for (int to = 0; to < 6; ++to)
    if (same({x, y}, {std::cos(to * std::numbers::pi / 3), std::sin(to * std::numbers::pi / 3)}) &&
        !s.mover[to])
      s.mover[k] = false, s.mover[to] = true;
  return s;
}

}  // namespace

TEST_CASE(
    "outcomes of a site are probabilities, keep mass, and without losses and gravity momentum and movers") {
  for (int s = 0; s < site_states; ++s) {
    const auto before = Plain::decoded(static_cast<Site>(s));
    double sum = 0;
    for (const auto& o : outcomes(static_cast<Site>(s), {0, 0, {}})) {
      const auto after = Plain::decoded(o.site);
      CHECK(after.rest == before.rest);
      CHECK(after.moving() == before.moving());
      CHECK(same(after.momentum(), before.momentum()));
      sum += o.probability;
    }
    CHECK(sum == Approx(1).epsilon(1e-14));
    for (const auto& o : outcomes(static_cast<Site>(s), {0.3, 0, {}})) {
      const auto after = Plain::decoded(o.site);
      CHECK(after.rest + after.moving() == before.rest + before.moving());
      CHECK(same(after.momentum(), before.momentum()));
      CHECK(before.moving() - after.moving() == o.lost);
    }
  }
}

TEST_CASE("the table plays every site as the rules with dice do") {
  constexpr double p = 0.35, g = 0.6;
  constexpr int G = 2, games = 20000;
  const SiteTable table({p, g, {{G, 1}}});
  std::mt19937_64 dice(7);
  double chi = 0, degrees = 0;
  for (int s = 0; s < site_states; ++s) {
    std::map<int, std::array<double, 2>> count;
    for (int n = 0; n < games; ++n) {
      count[played(Plain::decoded(static_cast<Site>(s)), p, g, G, dice).coded()][0] += 1;
      count[table(static_cast<Site>(s), static_cast<std::uint32_t>(dice())) & 0xff][1] += 1;
    }
    for (const auto& [site, n] : count) {
      const double diff = n[0] - n[1];
      CAPTURE(s, site, n[0], n[1]);
      CHECK(diff * diff / (n[0] + n[1]) < 30);
      chi += diff * diff / (n[0] + n[1]);
    }
    degrees += static_cast<double>(count.size()) - 1;
  }
  CAPTURE(chi, degrees);
  CHECK(std::abs(chi - degrees) < 5 * std::sqrt(2 * degrees));
}

TEST_CASE("gravity between two lattice directions is pulled in its own direction in the mean") {
  for (const double angle : {0.0, 0.3, 1.0, 2.0, -1.5707963267948966, 3.0, -0.2}) {
    Vec<2> sum{};
    double all = 0;
    for (const auto& [k, weight] : SiteRule::towards({{std::cos(angle), std::sin(angle)}}))
      sum = sum + weight * unit_step(k), all += weight;
    CHECK(all == Approx(1));
    CHECK(std::remainder(std::atan2(sum[1], sum[0]) - angle, 2 * std::numbers::pi) == Approx(0).margin(1e-9));
  }
}

TEST_CASE("rows of random words are Philox's, whatever the processor") {
  const std::uint64_t seed = 0x123456789abcdefull, step = (std::uint64_t{5} << 32) + 77;
  std::vector<std::uint32_t> words(2 * words_at_once), other(words);
  philox_row(Isa::baseline, seed, 12, step, words);
  for (const std::size_t x :
       {std::size_t{0}, std::size_t{1}, std::size_t{7}, std::size_t{64}, std::size_t{127}}) {
    const r123::Philox4x32::ctr_type counter{
        {static_cast<std::uint32_t>(x / 4), 12, 77, 5u << 8 | static_cast<std::uint32_t>(Purpose::engine)}};
    const r123::Philox4x32::key_type key{{0x89abcdefu, 0x1234567u}};
    CHECK(words[x] == r123::Philox4x32()(counter, key)[x % 4]);
  }
  for (const Isa isa : {Isa::avx2, Isa::avx512}) {
    if (best_isa() < isa) continue;
    philox_row(isa, seed, 12, step, other);
    CHECK(other == words);
  }
}
