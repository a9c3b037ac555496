#pragma once
#include <cmath>

#include "laws/keys.hpp"
#include "laws/slip.hpp"

namespace chute::laws {

/// Coulomb's law of sliding friction alone, thesis (3.10): F_s = −μ |F_n| v_s / |v_s|, and 0 where nothing
/// slips.
///
/// It jumps at v_s = 0: a contact that has come to roll shakes with a slip of about 7/2 μ F_n dt / m_eff per
/// step, which vanishes with the force at the end of an impact. In a lasting contact it never ends, and the
/// energy account takes it for dissipation: its residual then says how much too much. Use (3.12) or (3.13)
/// there.
struct Coulomb {
  static constexpr std::string_view name = "coulomb";

  double friction = 0;  ///< μ

  template <class Archive>
  void describe(Archive& a) {
    a.required("friction", friction, non_negative, "μ");
  }

  template <int T>
  Vec<T> operator()(const Vec<T>& slip, double normal_force, Pair) const {
    const double limit = friction * std::abs(normal_force);
    if constexpr (T == 1) {
      return {{slip[0] > 0 ? -limit : slip[0] < 0 ? limit : 0.0}};
    } else {
      const double speed = norm(slip);
      return (speed > 0 ? -limit / speed : 0.0) * slip;
    }
  }
};

}  // namespace chute::laws
