#pragma once
#include "laws/list.hpp"

namespace chute::scene {

/// [contact]: which keys a law takes, and what they mean, stands in the law's own header in src/laws.
struct ContactSpec {
  bool attraction = true;                                   ///< false: the normal force is clipped at 0
  laws::NormalKeys normal;                                  ///< [contact.normal]
  laws::ShearKeys tangential = laws::RegularisedCoulomb{};  ///< [contact.tangential]
  /// The laws; `reference` is the pair that contact times and velocity-dependent restitutions are given for.
  laws::Contact laws(laws::Pair reference) const {
    return laws::make_contact(normal, tangential, {reference, attraction});
  }
};

}  // namespace chute::scene
