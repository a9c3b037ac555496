#pragma once
#include <cstdint>
#include <functional>
#include <limits>

#include "core/vec.hpp"

/// Chutes that grains enter above and leave below: who comes in where, and who leaves.
namespace chute {

/// What a grain is that comes in.
struct Newcomer {
  double radius = 0, mass = 0;
  int material = 0;
};

/// A source of grains: a box in which they appear wherever there is room for them, so many per time. Those for whom there is
/// none wait.
template <int D>
struct Inflow {
  Vec<D> low{}, high{};  ///< corners of the box, which holds all of a grain that appears
  Vec<D> velocity{};     ///< with which they appear
  double spread = 0;     ///< standard deviation of each component of it
  double rate = 0;       ///< grains per time
  double every = 0;      ///< time between the instants at which grains appear
  std::uint64_t seed = 1;
  bool rotation = true;                               ///< false: grains never spin
  std::function<Newcomer(std::uint64_t count)> next;  ///< who comes in when `count` have come before
};

/// Where grains leave the run: their centres lie beyond a place along x, or below a height.
struct Outflow {
  double beyond = std::numeric_limits<double>::infinity();
  double below = -std::numeric_limits<double>::infinity();
  double every = 0;  ///< time between the instants at which grains leave
};

}  // namespace chute
