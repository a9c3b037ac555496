#include "common/root.hpp"

#include <boost/math/tools/toms748_solve.hpp>
#include <cstdint>
#include <limits>

namespace chute {

double root_between(const std::function<double(double)>& f, double low, double high) {
  const boost::math::tools::eps_tolerance<double> close(std::numeric_limits<double>::digits - 2);
  std::uintmax_t most = 200;  // evaluations; it takes about ten
  const auto bracket = boost::math::tools::toms748_solve(f, low, high, close, most);
  return (bracket.first + bracket.second) / 2;
}

}  // namespace chute
