#pragma once
#include <optional>

#include "laws/list.hpp"

namespace chute::scene {

/// [contact.normal]. What a key means depends on the law; see scene/contact.cpp for which keys each law
/// takes.
struct NormalSpec {
  enum class Law {
    spring_dashpot,
    hertz,
    hertz_linear_damping,
    hertz_kuwabara_kono,
    walton_braun
  } law = Law::spring_dashpot;
  std::optional<double> stiffness;       ///< k_n: N/m, with Hertz's spring N m^{-3/2}; k_1 of walton-braun
  std::optional<double> contact_time;    ///< instead of the stiffness: t_n of the reference pair
  std::optional<double> young, poisson;  ///< or the material, for Hertz's spring (1.19); E in Pa
  std::optional<double> restitution;  ///< e_n; of every pair with linear springs, else of the reference pair
  std::optional<double> damping;      ///< or γ_n
  std::optional<double> relaxation;   ///< or the relaxation time A, γ_n = 3/2 A k_n, of hertz-kuwabara-kono
  std::optional<double> unloading_stiffness,
      hardening;  ///< walton-braun: k_2, or s (1/m) of a load-dependent k_2
  std::optional<double>
      at_velocity;  ///< where t_n and e_n depend on the impact velocity: the one they are given for
  laws::MassScaling mass_scaling = laws::MassScaling::none;
};

/// [contact.tangential].
struct ShearSpec {
  enum class Law {
    coulomb_viscous,
    frictionless,
    coulomb,
    viscous,
    cundall_strack,
    mindlin,
    walton_braun_mindlin,
    saw_tooth
  } law = Law::coulomb_viscous;
  double viscosity = 0, friction = 0;
  std::optional<double> stiffness;        ///< k_s: N/m; N m^{-3/2} for mindlin; k_s0 of walton-braun-mindlin
  std::optional<double> stiffness_ratio;  ///< or k_s/k_n
  bool cap = true;                        ///< (3.25): the spring is no longer than friction can hold
  double tooth = 0;                       ///< ζ_0 of saw-tooth, a length
  laws::MassScaling mass_scaling = laws::MassScaling::none;
};

struct ContactSpec {
  bool attraction = true;  ///< false: the normal force is clipped at 0
  NormalSpec normal;
  ShearSpec tangential;
  /// The laws; `reference` is the pair that contact times and velocity-dependent restitutions are given for.
  laws::Contact laws(laws::Pair reference) const;
};

}  // namespace chute::scene
