#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "engines/contact/solver/nsgs.hpp"

namespace chute::contact {

/// Coulomb's relation (2.32) at velocity level: one coefficient for contacts that stick, one for those that slide.
struct StaticFriction {
  std::span<const double> held, sliding;    ///< μ_s ≥ μ_d, per contact
  std::span<const unsigned char> sticking;  ///< whether |v_s| at the step's start counts as none
  std::span<double> bound = {};             ///< out: the coefficient that held in the end, if asked for
};

/// Solves with the bound μ_s where a contact sticks at the start and μ_d elsewhere; every contact that ends on the
/// cone of μ_s breaks and has μ_d from then on, and the solver goes on. None regains μ_s, so it ends: each contact
/// then sticks within its bound or slides with μ_d. `solve(bounds)` gives a Convergence; `impulses()` the r that
/// it came to, in the order of the contacts.
template <class Solve, class Impulses>
Convergence with_static_friction(const StaticFriction& friction, const Solve& solve,
                                 const Impulses& impulses) {
  constexpr double rounding = 1e-9;  // of the bound: a contact as near to its cone as this is on it
  const auto m = friction.held.size();
  std::vector<double> bound(m);
  for (std::size_t i = 0; i < m; ++i)
    bound[i] = friction.sticking[i] ? friction.held[i] : friction.sliding[i];
  Convergence all = solve(bound);
  for (bool broken = true; broken;) {
    broken = false;
    const auto r = impulses();
    for (std::size_t i = 0; i < m; ++i) {
      double shear = 0;
      for (std::size_t k = 1; k < r[i].c.size(); ++k) shear += r[i].c[k] * r[i].c[k];
      const double most = bound[i] * r[i][0];
      if (bound[i] > friction.sliding[i] && r[i][0] > 0 && std::sqrt(shear) >= (1 - rounding) * most) {
        bound[i] = friction.sliding[i];
        broken = true;
      }
    }
    if (broken) all = all.then(solve(bound));
  }
  if (!friction.bound.empty()) std::copy(bound.begin(), bound.end(), friction.bound.begin());
  return all;
}

/// The same with the fast solver.
template <class System>
Convergence nsgs(System& system, const StaticFriction& friction, const Goal& goal, Team& team) {
  return with_static_friction(
      friction,
      [&](std::span<const double> bounds) {
        system.set_friction(bounds);
        return nsgs(system, goal, team);
      },
      [&] { return system.result(); });
}

}  // namespace chute::contact
