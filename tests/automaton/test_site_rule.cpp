// What happens at one site, against the rules written out a second time as a story with dice.
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "core/random.hpp"
#include "engines/automaton/bit_planes.hpp"
#include "engines/automaton/lattice.hpp"
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

// A row that holds every state equally often, and what becomes of it again and again: sites of a state are in many places of
// a block, and beside all others.
namespace {

constexpr std::size_t blocks = 3 * site_states / 8, row_sites = blocks * sites_of_block;
using Row = std::vector<std::uint64_t>;

Site state_at(std::size_t x) { return static_cast<Site>(x * 7 % site_states); }
Row row_of_all_states() {
  Row row(planes * blocks * words_of_block);
  for (std::size_t x = 0; x < row_sites; ++x)
    for (unsigned k = 0; k < planes; ++k)
      row[k * blocks * words_of_block + x / 64] |= std::uint64_t{state_at(x) >> k & 1u} << x % 64;
  return row;
}
Site site_in(const Row& row, std::size_t x) {
  unsigned site = 0;
  for (unsigned k = 0; k < planes; ++k)
    site |= static_cast<unsigned>(row[k * blocks * words_of_block + x / 64] >> x % 64 & 1) << k;
  return static_cast<Site>(site);
}

/// How often each state became each other one.
std::vector<std::map<int, double>> counted(const SiteRule& rule, std::uint64_t steps, double& lost) {
  const PlaneRule planes_rule(rule);
  std::vector<std::map<int, double>> count(site_states);
  for (std::uint64_t step = 0; step < steps; ++step) {
    auto row = row_of_all_states();
    lost += static_cast<double>(planes_rule.apply(best_isa(), {row.data(), blocks * words_of_block, blocks},
                                                  {11, static_cast<std::uint32_t>(step % 5), step}));
    for (std::size_t x = 0; x < row_sites; ++x) ++count[state_at(x)][site_in(row, x)];
  }
  return count;
}

}  // namespace

TEST_CASE("planes of bits play every site with the probabilities of the rule") {
  for (const SiteRule& rule : {SiteRule{0, 0, {}}, SiteRule{1, 0, {}}, SiteRule{0.35, 0.6, {{2, 1}}},
                               SiteRule{0.1, 1, {{5, 0.3}, {0, 0.7}}}}) {
    double lost = 0, mean_lost = 0, chi = 0, degrees = 0;
    const auto count = counted(rule, 120, lost);
    for (int s = 0; s < site_states; ++s) {
      std::map<int, double> expected;
      double all = 0;
      for (const auto& [site, n] : count[static_cast<std::size_t>(s)]) all += n;
      for (const auto& o : outcomes(static_cast<Site>(s), rule)) {
        expected[o.site] += o.probability;
        mean_lost += all * o.probability * o.lost;
      }
      for (const auto& [site, n] : count[static_cast<std::size_t>(s)]) {
        CAPTURE(s, site);
        REQUIRE(expected.count(site) == 1);  // nothing happens that cannot
      }
      for (const auto& [site, p] : expected) {
        const auto found = count[static_cast<std::size_t>(s)].find(site);
        const double n = found == count[static_cast<std::size_t>(s)].end() ? 0 : found->second;
        const double mean = all * p;
        CAPTURE(s, site, n, mean);
        REQUIRE(mean > 30);
        CHECK((n - mean) * (n - mean) / mean < 30);
        chi += (n - mean) * (n - mean) / mean;
      }
      degrees += static_cast<double>(expected.size()) - 1;
    }
    CAPTURE(rule.dissipation, rule.gravity, chi, degrees);
    CHECK(std::abs(chi - degrees) <= 5 * std::sqrt(2 * degrees));
    CHECK(lost == Approx(mean_lost).epsilon(0.01));
  }
}

TEST_CASE("the rule is the story with dice") {
  constexpr double p = 0.35, g = 0.6;
  constexpr int G = 2, games = 20000;
  const SiteRule rule{p, g, {{G, 1}}};
  std::mt19937_64 dice(7);
  double chi = 0, degrees = 0;
  for (int s = 0; s < site_states; ++s) {
    std::map<int, double> count, expected;
    for (int n = 0; n < games; ++n)
      ++count[played(Plain::decoded(static_cast<Site>(s)), p, g, G, dice).coded()];
    for (const auto& o : outcomes(static_cast<Site>(s), rule)) expected[o.site] += games * o.probability;
    for (const auto& [site, n] : count) REQUIRE(expected.count(site) == 1);
    for (const auto& [site, mean] : expected) {
      CAPTURE(s, site, count[site], mean);
      CHECK(std::pow(count[site] - mean, 2) / mean < 30);
      chi += std::pow(count[site] - mean, 2) / mean;
    }
    degrees += static_cast<double>(expected.size()) - 1;
  }
  CAPTURE(chi, degrees);
  CHECK(std::abs(chi - degrees) < 5 * std::sqrt(2 * degrees));
}

TEST_CASE("chances are the same bits with every instruction set, and others in other rows and steps") {
  const PlaneRule rule({0.3, 0.4, {{5, 0.3}, {0, 0.7}}});
  const auto played_with = [&](Isa isa, std::uint32_t row, std::uint64_t step) {
    auto sites = row_of_all_states();
    rule.apply(isa, {sites.data(), blocks * words_of_block, blocks}, {3, row, step});
    return sites;
  };
  const auto baseline = played_with(Isa::baseline, 1, 77);
  for (const Isa isa : {Isa::avx2, Isa::avx512})
    if (best_isa() >= isa) CHECK(played_with(isa, 1, 77) == baseline);
  CHECK(played_with(Isa::baseline, 2, 77) != baseline);
  CHECK(played_with(Isa::baseline, 1, 78) != baseline);
  CHECK(played_with(Isa::baseline, 1, 77 + (std::uint64_t{1} << 32)) != baseline);
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
