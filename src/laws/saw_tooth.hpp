#pragma once
#include <cmath>

#include "laws/keys.hpp"
#include "laws/slip.hpp"

namespace chute::laws {

/// Asperities that yield one after the other, after Brilliantov et al., thesis (3.19), read with |F_n| and
/// truncation towards zero, so that the force is odd in ζ:
///
///     F_s = −μ |F_n| (ζ/ζ_0 − trunc(ζ/ζ_0)),    ζ = ∫ v_s dt (3.14)
///
/// In 3D along ζ. The time step has to resolve ζ_0. At constant F_n the force is conservative: each tooth
/// gives back on the way home what it took. Where F_n has risen in between it gives back more: under an
/// elastic normal force impacts gain up to 4 % of their energy.
struct SawTooth {
  static constexpr std::string_view name = "saw-tooth";
  static constexpr int vectors = 1, scalars = 0;
  template <int T>
  using Memory = SlipMemory<T, vectors, scalars>;

  double friction = 0;  ///< μ
  double length = 0;    ///< ζ_0

  template <class Archive>
  void describe(Archive& a) {
    a.required("friction", friction, non_negative, "μ");
    a.required("tooth", length, positive, "ζ_0, length of a tooth");
  }

  bool needs_radius() const { return false; }
  /// Stiffness of a tooth under the normal force F_n.
  double stiffness_at(double normal_force) const { return friction * std::abs(normal_force) / length; }

  template <int T>
  Vec<T> operator()(const Slip<T>& slip, Memory<T>& memory) const {
    auto& zeta = memory.vector[0];
    zeta = zeta + slip.way;
    const double teeth = magnitude(zeta) / length;
    if (teeth == 0) return {};
    return (-friction * std::abs(slip.normal_force) * (teeth - std::trunc(teeth)) / (teeth * length)) * zeta;
  }
  /// ½ μ |F_n| ζ_0 for each whole tooth, and its share of the last.
  template <int T>
  double energy(const Slip<T>& slip, const Memory<T>& memory) const {
    const double teeth = magnitude(memory.vector[0]) / length, whole = std::trunc(teeth),
                 rest = teeth - whole;
    return 0.5 * friction * std::abs(slip.normal_force) * length * (whole + rest * rest);
  }
};

}  // namespace chute::laws
