#pragma once
#include <fmt/format.h>

#include <algorithm>

#include "core/random.hpp"
#include "starts/start.hpp"

namespace chute::starts {

/// Velocities of a start that is made, not read: a mean and a gaussian spread of every component, and one spin for all.
class MadeStart : public Start {
 public:
  double velocity = 0, velocity_up = 0, spread = 0;
  std::optional<std::vector<double>> spin;

 protected:
  template <class Archive>
  void describe_velocities(Archive& a) {
    a.value("velocity", velocity, "mean velocity downhill");
    a.value("velocity_up", velocity_up, "mean velocity away from the bed");
    a.value("spread", spread, non_negative, "standard deviation of every component");
    a.value("spin", spin, any_number,
            "angular velocity of each grain: [anticlockwise] in 2D, [x, y, z] in 3D; default none");
  }
  std::optional<Refusal> misfit_of_spin(const Opening& opening) const {
    const std::size_t needed = opening.dimensions == 2 ? 1 : 3;
    if (!spin || spin->size() == needed) return {};
    return Refusal{"grains.start.spin", fmt::format("has {} numbers, needed {}", spin->size(), needed)};
  }
  void set_velocities(const Opening& opening, std::vector<Launch>& launches) const {
    const auto up = static_cast<std::size_t>(opening.dimensions) - 1;
    for (std::size_t i = 0; i < launches.size(); ++i) {
      Random random(opening.seed, Purpose::start, i);
      auto& v = launches[i].velocity;
      v[0] = velocity;
      v[up] = velocity_up;
      for (std::size_t k = 0; k <= up; ++k) v[k] += spread * random.normal();
      if (spin && spin->size() == 1) launches[i].spin[2] = spin->front();
      if (spin && spin->size() == 3) std::copy(spin->begin(), spin->end(), launches[i].spin.begin());
    }
  }
  /// A launch at a place given along, across and above.
  static Launch launch_at(const Opening& opening, double along, double across, double above, double radius) {
    Launch launch;
    launch.place = opening.dimensions == 2 ? std::array{along, above, 0.0} : std::array{along, across, above};
    launch.radius = radius;
    return launch;
  }
};

}  // namespace chute::starts
