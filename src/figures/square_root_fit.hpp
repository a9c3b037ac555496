#pragma once
#include <span>

namespace chute::figures {

/// (4.20): v̄ = v_0 + f √(s − s_AB), with s = sin θ.
struct SquareRootFit {
  double v_0, f, s_AB;
};

/// Least squares, the points counting alike: v_0 and f in closed form for each s_AB, which is searched below
/// the first point. Needs three points; `s` ascends.
SquareRootFit fit_square_root(std::span<const double> s, std::span<const double> v);

}  // namespace chute::figures
