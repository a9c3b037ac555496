#pragma once
#include "core/team.hpp"
#include "engines/contact/solver/assembled_system.hpp"
#include "engines/contact/solver/body_system.hpp"
#include "engines/contact/solver/convergence.hpp"

namespace chute::contact {

/// The fast solver: projected non-linear Gauss-Seidel (each contact in turn is solved exactly, the others' impulses
/// held), from the system's impulses on, accelerated where it stalls. Same bytes with any team. System:
/// AssembledSystem, BodySystem.
template <class System>
Convergence nsgs(System& system, const Goal& goal, Team& team);

}  // namespace chute::contact
