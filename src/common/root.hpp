#pragma once
#include <boost/math/tools/toms748_solve.hpp>
#include <cstdint>
#include <limits>

namespace chute {

/// The place between low and high where a function changes its sign, to the last bits (Boost's TOMS 748). Its signs at
/// the ends must differ.
template <class Function>
double root_between(const Function& f, double low, double high) {
  const boost::math::tools::eps_tolerance<double> close(std::numeric_limits<double>::digits - 2);
  std::uintmax_t most = 200;  // evaluations; it takes about ten
  const auto bracket = boost::math::tools::toms748_solve(f, low, high, close, most);
  return (bracket.first + bracket.second) / 2;
}

}  // namespace chute
