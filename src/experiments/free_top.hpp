#pragma once
#include <array>
#include <vector>

#include "core/vec.hpp"

namespace chute::experiments {

/// A grain of three spheres that nothing pushes, as the soft engine turns it, beside what Jacobi's functions say.
struct TurningTop {
  Vec<3> moments;  ///< principal, over m d²
  double period = 0, time_step = 0;
  struct State {
    double time;
    Vec<3> spin, exact;  ///< along the principal axes
    double energy;       ///< ½ Σ I ω²
    Vec<3> momentum;     ///< the body's own, in space
  };
  std::vector<State> states;
};

/// In so many states, evenly over `periods`, at the steps that a scene of grains with k_n = 1e5 takes by default.
TurningTop turn_freely(double periods, std::size_t states);

}  // namespace chute::experiments
