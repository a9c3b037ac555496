#pragma once
#include "core/domain.hpp"
#include "core/grains.hpp"
#include "core/kernel.hpp"
#include "core/team.hpp"
#include "engines/soft/contacts.hpp"

namespace chute::soft {

enum class Scheme { gear5, verlet };

/// Integrates translation and rotation of the moving grains. A step is predict → forces → correct; where
/// nothing is looked at between two steps, correct and predict are one pass over the memory.
///
/// `gear5`: the fifth-order predictor-corrector, thesis (2.11) to (2.14), for forces that depend on places
/// and velocities. The printed (2.13) adds c_k Δa to the plain derivatives; the coefficients belong to the
/// scaled ones (δt^k/k! d^k r/dt^k), which gives the weights in `Weights`. `verlet`: velocity Verlet; forces
/// see the velocities of the half step, as in LAMMPS.
///
/// In 3D the components of the spin are integrated like velocities, for all grains are spheres and no frame turns with
/// them; orientations follow the spins, step by step. Grains that are not round turn otherwise (RigidMotion): then
/// `turns` is false, and orientations in 3D are left alone.
template <int D>
class Integrator {
 public:
  static constexpr int degrees = D + turns<D>;

  Integrator(Scheme scheme, double time_step, const Vec<D>& gravity, const Domain<D>& domain,
             Isa isa = best_isa(), bool turns = true);

  /// From the next correction on.
  void set_gravity(const Vec<D>& gravity) { gravity_ = gravity; }
  /// Takes the accelerations of the start from the forces there.
  void start(Grains<D>& grains, const GrainSums<D>& sums);
  /// A prediction leaves the forces and torques on the moving grains at 0, for those of the new step to be
  /// added up.
  void predict(Grains<D>& grains, GrainSums<D>& sums, Team& team = Team::alone());
  void correct(Grains<D>& grains, GrainSums<D>& sums, Team& team = Team::alone());
  void correct_and_predict(Grains<D>& grains, GrainSums<D>& sums, Team& team = Team::alone());
  /// The same for some of the moving grains.
  void correct_and_predict(Grains<D>& grains, GrainSums<D>& sums, Part range);

  /// Higher derivatives, for checkpoints: [0] acceleration, [1], [2] its derivatives (gear5 only).
  std::array<std::array<Array, degrees>, 3>& derivatives() { return derivatives_; }
  const std::array<std::array<Array, degrees>, 3>& derivatives() const { return derivatives_; }

 private:
  Scheme scheme_;
  double dt_;
  Vec<D> gravity_;
  Domain<D> domain_;
  Isa isa_;
  bool turns_;
  std::array<std::array<Array, degrees>, 3> derivatives_;

  template <bool Correct, bool Predict>
  void pass(Grains<D>& grains, GrainSums<D>& sums, Part range);
  void wrap(Grains<D>& grains, Part range, int k) const;
  void turn(Grains<D>& grains, Part range) const;
};

}  // namespace chute::soft
