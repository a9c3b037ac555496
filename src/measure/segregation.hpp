#pragma once
#include <span>
#include <vector>

#include "core/grains.hpp"

namespace chute::measure {

/// How far a material has gone up or down through the others: 2 (⟨u⟩ − ⟨u⟩ of all others), where u ∈ [0, 1] is the part of all
/// grains' volume (in 2D area) that lies below a grain's centre, and means are weighted by volume. 1 if all of it lies above all
/// others, −1 if below, 0 where they are mixed; it knows nothing of how dense or how high the layer is. Of two materials one has
/// what the other has, with the other sign. NaN of a material without grains, or without others.
std::vector<double> segregation_indices(const GrainsView& grains, std::size_t axis, std::size_t materials);

}  // namespace chute::measure
