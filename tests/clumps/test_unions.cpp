#include <boost/random/mersenne_twister.hpp>
#include <boost/random/uniform_01.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "clumps/disc_union.hpp"
#include "clumps/sphere_union.hpp"

using namespace chute;
using namespace chute::clumps;

namespace {

constexpr double pi = std::numbers::pi;

/// The slow twin: points thrown at a box, each counted once if any of the spheres holds it.
SolidMoments thrown(const std::vector<Sphere>& spheres, double box, std::int64_t points) {
  boost::random::mt19937_64 generator(7);
  boost::random::uniform_01<double> uniform;
  SolidMoments m;
  const double weight = 8 * box * box * box / static_cast<double>(points);
  for (std::int64_t n = 0; n < points; ++n) {
    Vec<3> r;
    for (int k = 0; k < 3; ++k) r[k] = box * (2 * uniform(generator) - 1);
    bool inside = false;
    for (const auto& s : spheres) inside = inside || dot(r - s.centre, r - s.centre) < s.radius * s.radius;
    if (!inside) continue;
    m.volume += weight;
    m.first = m.first + weight * r;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) m.second[static_cast<std::size_t>(i)][j] += weight * r[i] * r[j];
  }
  return m;
}

double ball(double R) { return 4 * pi / 3 * R * R * R; }
/// Two spheres of radii a and b whose centres are d apart share a lens.
double lens(double a, double b, double d) {
  return pi * (a + b - d) * (a + b - d) * (d * d + 2 * d * (a + b) - 3 * (a - b) * (a - b)) / (12 * d);
}
/// ∫ z² dV of a sphere of radius R at the origin between two heights, and ∫ x² dV.
double cut_zz(double R, double low, double high) {
  const auto at = [&](double z) { return pi * (R * R * z * z * z / 3 - std::pow(z, 5) / 5); };
  return at(high) - at(low);
}
double cut_xx(double R, double low, double high) {
  const auto at = [&](double z) {
    return pi / 4 * (std::pow(R, 4) * z - 2 * R * R * z * z * z / 3 + std::pow(z, 5) / 5);
  };
  return at(high) - at(low);
}
double cut_volume(double R, double low, double high) {
  const auto at = [&](double z) { return pi * (R * R * z - z * z * z / 3); };
  return at(high) - at(low);
}
double cut_z(double R, double low, double high) {
  const auto at = [&](double z) { return pi * (R * R * z * z / 2 - std::pow(z, 4) / 4); };
  return at(high) - at(low);
}

}  // namespace

TEST_CASE("a disc alone has its moments, wherever it lies") {
  const Disc disc{{{0.7, -1.3}}, 0.6};
  const auto m = union_of(std::vector{disc});
  const double area = pi * 0.36;
  CHECK(m.area == Approx(area).epsilon(1e-14));
  CHECK(m.first[0] == Approx(0.7 * area).epsilon(1e-14));
  CHECK(m.first[1] == Approx(-1.3 * area).epsilon(1e-14));
  CHECK(m.xx == Approx(area * (0.36 / 4 + 0.49)).epsilon(1e-14));
  CHECK(m.yy == Approx(area * (0.36 / 4 + 1.69)).epsilon(1e-14));
  CHECK(m.xy == Approx(-area * 0.7 * 1.3).epsilon(1e-14));
}

TEST_CASE("two discs are both less their lens; one inside another is none; the same twice is one") {
  const double a = 0.5, b = 0.3;
  for (const double d : {0.21, 0.35, 0.6, 0.79, 0.7999999, 0.2000001}) {
    const double angle_a = std::acos((d * d + a * a - b * b) / (2 * d * a)),
                 angle_b = std::acos((d * d + b * b - a * a) / (2 * d * b));
    const double shared =
        a * a * (angle_a - std::sin(2 * angle_a) / 2) + b * b * (angle_b - std::sin(2 * angle_b) / 2);
    const auto m = union_of(std::vector<Disc>{{{{1, 2}}, a}, {{{1 + d * 0.6, 2 - d * 0.8}}, b}});
    CHECK(m.area == Approx(pi * (a * a + b * b) - shared).epsilon(1e-12));
  }
  const auto alone = union_of(std::vector<Disc>{{{{1, 2}}, a}});
  for (const auto& other : {Disc{{{1.05, 2.1}}, b}, Disc{{{1, 2}}, a}, Disc{{{1, 2}}, b}})
    for (const bool swapped : {false, true}) {
      std::vector<Disc> both{{{{1, 2}}, a}, other};
      if (swapped) std::swap(both[0], both[1]);
      const auto m = union_of(both);
      CHECK(m.area == alone.area);
      CHECK(m.xx == alone.xx);
      CHECK(m.xy == alone.xy);
    }
}

