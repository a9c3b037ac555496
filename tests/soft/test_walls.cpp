// Walls of all shapes, moving and at rest, and inclines that tilt.
#include <catch2/catch.hpp>

#include "two_grains.hpp"

namespace walls_tests {
using namespace chute;
using namespace chute::test;
using soft::SoftEngine;

namespace {

constexpr double stiffness = 1e5, e_n = 0.6, dt = 1e-4;

laws::ContactLaws contact(double friction, double restitution = e_n) {
  return {laws::SpringDashpot::from_restitution(stiffness, restitution, true),
          laws::RegularisedCoulomb{300, friction, laws::MassScaling::none, {}}};
}

template <int D>
soft::SoftSetup<D> under_gravity(double friction) {
  auto made = setup<D>(contact(friction), dt, 1);
  made.gravity[D - 1] = -1;
  return made;
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

TEST_CASE(
    "a column between two side walls weighs on the floor what it weighs, on a plane, a segment, and in space a plate") {
  const auto load = [](auto setup, auto floor, double side) {
    constexpr int D = std::tuple_size_v<decltype(setup.gravity.c)>;
    Grains<D> grains;
    for (int k = 0; k < 5; ++k) {
      Vec<D> place{};
      place[D - 1] = 0.5 + 1.0001 * k;
      add_ball<D>(grains, place, {}, 0.5, 1);
    }
    setup.walls = {floor};
    for (int k = 0; k + 1 < D; ++k)
      for (const double s : {-1.0, 1.0}) {
        Wall<D>& wall = setup.walls.emplace_back();
        wall.point[k] = s * side, wall.normal[k] = -s;
      }
    SoftEngine<D> engine(grains, setup);
    engine.advance_to(100000);
    double sum = 0;
    for (const auto& c : engine.contacts())
      if (c.b == wall_id(0)) sum -= c.force[D - 1];
    CHECK(engine.energy().translation < 1e-6);
    return sum;
  };
  Wall<2> plane;
  plane.normal = {{0, 1}};
  CHECK(load(under_gravity<2>(0.3), plane, 0.52) == Approx(5).epsilon(1e-3));
  CHECK(load(under_gravity<2>(0.3), segment({{-1, 0}}, {{1, 0}}), 0.52) == Approx(5).epsilon(1e-3));
  Wall<3> plate;
  plate.outline = Polygon{{{{-1, -1, 0}}, {{1, -1, 0}}, {{1, 1, 0}}, {{-1, 1, 0}}}};
  plate.normal = {{0, 0, 1}};
  CHECK(load(under_gravity<3>(0.3), plate, 0.52) == Approx(5).epsilon(1e-3));
}

TEST_CASE("a grain on a floor that shakes is thrown when A w^2 > g, and stays when it is less") {
  for (const double strength : {0.8, 1.5}) {
    const double A = 0.05, f = std::sqrt(strength / A) / (2 * M_PI);
    Grains<2> grains;
    add_ball<2>(grains, {{0, 0.5}}, {}, 0.5, 1);
    auto setup = under_gravity<2>(0.3);
    setup.walls.resize(1);
    setup.walls[0].normal = {{0, 1}};
    setup.walls[0].motion.amplitude = A, setup.walls[0].motion.frequency = f;
    SoftEngine<2> engine(grains, setup);
    double highest = 0;
    for (std::int64_t k = 1; k < 1000; ++k) {
      engine.advance_to(100 * k);
      const double gap = engine.grains().position[1][0] - 0.5 - A * std::sin(2 * M_PI * f * engine.time());
      if (k > 200) highest = std::max(highest, gap);
    }
    CAPTURE(strength, highest);
    CHECK((highest > 0.01) == (strength > 1));
    const auto e = engine.energy();
    CHECK(std::abs(e.residual()) < 1e-3 * std::abs(e.normal_loss + e.shear_loss + 0.1));
  }
}

TEST_CASE("a ball in a drum that turns, and one between walls that shake, keep their account") {
  Grains<2> grains;
  add_ball<2>(grains, {{0, 0}}, {{1, 0}}, 0.5, 1);
  auto setup = under_gravity<2>(0.5);
  Wall<2> drum;
  drum.outline = Cylinder<2>{{}, 3, 2};
  setup.walls = {drum};
  SoftEngine<2> turned(grains, setup);
  turned.advance_to(200000);
  const auto e = turned.energy();
  CHECK(e.wall_work > 1);
  CHECK(std::abs(e.residual()) < 2e-3 * e.wall_work);
  CHECK(norm(turned.state().place(0)) < 2.51);
  CHECK(turned.state().spin[0][0] > 0);  // anticlockwise, as the drum

  Wall<2> left = segment({{-2, -5}}, {{-2, 5}}), right = segment({{2, 5}}, {{2, -5}});
  left.motion.amplitude = right.motion.amplitude = 0.2;
  left.motion.frequency = 0.5, right.motion.frequency = 0.7;
  setup.gravity = {};
  setup.walls = {left, right};
  SoftEngine<2> shaken(grains, setup);
  shaken.advance_to(200000);
  const auto s = shaken.energy();
  CHECK(std::abs(s.wall_work) > 0.1);
  CHECK(std::abs(s.residual()) < 2e-3 * s.normal_loss);
}

TEST_CASE("a wall has its own restitution and friction") {
  Grains<2> grains;
  add_ball<2>(grains, {{0, 0.5}}, {{3, -1}}, 0.5, 1);
  auto setup = under_gravity<2>(0.5);
  setup.gravity = {};
  setup.walls.resize(1);
  setup.walls[0].normal = {{0, 1}};
  setup.wall_laws = {contact(0.1, 0.9)};
  SoftEngine<2> engine(grains, setup);
  engine.advance_to(5000);
  CHECK(engine.state().velocity[1][0] == Approx(0.9).epsilon(1e-3));
  CHECK(engine.state().velocity[0][0] ==
        Approx(3 - 0.1 * 1.9).epsilon(2e-3));  // it slides: Δv_s = μ (1 + e_n) v_n
}

TEST_CASE("a grain on a smooth plane that tilts follows gravity, which does the work that it has") {
  Grains<2> grains;
  add_ball<2>(grains, {{0, 0.5}}, {}, 0.5, 1);
  auto setup = under_gravity<2>(0);
  setup.walls.resize(1);
  setup.walls[0].normal = {{0, 1}};
  setup.tilt = Tilt{0, 0.6, 0.1, 1};
  SoftEngine<2> engine(grains, setup);
  engine.advance_to(80000);  // 6 to tilt, 2 more
  const double v = (1 - std::cos(0.6)) / 0.1 + 2 * std::sin(0.6);
  CHECK(engine.state().velocity[0][0] == Approx(v).epsilon(1e-4));
  const auto e = engine.energy();
  CHECK(e.gravity_work == Approx(v * v / 2).epsilon(1e-3));
  CHECK(std::abs(e.residual()) < 2e-3 * e.gravity_work);
}

TEST_CASE(
    "friction that is integrated over some steps is so with walls, too: a ball that slips comes to roll") {
  const auto mu = 10.0, stiff = 1e5;  // γ_s dt 7/(2 m) = 35: a step of the slip as it is would throw it about
  for (const bool own : {false, true}) {
    Grains<2> grains;
    add_ball<2>(grains, {{0, 0.5}}, {{1, 0}}, 0.5, 1);
    auto made = under_gravity<2>(mu);
    laws::ContactLaws implicit = contact(mu);
    implicit.shear = laws::RegularisedCoulomb{stiff, mu, laws::MassScaling::none, 12};
    if (own)
      made.wall_laws = {implicit};
    else
      made.laws = implicit;
    made.walls.resize(1);
    made.walls[0].normal = {{0, 1}};
    SoftEngine<2> engine(grains, made);
    engine.advance_to(20000);
    // v = 5/7 of what it was, whatever the friction does in between
    CHECK(engine.state().velocity[0][0] == Approx(5.0 / 7).epsilon(1e-3));
    CHECK(engine.state().spin[0][0] == Approx(-10.0 / 7).epsilon(1e-3));
  }
}

}  // namespace walls_tests
