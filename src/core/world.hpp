#pragma once
#include <limits>
#include <optional>
#include <vector>

#include "core/clump.hpp"
#include "core/domain.hpp"
#include "core/frame.hpp"
#include "core/grains.hpp"
#include "core/inflow.hpp"
#include "core/wall.hpp"

namespace chute {

/// Where grains are: what every method knows besides the grains themselves.
template <int D>
struct Surroundings {
  Domain<D> domain;
  Vec<D> gravity{};            ///< at the start
  std::optional<Tilt> tilt{};  ///< how it changes
  std::vector<Wall<D>> walls;
  double floor = -std::numeric_limits<double>::infinity();  ///< a grain below (last coordinate) is lost
  Frame frame;
  std::optional<Inflow<D>> inflow{};  ///< grains that come in meanwhile
  std::optional<Outflow> outflow{};   ///< and that leave

  /// Is the number of its moving grains another from time to time?
  bool open() const { return inflow || outflow; }
  Vec<D> gravity_at(double t) const {
    return tilt ? gravity_on_incline<D>(tilt->gravity, tilt->angle(t)) : gravity;
  }
  const Surroundings& surroundings() const { return *this; }
};

/// What every method starts from.
template <int D>
struct World : Surroundings<D> {
  Grains<D> grains;  ///< the moving ones, then the bed
  Clumps<D> clumps;  ///< forms of the moving ones, if they are not round
};

}  // namespace chute