TEST_CASE("a sphere alone, two apart, and one within another") {
  const auto one = union_of(std::vector<Sphere>{{{{0.3, -2, 5}}, 0.7}});
  CHECK(one.volume == Approx(ball(0.7)).epsilon(1e-13));
  CHECK(one.centre()[2] == Approx(5).epsilon(1e-13));
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      CHECK(one.inertia()[static_cast<std::size_t>(i)][j] ==
            Approx(i == j ? 0.4 * ball(0.7) * 0.49 : 0).epsilon(1e-12).margin(1e-12));
  const auto two = union_of(std::vector<Sphere>{{{{-1, 0, 0}}, 0.5}, {{{1, 0.5, 0.2}}, 0.8}});
  CHECK(two.volume == Approx(ball(0.5) + ball(0.8)).epsilon(1e-13));
  CHECK(two.first[0] == Approx(-ball(0.5) + ball(0.8)).epsilon(1e-12));
  CHECK(two.second[0][1] == Approx(0.5 * ball(0.8)).epsilon(1e-12));
  CHECK(two.second[1][2] == Approx(0.1 * ball(0.8)).epsilon(1e-12));
  CHECK(two.second[0][0] == Approx(ball(0.5) * (1 + 0.05) + ball(0.8) * (1 + 0.64 / 5)).epsilon(1e-12));
  const auto within = union_of(std::vector<Sphere>{{{{0, 0, 0}}, 1}, {{{0.2, 0.3, -0.1}}, 0.5}});
  CHECK(within.volume == Approx(ball(1)).epsilon(1e-13));
  CHECK(within.inertia()[2][2] == Approx(0.4 * ball(1)).epsilon(1e-12));
}

TEST_CASE("two spheres that overlap, along any direction") {
  const double a = 0.5, b = 0.4, d = 0.6;
  // Along z: below the plane in which they cross the first, above it the second.
  const double plane = (d * d + a * a - b * b) / (2 * d);
  const double volume = ball(a) + ball(b) - lens(a, b, d);
  const double first = cut_z(a, -a, plane) + cut_z(b, plane - d, b) + d * cut_volume(b, plane - d, b);
  const double zz = cut_zz(a, -a, plane) + cut_zz(b, plane - d, b) + 2 * d * cut_z(b, plane - d, b) +
                    d * d * cut_volume(b, plane - d, b);
  const double xx = cut_xx(a, -a, plane) + cut_xx(b, plane - d, b);
  CHECK(volume == Approx(cut_volume(a, -a, plane) + cut_volume(b, plane - d, b)).epsilon(1e-14));
  const double along = 2 * xx, across = xx + zz - first * first / volume;  // moments of inertia
  for (const auto& direction : {Vec<3>{{0, 0, 1}}, Vec<3>{{1, 0, 0}}, Vec<3>{{2.0 / 3, -1.0 / 3, 2.0 / 3}}}) {
    const Vec<3> from{{0.4, 0.1, -0.3}};
    const auto m = union_of(std::vector<Sphere>{{from, a}, {from + d * direction, b}});
    CHECK(m.volume == Approx(volume).epsilon(1e-12));
    for (int k = 0; k < 3; ++k)
      CHECK(m.centre()[k] == Approx(from[k] + first / volume * direction[k]).epsilon(1e-12).margin(1e-13));
    const auto inertia = m.inertia();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        CHECK(inertia[static_cast<std::size_t>(i)][j] ==
              Approx((i == j ? across : 0) + (along - across) * direction[i] * direction[j])
                  .epsilon(1e-12)
                  .margin(1e-13));
  }
}

TEST_CASE("what the union comes to does not depend on how it is cut into sections") {
  // Four spheres of which three share a point, so that no formula for pairs holds.
  const std::vector<Sphere> spheres{
      {{{0, 0, 0}}, 0.5}, {{{0.4, 0.1, 0}}, 0.45}, {{{0.15, 0.4, 0.1}}, 0.4}, {{{-0.2, 0.2, 0.5}}, 0.35}};
  const auto m = union_of(spheres);
  auto turned = spheres;  // x becomes y, y becomes z, z becomes x
  for (auto& s : turned) s.centre = {{s.centre[2], s.centre[0], s.centre[1]}};
  const auto other = union_of(turned);
  CHECK(other.volume == Approx(m.volume).epsilon(1e-12));
  for (int i = 0; i < 3; ++i) {
    CHECK(other.first[(i + 1) % 3] == Approx(m.first[i]).epsilon(1e-12));
    for (int j = 0; j < 3; ++j)
      CHECK(other.second[static_cast<std::size_t>((i + 1) % 3)][(j + 1) % 3] ==
            Approx(m.second[static_cast<std::size_t>(i)][j]).epsilon(1e-11).margin(1e-13));
  }
  // and points thrown at it tell the same, within three of their standard errors
  constexpr std::int64_t points = 1000000;
  const auto slow = thrown(spheres, 1, points);
  const double part = m.volume / 8, error = 8 * std::sqrt(part * (1 - part) / static_cast<double>(points));
  CHECK(std::abs(slow.volume - m.volume) < 3 * error);
  for (int i = 0; i < 3; ++i) {
    CHECK(std::abs(slow.first[i] - m.first[i]) < 3 * error);
    for (int j = 0; j < 3; ++j)
      CHECK(std::abs(slow.second[static_cast<std::size_t>(i)][j] - m.second[static_cast<std::size_t>(i)][j]) <
            3 * error);
  }
}
