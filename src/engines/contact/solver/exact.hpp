#pragma once
#include "engines/contact/solver/convergence.hpp"
#include "engines/contact/solver/problem.hpp"

namespace chute::contact {

/// Contacts that the exact solver takes: it solves dense systems of so many times D equations, one for each change
/// of a state.
inline constexpr std::size_t most_exact = 200;

template <int D>
struct ExactSolution {
  std::vector<Vec<D>> r;
  Convergence convergence;  ///< its iterations: sets of states that were solved
};

/// The slow twin: the thesis's iteration over the states of the contacts (section 2.2). Each is open, sticks or
/// slides, at first as v_s says; with these states Coulomb's law is the linear system (2.33), solved with the least
/// r where it is singular; contacts that then break the law change their state, the one that breaks it most
/// first: (2.34) a sticking one beyond its cone slides, (2.35) a sliding one pushed along its slip sticks, one that
/// pulls opens and an open one that closes touches. At velocity level v̇_s and forces are the velocities after the
/// impulses and the impulses. In space the directions of slip are found by iteration inside each set of states.
///
/// Sets of states are remembered. Where the worst offender's change leads to one that was met, the next offender
/// changes; WorkError where all of them do, or where the solution found is none. InputError for too many contacts.
template <int D>
ExactSolution<D> exact(const Problem<D>& problem, const Goal& goal);

}  // namespace chute::contact
