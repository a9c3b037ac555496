#pragma once
#include <cstdint>
#include <optional>

#include "beds/bed.hpp"

/// Beads that do not all lie at height 0.
namespace chute::beds {

/// Refuses heights so uneven that neighbours lose touch. `height_std` is their standard deviation.
std::optional<Refusal> too_uneven(double height_std, double diameter);

/// Height of bead i of a bed: gaussian with that standard deviation, cut off at three of them; the same for the same seed.
double height_of(std::uint64_t seed, std::int64_t bead, double height_std);

/// How deep a bead of a second layer lies below the first, whose beads of the same diameter are that far away from it, along the
/// bed: it touches them, or where they are too far apart lies half below them.
double depth_of_second_layer(double diameter, double away);

}  // namespace chute::beds
