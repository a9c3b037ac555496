#pragma once
#include <vector>

#include "core/engine.hpp"
#include "engines/contact/solver/body_system.hpp"
#include "engines/contact/solver/convergence.hpp"
#include "engines/contact/touching.hpp"

namespace chute::contact {

/// The problem of frictional contact that a time step poses, solved for the velocities at its end (Moreau 1994,
/// Jean 1999). Unknown are the impulses J of all that touch or may do so within the step:
///
///   v⁺ = v + h g + M⁻¹ H J,   0 ≤ v_n⁺ + max(gap, 0)/h + e_n v_n⁻ ⟂ J_n ≥ 0,   |J_s| ≤ b J_n
///
/// e_n v_n⁻ only with Moreau's impacts, of approaches that are fast and whose gap is closed. Fast approaches with an open
/// gap stay out: they would land without rebound. The bound b is μ_s for contacts that stick at the step's begin (2.32)
/// until one reaches it and breaks; then, and for all others, μ_d.
template <int D>
class StepProblem {
 public:
  StepProblem(const ContactSetup<D>& setup, const Grains<D>& grains);

  /// From the velocities at the step's begin, `begin`, to those at its end; impulses, bounds and states of the contacts
  /// come out, what friction and impacts took goes into the account.
  Convergence solve(Bodies<D>& bodies, std::vector<Touching<D>>& touching, double begin,
                    const Vec<D>& gravity, EnergyAccount& account, Team& team);

 private:
  const ContactSetup<D>& setup_;
  const Grains<D>& grains_;
  std::vector<std::size_t> posed_;  // which of those that touch
  std::array<Array, D> velocity_;
  std::array<Array, turns<D>> spin_;
  std::vector<std::int32_t> a_, b_;
  std::vector<Vec<D>> normal_, arm_a_, arm_b_, offset_, impulse_;
  std::vector<double> friction_, static_friction_, bound_;
  std::vector<unsigned char> sticking_;
  std::vector<Relative<D>> start_;
  bool two_frictions_ = false;

  bool moves(std::size_t j) const { return j < grains_.moving; }
  bool is_wall(std::size_t j) const { return j >= grains_.size(); }
  Relative<D> relative(const Touching<D>& t, const Bodies<D>& bodies, double time) const;
  void pose(const Bodies<D>& bodies, std::vector<Touching<D>>& touching, double begin, const Vec<D>& gravity);
  void add(Touching<D>& t, std::size_t k, const Relative<D>& start, double end, const Bodies<D>& bodies);
  Convergence run(Team& team);
  BodyArrays<D> bodies();
  ContactArrays<D> contacts();
  void take(Bodies<D>& bodies, std::vector<Touching<D>>& touching, double end, EnergyAccount& account);
};

}  // namespace chute::contact
