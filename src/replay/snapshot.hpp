#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/contact.hpp"

namespace chute::replay {

/// The grains at one time, as a file has them: whoever reads files fills it in. What a file lacks is empty.
struct Snapshot {
  std::string name;            ///< of the file, for messages
  std::optional<double> time;  ///< if the file says
  int dimensions = 2;
  std::string units, clock;        ///< as in common/fields.hpp, or empty
  std::array<double, 6> domain{};  ///< x0 x1 y0 y1 z0 z1; equal ends where it is not periodic
  std::array<double, 3> gravity{};

  std::vector<std::array<double, 3>> place;
  std::vector<double> radius;
  std::vector<std::uint8_t> fixed;  ///< 1: of the bed
  std::vector<std::int64_t> id;
  std::vector<double> mass;
  std::vector<std::array<double, 3>> velocity, spin, force;
  std::vector<std::array<double, 4>> orientation;  ///< in the plane [0], an angle
  std::vector<int> material;                       ///< species, a number in `materials`
  std::vector<std::string> materials;              ///< what they are called
  /// The contact network beside the file; ids as `id`. Nothing where there is none.
  std::optional<std::vector<Contact>> contacts;

  std::size_t size() const { return radius.size(); }
};

}  // namespace chute::replay
