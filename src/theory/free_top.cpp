#include "theory/free_top.hpp"

#include <algorithm>
#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <cmath>

#include "common/error.hpp"

namespace chute::theory {

FreeTop::FreeTop(const Vec<3>& moments, const Vec<3>& start) {
  double twice_energy = 0, square = 0;
  for (int k = 0; k < 3; ++k) {
    twice_energy += moments[k] * start[k] * start[k];
    square += moments[k] * moments[k] * start[k] * start[k];
  }
  std::ranges::sort(axis_, {}, [&](int k) { return moments[k]; });
  if (square < twice_energy * moments[axis_[1]]) std::swap(axis_[0], axis_[2]);
  Vec<3> I, w;
  for (std::size_t n = 0; n < 3; ++n)
    I[static_cast<int>(n)] = moments[axis_[n]], w[static_cast<int>(n)] = start[axis_[n]];

  const double to_third = twice_energy * I[2] - square, to_first = square - twice_energy * I[0];
  const bool good = I[0] != I[1] && I[1] != I[2] && to_third / (I[2] - I[0]) > 0 &&
                    to_first / (I[2] - I[0]) > 0 && square != twice_energy * I[1];
  if (!good)
    throw WorkError("a free top needs three different moments and a spin that is none of its steady ones");
  amplitude_ = {{std::sqrt(to_third / (I[0] * (I[2] - I[0]))), std::sqrt(to_third / (I[1] * (I[2] - I[1]))),
                 std::sqrt(to_first / (I[2] * (I[2] - I[0])))}};
  rate_ = std::sqrt((I[2] - I[1]) * to_first / (I[0] * I[1] * I[2]));
  modulus_ = std::sqrt((I[1] - I[0]) * to_third / ((I[2] - I[1]) * to_first));
  // dn is never negative, and Euler's equations stay as they are if two components change their signs. All rates change theirs
  // on axes that are left-handed in this order, and once more where the moments descend: then one component must do so, too.
  if (w[2] < 0) amplitude_[2] *= -1, amplitude_[0] *= -1;
  const bool left_handed = (axis_[1] - axis_[0] + 3) % 3 != 1, descending = I[0] > I[2];
  if (left_handed != descending) amplitude_[1] *= -1;
  phase_ = boost::math::ellint_1(modulus_, std::atan2(w[1] / amplitude_[1], w[0] / amplitude_[0]));
}

Vec<3> FreeTop::at(double t) const {
  double cn = 0, dn = 0;
  const double sn = boost::math::jacobi_elliptic(modulus_, rate_ * t + phase_, &cn, &dn);
  const Vec<3> w{{amplitude_[0] * cn, amplitude_[1] * sn, amplitude_[2] * dn}};
  Vec<3> spin;
  for (std::size_t n = 0; n < 3; ++n) spin[axis_[n]] = w[static_cast<int>(n)];
  return spin;
}

double FreeTop::period() const { return 4 * boost::math::ellint_1(modulus_) / std::abs(rate_); }

}  // namespace chute::theory
