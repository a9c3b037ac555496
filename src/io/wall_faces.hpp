#pragma once
#include <array>
#include <vector>

#include "core/wall.hpp"

namespace chute::io {

/// The box that endless walls are drawn in: low and high along x, y, z.
using Room = std::array<double, 6>;

/// A piece of a wall as files draw it: a polygon, in 2D a line of two corners.
struct WallFace {
  int wall = 0;
  std::vector<std::array<double, 3>> corners;
};

/// The wall as it stands at the start; nothing of a plane that does not cross the room.
template <int D>
std::vector<WallFace> faces_of(const Wall<D>& wall, int number, const Room& room);

}  // namespace chute::io
