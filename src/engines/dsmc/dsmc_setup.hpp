#pragma once
#include <cstdint>

#include "core/world.hpp"
#include "engines/hard/hard_contact.hpp"

namespace chute::dsmc {

/// What excluded volume does. none: grains collide as points do; rate: more often, by χ of the packing around; esmc: partners
/// are sought a diameter away (Montanero & Santos 1996), which also carries momentum over that way.
enum class Dense { none, rate, esmc };

/// φ beyond which grains are caged by their neighbours, which random partners know nothing of.
inline constexpr double densest = 0.5;

/// What a run needs besides its grains.
template <int D>
struct DsmcSetup : Surroundings<D> {
  hard::HardContact contact{};
  double time_step = 0.01;
  double cell = 3;     ///< wished side of a cell
  double weight = 1;   ///< w: real grains that each simulated one stands for
  double heating = 0;  ///< ξ²: white noise that gives each velocity component so much variance per time
  Dense dense = Dense::rate;
  std::uint64_t seed = 1;
  int threads = 1;
};

/// Random numbers of a step belong to a cell, to a grain's hits of walls, or to a grain's heating.
namespace item {
inline constexpr std::uint64_t cells = 0, walls = std::uint64_t{1} << 30, heating = std::uint64_t{1} << 31;
}

/// What collisions took and gave, gathered in an order that does not depend on threads.
struct Tally {
  std::int64_t collisions = 0, raised = 0;  ///< the second: speeds above what a cell expected
  double normal_loss = 0, shear_loss = 0, wall_work = 0;
  Tally& operator+=(const Tally& o) {
    collisions += o.collisions, raised += o.raised;
    normal_loss += o.normal_loss, shear_loss += o.shear_loss, wall_work += o.wall_work;
    return *this;
  }
};

}  // namespace chute::dsmc
