#pragma once
#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <vector>

#include "core/engine.hpp"
#include "core/world.hpp"
#include "io/wall_faces.hpp"

/// chute's VTK files (binary appended, compressed; ParaView opens them). Each function gives the bytes of a
/// file, so that one place writes files and knows about full disks. Array names stand in common/fields.hpp.
namespace chute::io {

/// What every file says about its run.
struct RunFacts {
  std::string units;  ///< "SI" or "reduced"
  int dimensions = 2;
  std::array<double, 6> domain{};  ///< x0 x1 y0 y1 z0 z1; equal ends where it is not periodic
  std::array<double, 3> gravity{};
  std::vector<WallFace> walls;
  std::vector<std::string> materials;  ///< their names, where the scene gives them any
  std::string clock = "time";          ///< what the time of files counts: "sweeps", "shakes" …
};

/// The facts of a world. Its walls are drawn where its grains and its domain are.
template <int D>
RunFacts facts_of(const World<D>& world, std::string units) {
  RunFacts facts;
  facts.units = std::move(units);
  facts.dimensions = D;
  facts.gravity = as_file_vector(world.gravity);
  Room room{};
  for (int k = 0; k < D; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    double low = world.domain.lower[k], high = low;
    for (std::size_t i = 0; i < world.grains.size(); ++i) {
      low = std::min(low, world.grains.position[axis][i] - world.grains.radius[i]);
      high = std::max(high, world.grains.position[axis][i] + world.grains.radius[i]);
    }
    if (world.domain.periodic(k)) {
      low = world.domain.lower[k], high = low + world.domain.length[k];
      facts.domain[2 * axis] = low, facts.domain[2 * axis + 1] = high;
    }
    room[2 * axis] = low, room[2 * axis + 1] = high;
  }
  // Planes show as far as walls that end, which grains may reach, and even where no grain is near.
  for (const auto& wall : world.walls) {
    if (wall.bounded() || wall.cylinder()) {
      for (const auto& face : faces_of(wall, 0, room))
        for (const auto& corner : face.corners)
          for (std::size_t k = 0; k < D; ++k) {
            room[2 * k] = std::min(room[2 * k], corner[k]);
            room[2 * k + 1] = std::max(room[2 * k + 1], corner[k]);
          }
      continue;
    }
    Vec<D> middle;
    for (int k = 0; k < D; ++k)
      middle[k] = (room[static_cast<std::size_t>(2 * k)] + room[static_cast<std::size_t>(2 * k + 1)]) / 2;
    const Vec<D> foot = middle - wall.height(middle) * wall.normal;
    for (int k = 0; k < D; ++k) {
      auto &low = room[static_cast<std::size_t>(2 * k)], &high = room[static_cast<std::size_t>(2 * k + 1)];
      low = std::min(low, foot[k]), high = std::max(high, foot[k]);
    }
  }
  for (std::size_t w = 0; w < world.walls.size(); ++w)
    for (auto& face : faces_of(world.walls[w], static_cast<int>(w), room))
      facts.walls.push_back(std::move(face));
  return facts;
}

/// Files are compressed; checkpoints, which are written often and read rarely, need not be.
enum class Packing { compressed, plain };

/// All grains as vertices, with the fields that core/grains.hpp declares. 2D grains lie at z = 0 and spin about z.
std::string grains_vtp(const GrainsView& grains, const RunFacts& facts,
                       Packing packing = Packing::compressed);

/// One vertex per impact, where the surfaces met.
std::string impacts_vtp(std::span<const Impact> impacts, const RunFacts& facts);

/// The contact network: a line along the branch of each contact, with everything that a Contact tells.
std::string contacts_vtp(const GrainsView& grains, std::span<const Contact> contacts, const RunFacts& facts);

/// The walls as polygons (in 2D lines), as they stand at the start.
std::string walls_vtp(const RunFacts& facts);

}  // namespace chute::io
