// Walls of all shapes, moving and at rest.
#include <catch2/catch.hpp>

#include "few_grains.hpp"

using namespace chute;
using namespace chute::test;
using namespace chute::event;

namespace {

EventSetup<2> elastic_and_smooth() {
  EventSetup<2> setup;
  setup.contact = {laws::ConstantRestitution{1}, {.friction = 0, .beta = -1}};
  setup.tick = 0.01;
  return setup;
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

TEST_CASE("an elastic ball bounces off the end of a segment as off a point") {
  Grains<2> grains;
  add_ball<2>(grains, {{0.3, 2}}, {{0, -1}}, 0.5, 1, true);
  auto setup = elastic_and_smooth();
  setup.walls = {segment({{-3, 0}}, {{0, 0}})};
  EventEngine<2> engine(grains, setup);
  engine.advance_to(400);
  // n = (0.6, 0.8): v − 2 (v·n) n
  CHECK(engine.state().velocity[0][0] == Approx(0.96).epsilon(1e-9));
  CHECK(engine.state().velocity[1][0] == Approx(-1 + 2 * 0.64).epsilon(1e-9));
}

TEST_CASE("an elastic ball in a circle keeps its energy and its angular momentum") {
  Grains<2> grains;
  add_ball<2>(grains, {{1, 0.5}}, {{0.4, 1}}, 0.5, 1, true);
  auto setup = elastic_and_smooth();
  Wall<2> drum;
  drum.outline = Cylinder<2>{{}, 3, 0};
  setup.walls = {drum};
  EventEngine<2> engine(grains, setup);
  engine.advance_to(10000);
  const auto r = engine.state().place(0), v = engine.state().speed(0);
  CHECK(engine.work().collisions > 20);
  CHECK(r[0] * v[1] - r[1] * v[0] == Approx(1 * 1 - 0.5 * 0.4).epsilon(1e-9));
  CHECK(dot(v, v) == Approx(1.16).epsilon(1e-12));
}

TEST_CASE("a ball is thrown back by a wall that comes towards it, with twice its speed more") {
  Grains<2> grains;
  add_ball<2>(grains, {{0, 0}}, {{-1, 0}}, 0.5, 1, true);
  auto setup = elastic_and_smooth();
  setup.walls = {Wall<2>{{{-3, 0}}, {{1, 0}}}};
  setup.walls[0].motion.velocity = {{0.5, 0}};
  EventEngine<2> engine(grains, setup);
  engine.advance_to(300);
  CHECK(engine.state().velocity[0][0] == Approx(2));
  CHECK(engine.energy().wall_work == Approx(1.5));
}

TEST_CASE("rough grains in a drum that turns, with a paddle that shakes, keep their account") {
  Grains<2> grains;
  for (int k = 0; k < 9; ++k)
    add_ball<2>(grains, {{1.2 * (k % 3 - 1), 1.2 * (k / 3) - 1}}, {{0.3 * (k % 2), -0.2}}, 0.5, 1, true);
  EventSetup<2> setup;
  setup.contact = {laws::ConstantRestitution{0.8}, {.friction = 0.4, .beta = 0.2}};
  setup.contact_time = 1e-3;
  setup.gravity = {{0, -1}};
  setup.tick = 0.1;
  Wall<2> drum, paddle = segment({{-1, -3.3}}, {{1, -3.3}});
  drum.outline = Cylinder<2>{{}, 4, 1};
  drum.surface.friction = 0.8;
  paddle.motion.amplitude = 0.2, paddle.motion.frequency = 0.7;
  setup.walls = {drum, paddle};
  EventEngine<2> engine(grains, setup);
  engine.advance_to(200);
  const auto e = engine.energy();
  CHECK(std::abs(e.wall_work) > 0.1);
  CHECK(std::abs(e.residual()) < 1e-9 * (std::abs(e.wall_work) + e.normal_loss));
}

// What leaves a wall of temperature T carries, by its flux, T along the normal and T/2 along every other axis: in a box
// between two such walls a gas takes their temperature, whatever it began with.
TEST_CASE("between walls of one temperature a gas takes it") {
  constexpr double T = 2, side = 20;
  event::EventSetup<2> setup;
  setup.domain.length[0] = side;
  setup.contact = {laws::ConstantRestitution{1}, laws::Walton{0, -1}};
  setup.tick = 0.5;
  for (const double up : {1.0, -1.0}) {
    Wall<2> wall;
    wall.point[1] = up > 0 ? 0 : side;
    wall.normal[1] = up;
    wall.surface.temperature = T;
    setup.walls.push_back(wall);
  }
  Grains<2> grains;
  for (int i = 0; i < 64; ++i) {
    Random random(4, Purpose::start, static_cast<std::uint64_t>(i));
    grains.add({{1.25 + 2.5 * (i % 8), 1.25 + 2.5 * (i / 8)}}, 0.5, 1, 0.1, true);
    for (auto& v : grains.velocity) v.back() = 0.3 * random.normal();
  }
  event::EventEngine<2> engine(grains, setup);
  engine.advance_to(200);
  double mean = 0;
  constexpr int looks = 400;
  for (int k = 1; k <= looks; ++k) {
    engine.advance_to(200 + 10 * k);
    mean += engine.energy().translation / 64 / looks;
  }
  CHECK(mean == Approx(T).epsilon(0.03));
  CHECK(engine.energy().residual() == Approx(0).margin(1e-8 * engine.energy().wall_work));
}
