#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "core/vec.hpp"

namespace chute::automaton {

/// The grains of a site in one byte: bit k, 0 ≤ k < 6, is a mover in direction k; the two bits above count those at rest, 0
/// to 2.
using Site = std::uint8_t;
inline constexpr int site_states = 192;
inline constexpr Site movers(Site s) { return s & 63; }
inline constexpr int resting(Site s) { return s >> 6; }
inline constexpr Site site_of(unsigned moving, int at_rest) {
  return static_cast<Site>(moving | static_cast<unsigned>(at_rest) << 6);
}

/// What happens at sites.
struct SiteRule {
  double dissipation = 0;  ///< p: a site that can lose energy does so
  double gravity = 0;      ///< g: one grain of an occupied site is accelerated
  /// The direction of gravity as lattice directions with their weights, which add up to 1.
  struct Pull {
    int direction;
    double weight;
  };
  std::vector<Pull> pulls;

  /// The two lattice directions next to `gravity`, weighted so that they give its direction in the mean.
  static std::vector<Pull> towards(const Vec<2>& gravity);
};

/// One thing that a site may become.
struct Outcome {
  Site site;
  int lost;  ///< movers that dissipation brought to rest; each had the energy ½
  double probability;
};

/// Everything that may become of a site in one update, before it streams: collide, dissipate, gravity (Peng & Herrmann, Phys.
/// Rev. E 49, R1796 (1994)).
std::vector<Outcome> outcomes(Site site, const SiteRule& rule);

}  // namespace chute::automaton
