// A drum: a circle in which discs are laid, and which turns between the shakes.
#include <catch2/catch.hpp>
#include <sstream>

#include "deposit.hpp"

using namespace chute;
using namespace chute::test;
using restructuring::Rain;

namespace {

constexpr Vec<2> middle{{3, 7}};

World<2> drum_of(double radius, double friction) {
  World<2> world;
  world.gravity[1] = -1;
  world.frame.dimensions = 2;
  Wall<2> wall;
  wall.point = middle;
  wall.outline = Cylinder<2>{{}, radius, 0};
  wall.surface.friction = friction;
  world.walls.push_back(wall);
  return world;
}

/// `count` discs with radii evenly within `spread` of a half, in a drum that turns.
restructuring::RestructuringEngine<2> turning(double radius, std::size_t count, double spread, double turn,
                                              double jolt = 0, bool mirrored = false) {
  auto world = drum_of(radius, 0.5);
  const double side = mirrored ? -1 : 1;
  for (std::size_t i = 0; i < count; ++i) {
    Random random(7, Purpose::sizes, i);
    const double r = 0.5 * (1 + spread * random.uniform(-1, 1));
    const double x = random.uniform(-0.9, 0.9) * radius, z = random.uniform(-0.4, 0.4) * radius;
    add_sphere<2>(world.grains, middle + Vec<2>{{side * x, z}}, r, true);
  }
  restructuring::RestructuringSetup<2> setup{world.surroundings()};
  setup.turn = side * turn, setup.jolt = jolt;
  return {world.grains, setup};
}

/// Where discs of radius ½ that fall at these places, one after the other, come to rest.
std::vector<Vec<2>> laid(double radius, double friction, const std::vector<Vec<2>>& from) {
  auto world = drum_of(radius, friction);
  for (const auto& place : from) add_sphere<2>(world.grains, middle + place, 0.5, true);
  restructuring::RestructuringEngine<2> engine(world.grains, {world.surroundings()});
  engine.advance_to(1);
  std::vector<Vec<2>> rest;
  for (std::size_t i = 0; i < from.size(); ++i) rest.push_back(engine.state().place(i) - middle);
  return rest;
}

void check_rests(const restructuring::RestructuringEngine<2>& engine, double radius, double friction) {
  const auto& grains = engine.state();
  for (std::size_t i = 0; i < grains.moving; ++i) {
    const Vec<2> off = grains.place(i) - middle;
    REQUIRE(norm(off) <= radius - grains.radius[i] + 1e-9);
    for (std::size_t j = 0; j < i; ++j)
      REQUIRE(norm(grains.place(i) - grains.place(j)) >= grains.radius[i] + grains.radius[j] - 1e-9);
    const auto supports = engine.supports(i);
    double left = 0, right = 0;
    bool held = false;
    for (const auto id : supports) {
      if (is_wall(id)) {
        REQUIRE(norm(off) == Approx(radius - grains.radius[i]).margin(1e-9));
        (off[0] < 0 ? left : right) += 1;
        held = std::abs(off[0]) <= -off[1] * friction + 1e-6;
        continue;
      }
      const auto j = static_cast<std::size_t>(id);
      const Vec<2> way = grains.place(j) - grains.place(i);
      REQUIRE(norm(way) == Approx(grains.radius[i] + grains.radius[j]).margin(1e-9));
      (way[0] < 0 ? left : right) += 1;
    }
    if (supports.size() == 1)
      REQUIRE(held);  // by the wall alone, where its friction allows
    else
      REQUIRE((supports.size() == 2 && left == 1 && right == 1));
  }
}

}  // namespace

