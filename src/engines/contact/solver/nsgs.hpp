#pragma once
#include "engines/contact/solver/assembled_system.hpp"
#include "engines/contact/solver/body_system.hpp"
#include "engines/contact/solver/convergence.hpp"

namespace chute::contact {

/// Projected non-linear Gauss-Seidel on a system, from its impulses on. System: AssembledSystem, BodySystem.
template <class System>
Convergence nsgs(System& system, const Goal& goal, Team& team);

}  // namespace chute::contact
