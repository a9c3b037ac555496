#pragma once
#include "engines/contact/solver/body_system.hpp"

namespace chute::contact {

/// The problem with its matrix, W = HᵀM⁻¹H block by block, for solvers that need it. `bodies` have the velocities
/// without impulses.
template <int D>
Problem<D> delassus(const BodyArrays<D>& bodies, const ContactArrays<D>& contacts);

}  // namespace chute::contact
