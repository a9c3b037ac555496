#pragma once

namespace chute::laws {

/// A normal force and the power that its dissipative part takes. Positive forces push the grains apart.
struct NormalForce {
  double total;      ///< F_n
  double loss_rate;  ///< dissipated energy per time
  /// The part of F_n that is there at once when a contact begins, and until it ends: γ_n dξ/dt.
  double at_once = 0;
};

/// The same for a law that remembers how the contact was loaded: what it dissipates it knows exactly, step by
/// step.
struct RememberedForce {
  double total;  ///< F_n
  double loss;   ///< energy dissipated since the previous step
};

/// What a head-on impact does.
struct NormalImpact {
  double restitution;   ///< e_n (1.29); 0 if the grains never part
  double contact_time;  ///< t_n, until the overlap is 0 again; infinite if the grains never part
  double deepest;       ///< largest overlap ξ_0
};

}  // namespace chute::laws
