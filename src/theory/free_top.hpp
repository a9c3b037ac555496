#pragma once
#include <array>

#include "core/vec.hpp"

namespace chute::theory {

/// A rigid body that nothing pushes: its spin ω along its principal axes, by Jacobi's elliptic functions (Landau and Lifshitz,
/// Mechanics, § 37; the case L² < 2 E I_2 is theirs with the first and the third axis exchanged).
class FreeTop {
 public:
  /// Three different principal moments, right-handed axes, and ω at t = 0. WorkError where moments are equal or ω is such that
  /// it turns about one axis for ever, or never comes back (L² = 2 E I_2).
  FreeTop(const Vec<3>& moments, const Vec<3>& start);

  Vec<3> at(double t) const;
  /// Time after which ω is the same again.
  double period() const;

 private:
  std::array<int, 3> axis_{0, 1, 2};  // which principal axis is the n-th of the formulas
  Vec<3> amplitude_{};                // of cn, sn and dn, with signs
  double rate_ = 0, modulus_ = 0, phase_ = 0;
};

}  // namespace chute::theory
