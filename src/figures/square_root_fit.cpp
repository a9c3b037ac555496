#include "figures/square_root_fit.hpp"

#include <Eigen/Dense>
#include <boost/math/tools/minima.hpp>
#include <cassert>

namespace chute::figures {
namespace {

struct Line {
  double offset, slope, misfit;
};

/// Least squares of v over √(s − s_AB).
Line line_for(double s_AB, std::span<const double> s, std::span<const double> v) {
  using Column = Eigen::Map<const Eigen::VectorXd>;
  const auto n = static_cast<Eigen::Index>(s.size());
  Eigen::MatrixX2d basis(n, 2);
  basis << Eigen::VectorXd::Ones(n), (Column(s.data(), n).array() - s_AB).sqrt();
  const Column values(v.data(), n);
  const Eigen::Vector2d fit = basis.colPivHouseholderQr().solve(values);
  return {fit[0], fit[1], (values - basis * fit).squaredNorm()};
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
