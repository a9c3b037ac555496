#pragma once
#include <span>
#include <utility>
#include <vector>

#include "read/surroundings.hpp"
#include "view/survey.hpp"

namespace chute::view {

/// The edges of walls that are lines to the eye: those of faces that no other face of the same wall shares. A pipe is made
/// of many staves, and shows its two rims.
std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> edges_of(std::span<const read::WallPiece> walls);

/// Is one of them round? Then what is inside lies on no floor.
bool has_round_wall(std::span<const read::WallPiece> walls);

/// Do flat walls stand around what is seen on four sides or more? Then their edges are its outline.
bool stand_around(std::span<const read::WallPiece> walls, const Eigen::AlignedBox3d& seen);

/// Makes walls part of what is to be seen, each where that does not make the grains small: a drum or a silo is what the grains in
/// it move with, and half of one would not look like it.
void include_walls(Survey& survey, std::span<const read::WallPiece> walls);

}  // namespace chute::view
