#include "clumps/sphere_union.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "clumps/disc_union.hpp"

namespace chute::clumps {
namespace {

/// Volume, the first moments, and those of second order: xx, yy, zz, yz, xz, xy.
using Sums = std::array<double, 10>;

class Sections {
 public:
  explicit Sections(std::span<const Sphere> spheres) : spheres_(spheres) {
    for (const auto& s : spheres_) {
      extent_ = std::max(extent_, norm(s.centre) + s.radius);
      volume_ += 4 * std::numbers::pi / 3 * s.radius * s.radius * s.radius;
    }
  }

  Sums integrate() const {
    const auto cuts = places_of_cuts();
    Sums sum{};
    for (std::size_t k = 1; k < cuts.size(); ++k) {
      const Sums part = integrate(cuts[k - 1], cuts[k], 0);
      for (std::size_t n = 0; n < sum.size(); ++n) sum[n] += part[n];
    }
    return sum;
  }

 private:
  std::span<const Sphere> spheres_;
  double extent_ = 0, volume_ = 0;  // what integrals are at most: volume, times the extent or its square

  Sums at(double z) const {
    std::vector<Disc> discs;
    for (const auto& s : spheres_) {
      const double h = z - s.centre[2], square = (s.radius - h) * (s.radius + h);
      if (square > 0) discs.push_back({{{s.centre[0], s.centre[1]}}, std::sqrt(square)});
    }
    const auto m = union_of(discs);
    return {m.area, m.first[0],     m.first[1],     z * m.area,     m.xx,
            m.yy,   z * z * m.area, z * m.first[1], z * m.first[0], m.xy};
  }

  /// Heights at which the section changes its kind: spheres begin and end, and so do the circles in which two of them cross.
  /// (Where three cross in a point the area's second derivative jumps; halving finds those.)
  std::vector<double> places_of_cuts() const {
    std::vector<double> cuts;
    for (std::size_t i = 0; i < spheres_.size(); ++i) {
      const auto& a = spheres_[i];
      cuts.push_back(a.centre[2] - a.radius);
      cuts.push_back(a.centre[2] + a.radius);
      for (std::size_t j = 0; j < i; ++j) {
        const auto& b = spheres_[j];
        const Vec<3> way = b.centre - a.centre;
        const double d = norm(way);
        if (d >= a.radius + b.radius || d <= std::abs(a.radius - b.radius)) continue;
        const double x = (d * d + (a.radius - b.radius) * (a.radius + b.radius)) / (2 * d);
        const double circle = std::sqrt(std::max(0.0, a.radius * a.radius - x * x));
        const double upright = way[2] / d, tilt = std::sqrt(std::max(0.0, 1 - upright * upright));
        cuts.push_back(a.centre[2] + x * upright - circle * tilt);
        cuts.push_back(a.centre[2] + x * upright + circle * tilt);
      }
    }
    std::sort(cuts.begin(), cuts.end());
    return cuts;
  }

  /// With z = middle + half sin φ, in which what begins or ends as a root of the height is smooth.
  template <unsigned Points>
  Sums gauss(double from, double to) const {
    const double middle = (from + to) / 2, half = (to - from) / 2, quarter = std::numbers::pi / 2;
    Sums sum{};
    const auto add = [&](double u, double weight) {
      const Sums s = at(middle + half * std::sin(quarter * u));
      for (std::size_t n = 0; n < sum.size(); ++n)
        sum[n] += weight * half * quarter * std::cos(quarter * u) * s[n];
    };
    using Rule = boost::math::quadrature::gauss<double, Points>;
    for (std::size_t k = 0; k < Rule::abscissa().size(); ++k) {
      const double u = Rule::abscissa()[k], weight = Rule::weights()[k];
      add(u, weight);
      if (u != 0) add(-u, weight);
    }
    return sum;
  }

  Sums integrate(double from, double to, int depth) const {
    constexpr double tolerance =
        1e-14;  // of what the whole integral can be at most; rounding is a tenth of it
    constexpr int deepest = 16;
    if (!(to - from > 1e-14 * extent_)) return {};
    const Sums rough = gauss<15>(from, to), fine = gauss<30>(from, to);
    double off = 0;
    for (std::size_t n = 0; n < fine.size(); ++n) {
      const double most = volume_ * (n == 0 ? 1 : n < 4 ? extent_ : extent_ * extent_);
      off = std::max(off, std::abs(fine[n] - rough[n]) / most);
    }
    if (off <= tolerance || depth == deepest) return fine;
    const double middle = (from + to) / 2;
    Sums sum = integrate(from, middle, depth + 1);
    const Sums rest = integrate(middle, to, depth + 1);
    for (std::size_t n = 0; n < sum.size(); ++n) sum[n] += rest[n];
    return sum;
  }
};

}  // namespace

Matrix SolidMoments::inertia() const {
  Matrix inertia;
  double trace = 0;
  const Vec<3> c = centre();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const auto row = static_cast<std::size_t>(i);
      inertia[row][j] = volume * c[i] * c[j] - second[row][j];
      if (i == j) trace -= inertia[row][j];
    }
  for (int i = 0; i < 3; ++i) inertia[static_cast<std::size_t>(i)][i] += trace;
  return inertia;
}

SolidMoments union_of(std::span<const Sphere> spheres) {
  // About a place within, for what cancels would otherwise grow with the distance from the origin.
  Vec<3> origin{};
  for (const auto& s : spheres) origin = origin + (1 / static_cast<double>(spheres.size())) * s.centre;
  std::vector<Sphere> near(spheres.begin(), spheres.end());
  for (auto& s : near) s.centre = s.centre - origin;
  const Sums m = Sections(near).integrate();
  SolidMoments moments{
      m[0], {{m[1], m[2], m[3]}}, {{{{m[4], m[9], m[8]}}, {{m[9], m[5], m[7]}}, {{m[8], m[7], m[6]}}}}};
  const Vec<3> about = moments.first;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      moments.second[static_cast<std::size_t>(i)][j] +=
          about[i] * origin[j] + origin[i] * about[j] + moments.volume * origin[i] * origin[j];
  moments.first = about + moments.volume * origin;
  return moments;
}

}  // namespace chute::clumps
