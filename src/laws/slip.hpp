#pragma once
#include <array>
#include <cmath>
#include <cstddef>

#include "core/vec.hpp"
#include "laws/pair.hpp"

namespace chute::laws {

/// What a tangential law with a memory sees of one contact in one step.
template <int T>
struct Slip {
  Vec<T> way;           ///< how far the surfaces slipped against each other since the previous step
  double normal_force;  ///< F_n, repulsion positive
  double overlap;       ///< ξ
  Pair pair;
};

/// What such a law remembers of one contact. Vectors lie in the contact plane and turn with it; in 2D they
/// are components along s (1.11). Everything is 0 when a contact begins.
template <int T, int Vectors, int Scalars>
struct SlipMemory {
  std::array<Vec<T>, static_cast<std::size_t>(Vectors)> vector{};
  std::array<double, static_cast<std::size_t>(Scalars)> scalar{};
};

/// A vector's length, exact for a single component.
template <int T>
double magnitude(const Vec<T>& a) {
  if constexpr (T == 1)
    return std::abs(a[0]);
  else
    return norm(a);
}

}  // namespace chute::laws
