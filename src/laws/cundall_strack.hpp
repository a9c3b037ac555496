#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "laws/keys.hpp"
#include "laws/slip.hpp"

namespace chute::laws {

/// A tangential spring of stiffness k that is cut off at the Coulomb limit L = μ |F_n|: the shape that (3.13)
/// and (3.22) share. The spring's length ζ = ∫ v_s dt (3.14) is the memory.
///
/// Without the cap the cut-off acts on the force only and ζ goes on growing while the contact slips. F_s is
/// then a function of ζ and F_n: at constant F_n it is conservative even where it slips, and gives back on
/// the way home all that it took, long after the slip has turned round; where F_n rises in between it gives
/// back more than it took: under an elastic normal force impacts gain up to 11 % of their energy. With the
/// cap (3.25), |ζ| ≤ L / k after each step, slipping dissipates and nothing is ever gained.
struct CutOffSpring {
  double friction = 0;  ///< μ
  bool cap = true;      ///< (3.25)

  template <class Archive>
  void describe(Archive& a) {
    a.required("friction", friction, non_negative, "μ");
    a.value("cap", cap, "the spring is cut off at the friction force (3.25)");
  }

  template <int T>
  Vec<T> force(const Slip<T>& slip, double stiffness, Vec<T>& zeta) const {
    zeta = zeta + slip.way;
    const double limit = friction * std::abs(slip.normal_force), length = magnitude(zeta);
    // selections instead of branches, for loops over many contacts
    const double uncut = cap ? 0 : std::numeric_limits<double>::infinity();
    const bool sticks = stiffness * length <= limit, keeps = stiffness * length <= limit + uncut;
    const double slides = -limit / length, factor = sticks ? -stiffness : slides;
    const double inverse = -1 / stiffness, back = stiffness > 0 ? inverse : 0;
    const Vec<T> force = factor * zeta, cut = back * force;
    for (int k = 0; k < T; ++k) zeta[k] = keeps ? zeta[k] : cut[k];
    return force;
  }

  /// What the spring gives back on the way to ζ = 0 at the present F_n: ½ k ζ², and L |ζ| beyond the cut-off.
  template <int T>
  double energy(const Slip<T>& slip, double stiffness, const Vec<T>& zeta) const {
    const double limit = friction * std::abs(slip.normal_force), length = magnitude(zeta);
    const double spring = 0.5 * stiffness * length * length,
                 beyond = limit * length - 0.5 * limit * limit / stiffness;
    return stiffness * length <= limit ? spring : beyond;
  }
};

/// Tangential spring after Cundall and Strack, thesis (3.13), with or without the cap (3.25):
///
///     F_s = −min(k_s |ζ|, μ |F_n|) ζ / |ζ|,    ζ = ∫ v_s dt (3.14)
struct CundallStrack {
  static constexpr std::string_view name = "cundall-strack";
  static constexpr int vectors = 1, scalars = 0;
  template <int T>
  using Memory = SlipMemory<T, vectors, scalars>;

  PairCoefficient stiffness;  ///< k_s, N/m
  CutOffSpring spring;

  struct Keys : SpringKeys {
    CutOffSpring spring;
    template <class Archive>
    void describe(Archive& a) {
      spring.describe(a);
      SpringKeys::describe(a);
    }
    CundallStrack make(const PairCoefficient& k_n) const { return {resolve(k_n), spring}; }
  };

  bool needs_radius() const { return stiffness.needs_radius(); }
  /// Stiffness while the overlap is `xi`.
  double stiffness_at(double, Pair p) const { return stiffness(p); }

  template <int T>
  Vec<T> operator()(const Slip<T>& slip, Memory<T>& memory) const {
    return spring.force(slip, stiffness(slip.pair), memory.vector[0]);
  }
  template <int T>
  double energy(const Slip<T>& slip, const Memory<T>& memory) const {
    return spring.energy(slip, stiffness(slip.pair), memory.vector[0]);
  }
};

}  // namespace chute::laws
