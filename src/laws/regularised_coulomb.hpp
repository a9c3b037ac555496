#pragma once
#include <cmath>
#include <optional>

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
///
/// A slip dies away in 2 m_eff/(7 γ_s), for solid spheres. Where that is much shorter than a time step, the force taken
/// from the slip before the step is far too large: the contact chatters. With `relaxation_steps` = n the viscous branch is
/// integrated implicitly instead, over n steps of length dt: from dv_s/dt = −(7/2) γ_s v_s/m_eff,
///
///     γ_s v_s(t + n dt) = γ_s v_s(t) / (1 + (7/2) γ_s n dt/m_eff),
///
/// which is the same law for slow slips of a soft γ_s, and takes a slip away within n steps however large γ_s is. The
/// largest force stays μ |F_n|. Gear's predictor and corrector stand a damping rate of up to 0.3/dt: n = 12 leaves room
/// for a ball that touches three others at once.
struct RegularisedCoulomb {
  static constexpr std::string_view name = "coulomb-viscous";

  double viscosity = 0;  ///< γ_s
  double friction = 0;   ///< μ
  MassScaling scaling = MassScaling::none;
  std::optional<double> relaxation_steps;  ///< n; without it the force is that of the slip now
  double time_step = 0;                    ///< dt, where one is known: see laws::know_time_step

  template <class Archive>
  void describe(Archive& a) {
    a.required("viscosity", viscosity, non_negative, "γ_s");
    a.required("friction", friction, non_negative, "μ");
    a.choice("mass_scaling", scaling, mass_scaling_words, "where the reduced mass enters (3.1.1)");
    a.value("relaxation_steps", relaxation_steps, at_least(1),
            "slip dies away in no fewer time steps, for γ_s that is stiff; from 12 on stable");
  }

  double effective_viscosity(Pair p) const {
    const double gamma = scaling == MassScaling::none ? viscosity : viscosity * p.m_eff;
    return gamma / (1 + 3.5 * gamma * relaxation_time() / p.m_eff);
  }

  double relaxation_time() const { return relaxation_steps.value_or(0) * time_step; }

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
