#pragma once
#include <array>
#include <optional>
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
/// To add a law: one header beside this, and its name in one of the two lists here.
///
/// Every law has its `name` in scenes, and describes its keys: itself, or by a type `Keys` (laws/keys.hpp).
///
/// A normal law is a function (ξ, dξ/dt, Pair) → NormalForce with an `energy(ξ, Pair)`; one with a memory
/// names the numbers that it keeps per contact, `memory`, takes them as last argument and returns a
/// RememberedForce. Both answer `needs_radius`, `stiffness(Pair)`, `damping(Pair)` and `impact(speed, Pair)`;
/// `stiffness_coefficient` is what k_s/k_n is a multiple of.
///
/// A tangential law is a function (v_s, F_n, Pair) → F_s on the second grain; what it takes is F_s · v_s. One
/// with a memory names its `vectors` and `scalars`, is a function (Slip, SlipMemory) → F_s, and has an
/// `energy`.
namespace chute::laws {

using Normal = std::variant<SpringDashpot, Hertz, HertzLinearDamping, HertzKuwabaraKono, WaltonBraun>;
using Shear = std::variant<Frictionless, RegularisedCoulomb, Coulomb, Viscous, CundallStrack, MindlinSpring,
                           WaltonBraunMindlin, SawTooth>;

struct ContactLaws {
  Normal normal;
  Shear shear;
  bool attraction = true;  ///< may damping pull the grains together at the end? false: F_n is clipped at 0
};

/// What a scene says of a law: its `Keys`, or the law itself.
template <class Law>
struct KeysOf {
  using Type = Law;
};
template <class Law>
requires requires { typename Law::Keys; }
struct KeysOf<Law> {
  using Type = typename Law::Keys;
};

/// Does the law ask for Hertz's spring? Nothing but the name counts.
template <class Law>
concept HasHertzSpring = requires {
  Law::hertz_spring;
};

template <class Laws>
struct ListOf;
template <class... Law>
struct ListOf<std::variant<Law...>> {
  using Keys = std::variant<typename KeysOf<Law>::Type...>;
  static constexpr std::array<std::string_view, sizeof...(Law)> names{Law::name...};
  /// Hertz's spring, k_n ξ^{3/2}, among the normal laws; those whose k_s/k_n asks for it among the others.
  static constexpr std::array<bool, sizeof...(Law)> hertz_springs{HasHertzSpring<Law>...};
};
using NormalKeys = ListOf<Normal>::Keys;
using ShearKeys = ListOf<Shear>::Keys;

template <class Law>
concept NormalWithMemory = requires {
  Law::memory;
};
template <class Law>
concept ShearWithMemory = requires {
  Law::vectors;
};

inline bool needs_radius(const ContactLaws& contact) {
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
inline NormalImpact normal_impact(const ContactLaws& contact, double speed, Pair p) {
  return std::visit(
      [&]<class Law>(const Law& law) {
        if constexpr (NormalWithMemory<Law>)
          return law.impact(speed, p);
        else
          return impact_of(law, contact.attraction, speed, p);
      },
      contact.normal);
}

/// Where a tangential law keeps its μ; null if it has none.
inline double* friction(Shear& shear) {
  return std::visit(
      [](auto& law) -> double* {
        if constexpr (requires { law.friction; })
          return &law.friction;
        else if constexpr (requires { law.spring.friction; })
          return &law.spring.friction;
        else
          return nullptr;
      },
      shear);
}

/// Tells laws that integrate a part of their force themselves how long a time step is.
inline void know_time_step(ContactLaws& contact, double time_step) {
  std::visit(
      [&](auto& law) {
        if constexpr (requires { law.time_step; }) law.time_step = time_step;
      },
      contact.shear);
}

/// Asks for that restitution in place of whatever damping the keys have; false if the law takes none.
inline bool set_restitution(NormalKeys& normal, double e_n) {
  return std::visit(
      [&](auto& keys) {
        if constexpr (requires { keys.restitution; }) {
          keys.restitution = e_n;
          if constexpr (requires { keys.damping; }) keys.damping.reset();
          if constexpr (requires { keys.relaxation; }) keys.relaxation.reset();
          if constexpr (requires { keys.unloading_stiffness; })
            keys.unloading_stiffness.reset(), keys.hardening.reset();
          return true;
        } else {
          return false;
        }
      },
      normal);
}

/// Friction with μ = 0 is the law `frictionless`, which costs nothing, unless the law has to stay what it is.
enum class KeepLaw { no, yes };

/// The laws that a scene's keys come to.
ContactLaws make_contact(const NormalKeys& normal, const ShearKeys& shear, const Reference& reference,
                         KeepLaw keep = KeepLaw::no);

}  // namespace chute::laws
