#pragma once
#include <algorithm>
#include <variant>

#include "laws/coulomb.hpp"
#include "laws/cundall_strack.hpp"
#include "laws/hertz.hpp"
#include "laws/hertz_kuwabara_kono.hpp"
#include "laws/hertz_linear_damping.hpp"
#include "laws/mindlin_spring.hpp"
#include "laws/regularised_coulomb.hpp"
#include "laws/saw_tooth.hpp"
#include "laws/spring_dashpot.hpp"
#include "laws/viscous.hpp"
#include "laws/walton_braun.hpp"
#include "laws/walton_braun_mindlin.hpp"

/// Every law that a scene can name. The engine chooses once per step and runs a loop with the law inlined.
/// To add a law: one header beside this, one word here, and its keys in scene/contact.cpp.
///
/// A normal law is a function (ξ, dξ/dt, Pair) → NormalForce with an `energy(ξ, Pair)`; one with a memory
/// names the numbers that it keeps per contact, `memory`, takes them as last argument and returns a
/// RememberedForce. Both answer `needs_radius`, `stiffness(Pair)`, `damping(Pair)` and `impact(speed, Pair)`.
///
/// A tangential law is a function (v_s, F_n, Pair) → F_s on the second grain; what it takes is F_s · v_s. One
/// with a memory names its `vectors` and `scalars`, is a function (Slip, SlipMemory) → F_s, and has an
/// `energy`.
namespace chute::laws {

using Normal = std::variant<SpringDashpot, Hertz, HertzLinearDamping, HertzKuwabaraKono, WaltonBraun>;
using Shear = std::variant<Frictionless, RegularisedCoulomb, Coulomb, Viscous, CundallStrack, MindlinSpring,
                           WaltonBraunMindlin, SawTooth>;

struct Contact {
  Normal normal;
  Shear shear;
  bool attraction = true;  ///< may damping pull the grains together at the end? false: F_n is clipped at 0
};

template <class Law>
concept NormalWithMemory = requires {
  Law::memory;
};
template <class Law>
concept ShearWithMemory = requires {
  Law::vectors;
};

inline bool needs_radius(const Contact& contact) {
  return std::visit([](const auto& law) { return law.needs_radius(); }, contact.normal) ||
         std::visit(
             []<class Law>(const Law& law) {
               if constexpr (ShearWithMemory<Law>)
                 return law.needs_radius();
               else
                 return false;
             },
             contact.shear);
}

/// A head-on impact under the normal law, clipped if the contact says so.
inline NormalImpact normal_impact(const Contact& contact, double speed, Pair p) {
  return std::visit(
      [&]<class Law>(const Law& law) {
        const NormalImpact free = law.impact(speed, p);
        if constexpr (!NormalWithMemory<Law>)
          if (!contact.attraction && law.damping(p) > 0) {
            const auto clipped = [&](double xi, double dxi) { return std::max(0.0, law(xi, dxi, p).total); };
            return integrate_impact(clipped, p.m_eff, speed, free.deepest / speed * 3);
          }
        return free;
      },
      contact.normal);
}

}  // namespace chute::laws
