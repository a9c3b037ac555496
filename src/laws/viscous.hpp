#pragma once
#include "laws/keys.hpp"
#include "laws/slip.hpp"

namespace chute::laws {

/// Viscous friction, thesis (3.11): F_s = −γ_s v_s, whatever the normal force. Grazing impacts therefore
/// dissipate as much as any. γ_s in kg/s, multiplied by m_eff with the mass conventions `damping` and `both`.
struct Viscous {
  static constexpr std::string_view name = "viscous";

  double viscosity = 0;  ///< γ_s
  MassScaling scaling = MassScaling::none;

  template <class Archive>
  void describe(Archive& a) {
    a.required("viscosity", viscosity, non_negative, "γ_s");
    a.choice("mass_scaling", scaling, mass_scaling_words, "where the reduced mass enters (3.1.1)");
  }

  double effective_viscosity(Pair p) const {
    return scaling == MassScaling::none ? viscosity : viscosity * p.m_eff;
  }
  template <int T>
  Vec<T> operator()(const Vec<T>& slip, double, Pair p) const {
    return -effective_viscosity(p) * slip;
  }
};

}  // namespace chute::laws
