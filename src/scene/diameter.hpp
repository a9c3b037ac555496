#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/keys.hpp"
#include "core/random.hpp"

namespace chute::scene {

/// How the diameters of grains are spread.
struct Diameter {
  enum class Kind { gaussian, uniform, lognormal, table } kind = Kind::gaussian;
  static constexpr std::array<std::string_view, 4> kinds{"gaussian", "uniform", "lognormal", "table"};

  double mean = 1, std = 0;  ///< gaussian and lognormal, both cut off at three standard deviations (of ln d)
  double from = 0, to = 0;   ///< uniform
  std::vector<double> sizes, weights;  ///< table: diameters, and how many grains have each, of any sum

  /// The mean diameter, of what is cut off too.
  double average() const;
  /// One of them, as its random numbers have it.
  double draw(Random& random) const;
};

void describe(TomlReader& a, Diameter& diameter);
void describe(TomlWriter& a, Diameter& diameter);
void describe(KeyLister& a, Diameter& diameter);

}  // namespace chute::scene