TEST_CASE("a disc in an empty drum rolls down to where the wall's friction holds it") {
  constexpr double R = 10, rho = R - 0.5;
  const auto smooth = laid(R, 0, {{{4, 0}}});
  CHECK(smooth[0][0] == Approx(0).margin(1e-12));
  CHECK(smooth[0][1] == Approx(-rho));
  const double mu = 0.3, sine = mu / std::hypot(1, mu);
  for (const double side : {-1.0, 1.0}) {
    const auto steep = laid(R, mu, {{{side * 7, 2}}});  // beyond arctan μ: it rolls to there
    CHECK(steep[0][0] == Approx(side * rho * sine));
    CHECK(steep[0][1] == Approx(-rho * std::sqrt(1 - sine * sine)));
    const auto flat = laid(R, mu, {{{side * 2, 2}}});  // within: it stays where it fell
    CHECK(flat[0][0] == Approx(side * 2));
    CHECK(flat[0][1] == Approx(-std::sqrt(rho * rho - 4)));
  }
}

TEST_CASE("discs in a smooth drum lie in a row along the wall, each held by the one below it") {
  constexpr double R = 6, rho = R - 0.5;
  // Neighbours touch, so that each is 2 arcsin(½/ρ) farther along the wall.
  const auto rest = laid(R, 0, {{{0.4, -5}}, {{2.5, -4}}, {{4, -3}}, {{5, 0}}});
  for (std::size_t k = 0; k < rest.size(); ++k) {
    const double angle = static_cast<double>(k) * 2 * std::asin(0.5 / rho);
    CHECK(rest[k][0] == Approx(rho * std::sin(angle)).margin(1e-9));
    CHECK(rest[k][1] == Approx(-rho * std::cos(angle)));
  }
}

TEST_CASE("in a turning drum every disc lies within it, on two others or on the wall, without overlap") {
  for (const double jolt : {0.0, 0.3}) {
    auto engine = turning(10, 130, 0.4, 0.05, jolt);
    for (const int shakes : {1, 2, 10, 60}) {
      engine.advance_to(shakes);
      check_rests(engine, 10, 0.5);
    }
  }
  auto nearly_full = turning(6, 75, 0.2, 0.3);  // grains lie up to the overhanging wall
  nearly_full.advance_to(30);
  check_rests(nearly_full, 6, 0.5);
}

TEST_CASE("a drum that turns the other way from the mirrored start is its mirror image") {
  auto one = turning(8, 80, 0.4, 0.04), other = turning(8, 80, 0.4, 0.04, 0, true);
  one.advance_to(6), other.advance_to(6);
  for (std::size_t i = 0; i < 80; ++i) {
    const Vec<2> a = one.state().place(i) - middle, b = other.state().place(i) - middle;
    REQUIRE(a[0] == Approx(-b[0]).margin(1e-7));
    REQUIRE(a[1] == Approx(b[1]).margin(1e-7));
  }
  CHECK(told(one, "surface_angle") == Approx(-told(other, "surface_angle")));
  CHECK(one.state().orientation[0][3] == Approx(5 * 0.04));  // marks turn with the drum
}

// Radial segregation (Baumann, Jánosi & Wolf 1995): small grains stop on the slope, large ones roll on to its foot.
TEST_CASE("turning lifts the surface, and small discs gather in the middle") {
  auto still = turning(12, 220, 0.6, 0), turned = turning(12, 220, 0.6, 0.04);
  still.advance_to(20);
  CHECK(std::abs(told(still, "surface_angle")) < 0.25);
  CHECK(told(still, "core") == Approx(1).margin(0.12));
  double angle = 0, core = 0;
  constexpr int from = 200, looks = 40;
  for (int k = 0; k < looks; ++k) {
    turned.advance_to(from + 5 * k);
    angle += told(turned, "surface_angle") / looks, core += told(turned, "core") / looks;
  }
  CAPTURE(angle, core);
  CHECK(angle > 0.5);
  CHECK(angle < 1.2);
  CHECK(core < told(still, "core") - 0.1);
}

TEST_CASE("a drum without room stops the run with a reason") {
  auto engine = turning(4, 60, 0, 0.1);
  CHECK_THROWS_WITH(engine.advance_to(5), Catch::Contains("the drum is too full"));
}
