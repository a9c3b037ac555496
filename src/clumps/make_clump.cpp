#include "clumps/make_clump.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "clumps/disc_union.hpp"

namespace chute::clumps {
namespace {

Eigen::Matrix3d matrix(const Matrix& m) {
  Eigen::Matrix3d out;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) out(i, j) = m[static_cast<std::size_t>(i)][j];
  return out;
}
Eigen::Vector3d vector(const Vec<3>& v) { return {v[0], v[1], v[2]}; }

/// Columns are the principal axes, right-handed. Axes that a form already has stay as they are: equal moments, as those of a
/// rod across, would else turn it by any angle.
Eigen::Matrix3d principal_axes(const Eigen::Matrix3d& inertia) {
  constexpr double none = 1e-12;  // of the trace: what rounding leaves of a product of inertia that is 0
  const Eigen::Matrix3d products = inertia - Eigen::Matrix3d(inertia.diagonal().asDiagonal());
  if (products.cwiseAbs().maxCoeff() <= none * inertia.trace()) return Eigen::Matrix3d::Identity();
  Eigen::Matrix3d axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia).eigenvectors();
  for (int k = 0; k < 2; ++k) {  // the solver leaves the sense open
    Eigen::Index largest = 0;
    axes.col(k).cwiseAbs().maxCoeff(&largest);
    if (axes(largest, k) < 0) axes.col(k) *= -1;
  }
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return axes;
}

/// Nearly equal moments are meant to be equal: those of a rod across differ by rounding.
void level(Vec<3>& gyration) {
  constexpr double same = 1e-12;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < i; ++j)
      if (std::abs(gyration[i] - gyration[j]) <= same * gyration[j]) gyration[i] = gyration[j];
}

/// A push along n at a member's surface passes through the member's centre `at`. The mass that it meets, 1/m_eff = 1/m +
/// (at × n)·I⁻¹(at × n), is least where the quadratic form of n is largest.
double lightest(const Clump<3>& clump) {
  double most = 0;
  for (const auto& member : clump.members) {
    Eigen::Matrix3d cross,
        inverse =
            Eigen::Vector3d(1 / clump.gyration[0], 1 / clump.gyration[1], 1 / clump.gyration[2]).asDiagonal();
    const auto& a = member.at;
    cross << 0, -a[2], a[1], a[2], 0, -a[0], -a[1], a[0], 0;
    const Eigen::Matrix3d form = cross.transpose() * inverse * cross;
    most = std::max(
        most, Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(form, Eigen::EigenvaluesOnly).eigenvalues()[2]);
  }
  return 1 / (1 + most);
}
double lightest(const Clump<2>& clump) {
  double most = 0;
  for (const auto& member : clump.members)
    most = std::max(most, dot(member.at, member.at) / clump.gyration[0]);
  return 1 / (1 + most);
}

template <int D>
Clump<D> sphere() {
  Clump<D> clump;
  clump.members = {{{}, 1}};
  for (int k = 0; k < turns<D>; ++k) clump.gyration[k] = 0.4, clump.ease[k] = 1;  // core/sphere.hpp
  return clump;
}

/// Radius of the disc that covers as much of the plane.
double covering_radius(const Clump<2>& clump) {
  std::vector<Disc> discs;
  for (const auto& member : clump.members) discs.push_back({member.at, member.radius});
  return std::sqrt(union_of(discs).area / std::numbers::pi);
}

}  // namespace

template <int D>
Clump<D> make_clump(std::span<const Sphere> spheres) {
  if (spheres.size() == 1) return sphere<D>();
  const auto solid = union_of(spheres);
  const double scale = 1 / std::cbrt(solid.volume * 3 / (4 * std::numbers::pi));
  const Vec<3> centre = solid.centre();
  const Eigen::Matrix3d inertia = scale * scale / solid.volume * matrix(solid.inertia());
  const Eigen::Matrix3d axes = D == 3 ? principal_axes(inertia) : Eigen::Matrix3d::Identity();
  const Eigen::Vector3d moments = (axes.transpose() * inertia * axes).diagonal();
  Clump<D> clump;
  for (const auto& s : spheres) {
    const Eigen::Vector3d at = scale * (axes.transpose() * vector(s.centre - centre));
    Member<D>& member = clump.members.emplace_back();
    for (int k = 0; k < D; ++k) member.at[k] = at[k];
    member.radius = scale * s.radius;
    clump.reach = std::max(clump.members.size() == 1 ? 0 : clump.reach, norm(member.at) + member.radius);
  }
  if constexpr (D == 2) {
    clump.gyration[0] = moments[2];
    clump.radius = covering_radius(clump);
  } else {
    clump.gyration = {{moments[0], moments[1], moments[2]}};
    level(clump.gyration);
    Eigen::Quaterniond q(axes);
    if (q.w() < 0) q.coeffs() *= -1;
    clump.written = {{q.w(), q.x(), q.y(), q.z()}};
  }
  for (int k = 0; k < turns<D>; ++k) clump.ease[k] = clump.mean_gyration() / clump.gyration[k];
  clump.lightest = lightest(clump);
  return clump;
}

template Clump<2> make_clump(std::span<const Sphere>);
template Clump<3> make_clump(std::span<const Sphere>);

}  // namespace chute::clumps
