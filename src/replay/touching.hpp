#pragma once
#include <vector>

#include "core/contact.hpp"
#include "core/domain.hpp"
#include "core/grains.hpp"

namespace chute::replay {

/// Who touches whom, by places and radii alone: pairs whose surfaces are less than `gap` apart, in the order of ids.
/// Forces are not a number.
template <int D>
std::vector<Contact> touching(const Grains<D>& grains, const Domain<D>& domain, double gap);

}  // namespace chute::replay
