#pragma once
#include <cmath>

#include "laws/cundall_strack.hpp"

namespace chute::laws {

/// Tangential spring that stiffens with the contact radius, as Mindlin's theory has it for a given load,
/// thesis (3.22):
///
///     F_s = −min(k_s ξ^{1/2} |ζ|, μ |F_n|) ζ / |ζ|
///
/// k_s in N m^{-3/2}, of the order of Hertz's k_n: (1 − ν)/(1 − ν/2) of it for one material. The cap (3.25)
/// may be added. The stiffness changes with ξ at constant ζ, which costs the grains nothing: where ξ grows
/// under a stretched spring, energy appears, and no cap prevents it.
struct MindlinSpring {
  static constexpr int vectors = 1, scalars = 0;
  template <int T>
  using Memory = SlipMemory<T, vectors, scalars>;

  PairCoefficient stiffness;  ///< k_s
  CutOffSpring spring;

  bool needs_radius() const { return stiffness.needs_radius(); }
  double stiffness_at(double xi, Pair p) const { return stiffness(p) * std::sqrt(std::max(0.0, xi)); }

  template <int T>
  Vec<T> operator()(const Slip<T>& slip, Memory<T>& memory) const {
    return spring.force(slip, stiffness_at(slip.overlap, slip.pair), memory.vector[0]);
  }
  template <int T>
  double energy(const Slip<T>& slip, const Memory<T>& memory) const {
    return spring.energy(slip, stiffness_at(slip.overlap, slip.pair), memory.vector[0]);
  }
};

}  // namespace chute::laws
