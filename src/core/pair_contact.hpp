#pragma once
#include "core/contact.hpp"
#include "core/domain.hpp"
#include "core/grains.hpp"

namespace chute {

/// Grain i's contact with grain j as their places and radii alone tell it: overlap, normal from i to j, branch, and the point in
/// the middle of the overlap. Forces are 0.
template <int D>
Contact pair_contact(const Grains<D>& grains, const Domain<D>& domain, std::size_t i, std::size_t j) {
  const Vec<D> way = domain.way(grains.place(i), grains.place(j));
  const double far = norm(way);
  const Vec<D> n = far > 0 ? (1 / far) * way : Vec<D>{};
  Contact contact;
  contact.a = static_cast<std::int64_t>(i), contact.b = static_cast<std::int64_t>(j);
  contact.overlap = grains.radius[i] + grains.radius[j] - far;
  contact.normal = as_file_vector(n);
  contact.branch = as_file_vector(way);
  contact.point = as_file_vector(grains.place(i) + (grains.radius[i] - 0.5 * contact.overlap) * n);
  return contact;
}

}  // namespace chute
