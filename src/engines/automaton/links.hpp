#pragma once
#include <cstdint>
#include <vector>

#include "core/world.hpp"
#include "engines/automaton/lattice.hpp"

namespace chute::automaton {

/// A site some of whose links a wall cuts.
struct WallSite {
  int x = 0;
  std::uint8_t blocked = 0;  ///< bit k: nobody goes from here in direction k
  /// What mirrors a blocked direction at the wall: k becomes mirror − k mod 6. −1 where the lattice has no such symmetry
  /// (a corner, a wall that is neither along a row nor upright nor along a lattice direction): there movers turn back.
  int mirror = -1;
};

/// Which links walls cut: those of the lattice's closed edges, and [[wall]]s. A link is cut by a segment or circle that lies
/// across it, and by a plane that it passes; behind planes there are no sites.
struct Links {
  std::vector<std::vector<WallSite>> of_row;  ///< sites with a cut link, from left to right
  std::vector<std::uint8_t> blocked;          ///< of each site
  std::vector<char> inside;                   ///< of each site: not behind a plane, nor outside a circle
};
Links cut_links(const Lattice& lattice, const std::vector<Wall<2>>& walls);

}  // namespace chute::automaton
