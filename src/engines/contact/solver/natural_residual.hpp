#pragma once
#include <cmath>

#include "engines/contact/solver/one_contact.hpp"

namespace chute::contact {

/// ‖r − P_K(r − ρ(u + μ|u_t| n))‖ / reference, in a plain loop.
template <int D>
double natural_residual(const Problem<D>& problem, std::span<const Vec<D>> r, double reference) {
  const auto u = problem.velocities(r);
  double sum = 0;
  for (std::size_t i = 0; i < problem.size(); ++i) {
    const OneContact<D> contact(problem.blocks[problem.diagonal(i)], problem.friction[i]);
    const auto off = natural_map(r[i], u[i], contact.friction(), contact.rho());
    sum += dot(off, off);
  }
  return sum == 0 ? 0 : std::sqrt(sum) / reference;
}

}  // namespace chute::contact
