#pragma once
#include <array>
#include <cmath>

namespace chute {

/// A point or vector in D dimensions. A plain aggregate: the compiler takes it apart into scalars and so into
/// vector lanes, which Eigen's fixed-size types, with SIMD of their own, prevent in the loops over contacts.
template <int D>
struct Vec {
  std::array<double, D> c{};
  constexpr double& operator[](int k) { return c[static_cast<std::size_t>(k)]; }
  constexpr double operator[](int k) const { return c[static_cast<std::size_t>(k)]; }
  bool operator==(const Vec&) const = default;
};

template <int D>
constexpr Vec<D> operator+(Vec<D> a, const Vec<D>& b) {
  for (int k = 0; k < D; ++k) a[k] += b[k];
  return a;
}
template <int D>
constexpr Vec<D> operator-(Vec<D> a, const Vec<D>& b) {
  for (int k = 0; k < D; ++k) a[k] -= b[k];
  return a;
}
template <int D>
constexpr Vec<D> operator*(double s, Vec<D> a) {
  for (int k = 0; k < D; ++k) a[k] *= s;
  return a;
}
template <int D>
constexpr double dot(const Vec<D>& a, const Vec<D>& b) {
  double sum = 0;
  for (int k = 0; k < D; ++k) sum += a[k] * b[k];
  return sum;
}
template <int D>
double norm(const Vec<D>& a) {
  return std::sqrt(dot(a, a));
}
constexpr Vec<3> cross(const Vec<3>& a, const Vec<3>& b) {
  return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
}

}  // namespace chute
