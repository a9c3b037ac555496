#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace chute::read {

/// What a user says of a file's arrays, where their names do not tell what they are.
struct Meanings {
  Meanings() = default;
  Meanings(double same_radius) : radius(same_radius) {}

  std::optional<double> radius;  ///< of all grains alike
  /// Names of arrays; empty: found by its usual names. A vector may be said as its components, `u,v` or `u,v,w`.
  std::string radius_array, diameter_array, velocity, spin, orientation, type, id;
  /// Of contacts (network.hpp): columns of their strength, one or the components of a vector; of the places of their ends, or of
  /// the ids of the two grains.
  std::vector<std::string> force, ends;

  struct Said {
    std::string_view what;          ///< chute's name for it
    const std::string* array;       ///< in the file
    std::array<int, 3> components;  ///< that make sense; 0: none further
  };
  /// Those that are said.
  std::vector<Said> said() const;
  /// All of the above as text: part of what a frame is drawn from.
  std::string describe() const;
};

}  // namespace chute::read
