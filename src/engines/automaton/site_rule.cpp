#include "engines/automaton/site_rule.hpp"

#include <bit>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "engines/automaton/lattice.hpp"

namespace chute::automaton {
namespace {

/// Probabilities of (site, movers lost so far).
using Spread = std::map<std::pair<Site, int>, double>;

constexpr int turned(int k, int by) { return ((k + by) % directions + directions) % directions; }
constexpr unsigned bit(int k) { return 1u << turned(k, 0); }

std::pair<int, int> momentum(unsigned moving) {
  std::pair<int, int> sum{0, 0};
  for (int k = 0; k < directions; ++k)
    if (moving & bit(k)) {
      const auto& e = axial[static_cast<std::size_t>(k)];
      sum.first += e[0], sum.second += e[1];
    }
  return sum;
}

Spread collided(Site site) {
  std::vector<unsigned> same;
  for (unsigned m = 0; m < 64; ++m)
    if (std::popcount(m) == std::popcount(unsigned{movers(site)}) && momentum(m) == momentum(movers(site)))
      same.push_back(m);
  Spread spread;
  for (const unsigned m : same)
    spread[{site_of(m, resting(site)), 0}] += 1.0 / static_cast<double>(same.size());
  return spread;
}

/// The ways in which a site can lose energy, as (site, movers lost).
std::vector<std::pair<Site, int>> losses(Site site) {
  const unsigned m = movers(site);
  const int s = resting(site);
  std::vector<std::pair<Site, int>> ways;
  if (s == 0)
    for (int k = 0; k < 3; ++k)
      if ((m & bit(k)) && (m & bit(k + 3))) ways.emplace_back(site_of(m & ~(bit(k) | bit(k + 3)), 2), 2);
  if (s <= 1)
    for (int k = 0; k < directions; ++k)
      if ((m & bit(k - 1)) && (m & bit(k + 1)) && !(m & bit(k)))
        ways.emplace_back(site_of((m & ~(bit(k - 1) | bit(k + 1))) | bit(k), s + 1), 1);
  return ways;
}

/// A mover (or with k = −1 one at rest) accelerated by one unit in direction G; the same site if it has no place.
Site accelerated(Site site, int k, int G) {
  const unsigned m = movers(site);
  const int s = resting(site);
  if (k < 0) return m & bit(G) ? site : site_of(m | bit(G), s - 1);
  const int apart = turned(k, -G);
  if (apart == 3) return s < 2 ? site_of(m & ~bit(k), s + 1) : site;
  if (apart != 2 && apart != 4) return site;
  const int to = apart == 2 ? G + 1 : G - 1;
  return m & bit(to) ? site : site_of((m & ~bit(k)) | bit(to), s);
}

}  // namespace

std::vector<SiteRule::Pull> SiteRule::towards(const Vec<2>& gravity) {
  // At the angle α past direction k, weights w of e_k and 1 − w of e_{k+1} give their sum's direction.
  constexpr double sixth = std::numbers::pi / 3;
  const double angle = std::atan2(gravity[1], gravity[0]) / sixth, down = std::floor(angle + 1e-9);
  const double alpha = (angle - down) * sixth;
  const int k = turned(static_cast<int>(down), 0);
  if (alpha < 1e-6) return {{k, 1}};
  const double a = std::sin(sixth - alpha), b = std::sin(alpha);
  return {{k, a / (a + b)}, {turned(k, 1), b / (a + b)}};
}

std::vector<Outcome> outcomes(Site site, const SiteRule& rule) {
  Spread lossy;
  for (const auto& [now, chance] : collided(site)) {
    const auto ways = losses(now.first);
    lossy[now] += chance * (ways.empty() ? 1 : 1 - rule.dissipation);
    for (const auto& way : ways) lossy[way] += chance * rule.dissipation / static_cast<double>(ways.size());
  }
  Spread pulled;
  for (const auto& [now, chance] : lossy) {
    const Site s = now.first;
    const int count = std::popcount(unsigned{movers(s)}) + resting(s);
    pulled[now] += chance * (count > 0 ? 1 - rule.gravity : 1);
    if (count == 0) continue;
    for (const auto& [G, weight] : rule.pulls) {
      const double one = chance * rule.gravity * weight / count;
      for (int k = 0; k < directions; ++k)
        if (movers(s) & bit(k)) pulled[{accelerated(s, k, G), now.second}] += one;
      if (resting(s) > 0) pulled[{accelerated(s, -1, G), now.second}] += one * resting(s);
    }
    if (rule.pulls.empty()) pulled[now] += chance * rule.gravity;
  }
  std::vector<Outcome> all;
  for (const auto& [now, chance] : pulled)
    if (chance > 0) all.push_back({now.first, now.second, chance});
  return all;
}

}  // namespace chute::automaton
