#pragma once
#include <string>

namespace chute {

/// What follows from a scene or comes out of an experiment: a number with its unit and what it means.
struct Fact {
  std::string name;
  double value;
  std::string unit, meaning;
};

}  // namespace chute
