#pragma once
#include <vector>

#include "experiments/ball.hpp"

/// Two grains meet, and nothing else: what a pair of contact laws does to a collision.
namespace chute::experiments {

template <int D>
struct BinaryImpact {
  laws::ContactLaws laws;
  Ball<D> i, j;
  Vec<D> normal{};  ///< n when they meet, a unit vector from i to j (1.10); they must approach: v_n < 0
  double steps =
      2000;  ///< time steps in the contact time, or in the time to pass through each other, if shorter
  bool trace = false;  ///< keep the forces of every step
  soft::Scheme scheme = soft::Scheme::gear5;
  Vec<D> origin{};      ///< where they meet
  Watch<D> watch = {};  ///< called after every step, if there is one

  laws::Pair pair() const { return pair_of(i, j); }
  double approach() const { return -dot(j.velocity - i.velocity, normal); }  ///< |v_n| before
  /// The contact time of the normal law at that speed, or the time to pass through each other unhindered if
  /// that is shorter: the chord inside the contact is 2 (R_i + R_j) cos ϑ (2.16).
  double shortest_time() const;
};

/// One instant of the contact.
struct TracePoint {
  double time;          ///< since the surfaces met
  double overlap;       ///< ξ
  double normal_force;  ///< repulsion positive
  double shear_force;
};

template <int D>
struct ImpactOutcome {
  Ball<D> i, j;                          ///< afterwards
  Vec<D> normal{};                       ///< n at the end of the contact
  double contact_time = 0;               ///< until ξ is 0 again, to within a step
  double v_n_before = 0, v_n_after = 0;  ///< (1.13), the latter along the final n
  double psi_before = 0;                 ///< v_s/|v_n| before (1.32), ≥ 0
  double psi_after = 0;  ///< v_s after over |v_n| before (1.33), along the direction of the first slip
  double energy_before = 0, energy_after = 0;  ///< translation in the centre-of-mass system, and rotation
  double normal_loss = 0, shear_loss = 0;      ///< the engine's account of what was dissipated
  std::vector<TracePoint> trace;

  double restitution() const { return -v_n_after / v_n_before; }                        ///< e_n (1.29)
  double total_restitution() const { return std::sqrt(energy_after / energy_before); }  ///< e (3.9)
};

/// Lets two grains collide in free space with the soft-sphere engine. The time step is chosen from the
/// contact time of the normal law, the start such that the contact begins in the middle of a step.
/// std::invalid_argument if they do not approach; WorkError if they have not parted after 1000 contact times.
template <int D>
ImpactOutcome<D> collide(const BinaryImpact<D>& impact);

/// The acetate spheres of chapters 2 and 3: two equal free spheres without spin, R = 3 mm, m = 1.48e-4 kg.
struct Acetate {
  static constexpr double radius = 3e-3, mass = 1.48e-4, reduced_mass = mass / 2;
  static constexpr double stiffness = 7.32e6, damping = 2.06, friction = 0.25;  ///< e_n = 0.87, t_n = 1e-5 s
  static constexpr double hertz_stiffness = 9.0e7;                              ///< (1.19), N m^{-3/2}
  static laws::Normal spring_dashpot() {
    return laws::SpringDashpot::from_damping(stiffness, damping, laws::MassScaling::none);
  }
  static laws::Pair pair() { return laws::Pair(reduced_mass, radius / 2); }

  /// Two of them meet with the relative speed v under the impact angle ϑ, tan ϑ = ψ (1.15).
  static BinaryImpact<2> meet(const laws::ContactLaws& laws, double v, double theta, double steps = 2000);
};

}  // namespace chute::experiments
