#pragma once
namespace chute::contact {

/// What a solver is asked for.
struct Goal {
  double tolerance = 1e-8;   ///< of the residual
  long iterations = 10'000;  ///< sweeps over all contacts at most; state sets at most
  /// The impulse (mass × velocity) that the residual is measured by, as h m g of a step under gravity;
  /// 0: √Σ|ρ q|², the impulses that would stop all contacts one by one.
  double reference = 0;
};

/// What it came to.
struct Convergence {
  long iterations = 0;
  /// ‖r − P_K(r − ρ(u + μ|u_t| n))‖ / reference, ρ = D/trace W_ii per contact: the same in all units.
  double residual = 0;
  bool reached = false;
  /// One of two that were done one after the other.
  Convergence then(const Convergence& next) const {
    return {iterations + next.iterations, next.residual, next.reached};
  }
};

}  // namespace chute::contact
