#pragma once
#include <cmath>

#include "core/vec.hpp"
#include "laws/keys.hpp"

namespace chute::laws {

/// No tangential force at all: μ = 0.
struct Frictionless {
  static constexpr std::string_view name = "frictionless";
  template <class Archive>
  void describe(Archive&) {}
  template <int T>
  Vec<T> operator()(const Vec<T>&, double, Pair) const {
    return {};
  }
};

/// Coulomb's sliding friction, regularised by viscous friction at small slip, thesis (2.10) = (3.12):
///
///     F_s = −min(γ_s |v_s|, μ |F_n|) v_s / |v_s|
///
/// γ_s is technical: large enough to come close to Coulomb's law, small enough for the time step. With mass
/// scaling `damping` or `both` it is multiplied by m_eff.
struct RegularisedCoulomb {
  static constexpr std::string_view name = "coulomb-viscous";

  double viscosity = 0;  ///< γ_s
  double friction = 0;   ///< μ
  MassScaling scaling = MassScaling::none;

  template <class Archive>
  void describe(Archive& a) {
    a.required("viscosity", viscosity, non_negative, "γ_s");
    a.required("friction", friction, non_negative, "μ");
    a.choice("mass_scaling", scaling, mass_scaling_words, "where the reduced mass enters (3.1.1)");
  }

  double effective_viscosity(Pair p) const {
    return scaling == MassScaling::none ? viscosity : viscosity * p.m_eff;
  }

  /// Force on the second grain of a contact whose surfaces slip at `slip` = v_s, under the normal force F_n.
  template <int T>
  Vec<T> operator()(const Vec<T>& slip, double normal_force, Pair p) const {
    const double limit = friction * std::abs(normal_force), gamma = effective_viscosity(p);
    if constexpr (T == 1) {
      const double viscous = gamma * std::abs(slip[0]);
      return {{std::copysign(viscous < limit ? viscous : limit, -slip[0])}};
    } else {
      const double speed = norm(slip);
      const double drag = gamma * speed <= limit ? gamma : limit / speed;  // never 0/0
      return -drag * slip;
    }
  }
};

}  // namespace chute::laws
