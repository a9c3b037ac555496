#pragma once
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace chute::run {

/// What follows from a scene, for `chute check`.
struct Fact {
  std::string name;
  double value;
  std::string unit, meaning;
};
std::vector<Fact> facts(const scene::Scene& scene);

}  // namespace chute::run
