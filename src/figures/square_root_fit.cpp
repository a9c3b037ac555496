#include "figures/square_root_fit.hpp"

#include <boost/math/tools/minima.hpp>
#include <cassert>
#include <cmath>

namespace chute::figures {
namespace {

struct Line {
  double offset, slope, misfit;
};

/// Least squares of v over √(s − s_AB).
Line line_for(double s_AB, std::span<const double> s, std::span<const double> v) {
  double n = 0, X = 0, V = 0, XX = 0, XV = 0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    const double x = std::sqrt(s[i] - s_AB);
    n += 1, X += x, V += v[i], XX += x * x, XV += x * v[i];
  }
  Line line{};
  line.slope = (n * XV - X * V) / (n * XX - X * X);
  line.offset = (V - line.slope * X) / n;
  for (std::size_t i = 0; i < s.size(); ++i) {
    const double d = v[i] - line.offset - line.slope * std::sqrt(s[i] - s_AB);
    line.misfit += d * d;
  }
  return line;
}

}  // namespace

SquareRootFit fit_square_root(std::span<const double> s, std::span<const double> v) {
  assert(s.size() == v.size() && s.size() >= 3);
  const double width = s.back() - s.front();
  const auto misfit = [&](double s_AB) { return line_for(s_AB, s, v).misfit; };
  constexpr int bits = 40;
  const double s_AB = boost::math::tools::brent_find_minima(misfit, s.front() - width, s.front(), bits).first;
  const auto line = line_for(s_AB, s, v);
  return {line.offset, line.slope, s_AB};
}

}  // namespace chute::figures
