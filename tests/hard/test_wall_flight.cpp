// When a grain in flight meets a wall: closed forms, and for all shapes a dumb search with tiny steps.
#include <catch2/catch.hpp>
#include <cmath>

#include "core/random.hpp"
#include "engines/hard/first_contact.hpp"
#include "engines/hard/wall_flight.hpp"

using namespace chute;
using namespace chute::hard;

namespace {

template <int D>
Flight<D> flying(Vec<D> place, Vec<D> velocity, Vec<D> gravity, double time, double radius) {
  Flight<D> f;
  f.place = place, f.velocity = velocity, f.gravity = gravity, f.time = time, f.radius = radius;
  return f;
}

/// The first time at which the height above touching falls to 0, by looking very often.
template <int D>
double by_looking(const Flight<D>& flight, const Wall<D>& wall, const Domain<D>& domain, double until,
                  int looks) {
  const auto height = [&](double t) {
    return wall.nearest(flight.place_at(t), t, domain).height - flight.radius;
  };
  for (int k = 1; k <= looks; ++k) {
    double low = until * (k - 1) / looks, high = until * k / looks;
    if (!(height(high) <= 0)) continue;
    for (int b = 0; b < 60; ++b) (height((low + high) / 2) <= 0 ? high : low) = (low + high) / 2;
    return high;
  }
  return never;
}

Wall<2> segment(Vec<2> from, Vec<2> to) {
  Wall<2> wall;
  const Vec<2> half = 0.5 * (to - from);
  wall.point = from + half;
  wall.normal = (1 / norm(half)) * Vec<2>{{-half[1], half[0]}};
  wall.outline = Segment{half};
  return wall;
}

}  // namespace

TEST_CASE("a grain that falls meets a plane, a segment's middle and its end when the closed forms say") {
  const Flight<2> falls = flying<2>({{0, 3}}, {}, {{0, -1}}, 2.0, 0.5);
  const Domain<2> open;
  const Wall<2> plane{{{7, 0}}, {{0, 1}}};
  const double t = 2 + std::sqrt(2 * 2.5);
  CHECK(first_contact_with_wall(falls, plane, open) == Approx(t).epsilon(1e-13));
  CHECK(first_contact_with_wall(falls, plane, open, t - 1e-6) == never);
  CHECK(first_contact_with_wall(falls, segment({{-1, 0}}, {{1, 0}}), open) == Approx(t).epsilon(1e-12));
  // 0.3 beside the end: the centre is √(0.5² − 0.3²) = 0.4 above it
  CHECK(first_contact_with_wall(falls, segment({{0.3, 0}}, {{5, 0}}), open) ==
        Approx(2 + std::sqrt(2 * 2.6)).epsilon(1e-12));
  CHECK(first_contact_with_wall(falls, segment({{0.6, 0}}, {{5, 0}}), open, 1e6) == never);
}

TEST_CASE("a grain inside a cylinder meets it where a straight line leaves the inner circle") {
  Wall<3> drum;
  drum.outline = Cylinder<3>{{{0, 1, 0}}, 3, 0};
  const Flight<3> flies = flying<3>({{0.5, 0, 0}}, {{1, 4, 1}}, {}, 0, 0.5);
  // |(0.5 + t, t)| = 2.5: 2 t² + t + 0.25 − 6.25 = 0
  CHECK(first_contact_with_wall(flies, drum, {}) == Approx((-1 + std::sqrt(1 + 48.0)) / 4).epsilon(1e-12));
}

TEST_CASE("whatever the shape and however it moves, the first contact is that of a dumb search") {
  Domain<2> open, periodic;
  periodic.length[0] = 6;
  int met = 0, missed = 0;
  for (std::uint64_t k = 0; k < 300; ++k) {
    Random random(3, Purpose::engine, k);
    const auto u = [&](double a) { return random.uniform(-a, a); };
    Flight<2> flight = flying<2>({{u(1.5), u(1.5)}}, {{u(3), u(3)}}, {{u(1), u(1)}}, 0, 0.3);
    Wall<2> wall;
    switch (k % 3) {
      case 0:
        wall.outline = Cylinder<2>{{}, 3, 0};
        break;
      case 1:
        wall = segment({{u(2), -2.5}}, {{u(2), -4}});
        break;
      default:
        wall = Wall<2>{{{0, -3}}, {{0.6, 0.8}}};
    }
    if (k % 2) wall.motion.velocity = {{u(0.5), u(0.5)}};
    if (k % 3 != 0 && k % 4 > 1) wall.motion.amplitude = 0.3, wall.motion.frequency = 0.8;
    const Domain<2>& domain = k % 3 == 1 ? periodic : open;
    const double expected = by_looking(flight, wall, domain, 5, 40000),
                 found = first_contact_with_wall(flight, wall, domain, 5);
    CAPTURE(k, expected, found);
    ++(expected == never ? missed : met);
    if (expected == never) {
      CHECK(found == never);
    } else {
      CHECK(found == Approx(expected).margin(1e-9));
    }
  }
  CHECK(met > 100);
  CHECK(missed > 20);
}

TEST_CASE("in space, faces, edges and corners of a polygon are met as a dumb search finds them") {
  Wall<3> plate;
  plate.outline = Polygon{{{{-1, -1, 0}}, {{1, -1, 0}}, {{1, 1, 0}}, {{-1, 1, 0}}}};
  plate.normal = plate.bounded()->upright();
  int met = 0;
  for (std::uint64_t k = 0; k < 200; ++k) {
    Random random(4, Purpose::engine, k);
    const auto u = [&](double a) { return random.uniform(-a, a); };
    const Flight<3> flight = flying<3>({{u(2), u(2), 2}}, {{u(1), u(1), -1}}, {{0, 0, -0.5}}, 0, 0.4);
    const double expected = by_looking<3>(flight, plate, {}, 4, 40000),
                 found = first_contact_with_wall(flight, plate, {}, 4);
    CAPTURE(k);
    met += expected < never;
    if (expected == never) {
      CHECK(found == never);
    } else {
      CHECK(found == Approx(expected).margin(1e-9));
    }
  }
  CHECK(met > 60);
}

TEST_CASE("a grain that parts from a wall, overlapping by rounding, does not meet it again at once") {
  Wall<2> shaken{{{0, 0}}, {{0, 1}}};
  shaken.motion.amplitude = 1e-5, shaken.motion.frequency = 1;
  const std::vector<Wall<2>> walls{Wall<2>{{{0, 0}}, {{0, 1}}}, segment({{-9, 0}}, {{9, 0}}), shaken};
  const Flight<2> up = flying<2>({{0, 0.5 * (1 - 1e-15)}}, {{0, 1}}, {{0, -1}}, 0, 0.5);
  for (const auto& wall : walls) CHECK(first_contact_with_wall(up, wall, {}) == Approx(2).margin(0.02));
  const Flight<2> down = flying<2>({{0, 0.5 * (1 - 1e-15)}}, {{0, -1}}, {{0, -1}}, 0, 0.5);
  for (const auto& wall : walls) CHECK(first_contact_with_wall(down, wall, {}) == 0);
}
