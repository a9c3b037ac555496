#pragma once
#include <cmath>

#include "laws/cundall_strack.hpp"

namespace chute::laws {

/// Tangential spring that stiffens with the contact radius, as Mindlin's theory has it for a given load,
/// thesis (3.22):
///
///     F_s = −min(k |ζ|, μ |F_n|) ζ / |ζ|,    k = k_s ξ^{1/2}
///
/// k_s in N m^{-3/2}, of the order of Hertz's k_n: (1 − ν)/(1 − ν/2) of it for one material.
///
/// As printed, with the whole slip ζ = ∫ v_s dt (3.14), the spring is no honest one: it stores ½ k ζ², and
/// where ξ grows at constant ζ that rises by ½ ζ² dk, which no force has done. Without the cap (3.25) impacts
/// gain up to 19 % under an elastic normal force; with it none does, but a contact that is loaded again and
/// again while it slips to and fro is a machine. What grows when a contact is loaded further is its area, and
/// the rings that are added are not strained yet: F_s stays, dF_s = −k dζ. So the spring shrinks, ζ ∝ 1/k,
/// and stores less, F_s²/2k. When the contact is unloaded, strained rings let go: ζ stays, F_s ∝ k, and it
/// stores less again. With `shrink`, then,
///
///     dF_s = −k v_s dt             while dξ/dt ≥ 0,
///     dF_s = −k v_s dt + F_s dk/k  while dξ/dt < 0,
///
/// what is stored never grows by more than −F_s v_s dt, and with the cap nothing is ever gained.
struct MindlinSpring {
  static constexpr std::string_view name = "mindlin";
  static constexpr bool hertz_spring = true;      // k_s/k_n is a number with Hertz's spring
  static constexpr int vectors = 1, scalars = 1;  // the spring's length; ξ of the step before
  template <int T>
  using Memory = SlipMemory<T, vectors, scalars>;

  PairCoefficient stiffness;  ///< k_s
  CutOffSpring spring;
  bool shrink = true;  ///< false: as printed

  struct Keys : SpringKeys {
    CutOffSpring spring;
    bool shrink = true;
    template <class Archive>
    void describe(Archive& a) {
      spring.describe(a);
      a.value("shrink", shrink, "the spring shrinks as the contact grows; false: as printed");
      SpringKeys::describe(a);
    }
    MindlinSpring make(const PairCoefficient& k_n) const { return {resolve(k_n), spring, shrink}; }
  };

  bool needs_radius() const { return stiffness.needs_radius(); }
  double stiffness_at(double xi, Pair p) const { return stiffness(p) * std::sqrt(std::max(0.0, xi)); }

  template <int T>
  Vec<T> operator()(const Slip<T>& slip, Memory<T>& memory) const {
    auto& [before] = memory.scalar;
    if (shrink && slip.overlap > before)
      memory.vector[0] = std::sqrt(before / slip.overlap) * memory.vector[0];
    before = std::max(0.0, slip.overlap);
    return spring.force(slip, stiffness_at(slip.overlap, slip.pair), memory.vector[0]);
  }
  template <int T>
  double energy(const Slip<T>& slip, const Memory<T>& memory) const {
    return spring.energy(slip, stiffness_at(slip.overlap, slip.pair), memory.vector[0]);
  }
};

}  // namespace chute::laws
