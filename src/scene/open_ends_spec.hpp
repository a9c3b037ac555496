#pragma once
#include <optional>
#include <vector>

#include "common/keys.hpp"
#include "core/inflow.hpp"

/// Chutes that grains enter above and leave below: [inflow] and [outflow], as they are written.
namespace chute::scene {

struct InflowSpec {
  double rate = 0;
  std::vector<double> from, to;
  std::optional<std::vector<double>> velocity;
  double spread = 0;
  std::optional<double> every;
};

struct OutflowSpec {
  double beyond = 0;
  std::optional<double> below, every;
};

template <class Archive>
void describe(Archive& a, InflowSpec& inflow) {
  a.required("rate", inflow.rate, positive,
             "grains that come in per time, sizes and materials as [grains] draws them");
  a.required(
      "from", inflow.from, any_number,
      "lower corner of the box in which they appear, whole, wherever there is room: [x, y], in 3D [x, y, z]");
  a.required("to", inflow.to, any_number, "its upper corner");
  a.value("velocity", inflow.velocity, any_number, "with which they appear; default at rest");
  a.value("spread", inflow.spread, non_negative, "standard deviation of each component of it");
  a.value("every", inflow.every, positive,
          "time between the instants at which they appear; default 0.1 √(d/g)");
}

template <class Archive>
void describe(Archive& a, OutflowSpec& outflow) {
  a.required("beyond", outflow.beyond, any_number, "grains whose centre lies farther along x leave the run");
  a.value("below", outflow.below, any_number, "and those whose centre lies lower");
  a.value("every", outflow.every, positive,
          "time between the instants at which they leave; default 0.1 √(d/g)");
}

}  // namespace chute::scene
