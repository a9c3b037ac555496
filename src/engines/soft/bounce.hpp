#pragma once
#include <optional>

#include "engines/soft/contact_ends.hpp"
#include "engines/soft/integrator.hpp"
#include "laws/contact_spec.hpp"

namespace chute::soft {

/// How a run takes its steps.
struct Stepping {
  Scheme scheme = Scheme::gear5;
  ContactEnds ends = ContactEnds::sampled;
  double time_step = 0;
};

/// What steps make of the restitution of a head-on impact. Where in a step the contact begins is chance in a flow.
struct BounceError {
  double mean;   ///< of e_n over these moments, from the law's own
  double worst;  ///< the largest one of all, without sign
};

/// Two equal grains of this pair meet at `speed` at 16 moments of a step, each time in the engine itself. `impact` is what the law
/// makes of it. Nothing if a contact takes so many steps (a thousand) that the error is none, or does not end.
std::optional<BounceError> bounce_error(const laws::ContactLaws& contact, const laws::Pair& pair,
                                        double speed, const laws::NormalImpact& impact,
                                        const Stepping& stepping);

}  // namespace chute::soft
