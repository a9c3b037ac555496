#pragma once
#include "engines/contact/solver/problem.hpp"

namespace chute::contact {

/// One number of W, at a row and column of its scalars.
struct Entry {
  std::size_t row, column;
  double value;
};

/// The problem of W's entries; those at one place add up. Where a block is given, the opposite one is made,
/// zero if nothing is known of it, for who touches whom must be mutual; so is every diagonal one.
template <int D>
Problem<D> assemble(std::span<const Entry> entries, std::vector<Vec<D>> q, std::vector<double> friction);

/// InputError, naming the contact from 0, if a number is not finite, μ is negative, or a contact's own block is
/// not positive definite, so that no impulse could stop it.
template <int D>
void check(const Problem<D>& problem);

}  // namespace chute::contact
