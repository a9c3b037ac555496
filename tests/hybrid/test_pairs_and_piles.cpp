// One pair is exact at any step; piles come to rest and weigh what they weigh; the account closes.
#include <catch2/catch.hpp>
#include <map>
#include <sstream>

#include "common/error.hpp"
#include "few_grains.hpp"

using namespace chute;
using namespace chute::test;
using hybrid::HybridEngine;

TEST_CASE("two discs collide as Walton has it, whatever the step, and stay on their exact way") {
  const laws::Walton walton{0.3, 0.4};
  for (const double dt : {1e-3, 0.0137, 0.05, 0.14})
    for (const double offset : {0.0, 0.3, -0.7, 0.95})
      for (const double spin : {0.0, 2.0, -3.0}) {
        Grains<2> grains;
        add_ball<2>(grains, {{0, 0}}, {{1.2, 0.1}});
        add_ball<2>(grains, {{2, offset}}, {{-0.8, 0.05}}, true, 0.6, 2.5);
        grains.spin[0] = {spin, 1};
        HybridEngine<2> engine(grains, setup_of<2>(0.7, walton, dt));
        // By hand: |r_0 + v t| = 1.1, the first root.
        const Vec<2> d{{2, offset}}, v{{-2, -0.05}};
        const double b = dot(d, v), v2 = dot(v, v);
        const double t = (-b - std::sqrt(b * b - v2 * (dot(d, d) - 1.21))) / v2;
        const auto steps = static_cast<std::int64_t>(std::ceil(t / dt)) + 3;
        engine.advance_to(steps);
        const auto& now = engine.state();
        laws::Collider<2> i{{{1.2, 0.1}}, {{spin}}, 0.5, 1, 1 / grains.inertia[0]};
        laws::Collider<2> j{{{-0.8, 0.05}}, {{1}}, 0.6, 1 / 2.5, 1 / grains.inertia[1]};
        const Vec<2> way = d + t * v;
        walton((1 / norm(way)) * way, 0.7, i, j);
        CAPTURE(dt, offset, spin, t);
        const double rest = static_cast<double>(steps) * dt - t;
        for (int k = 0; k < 2; ++k) {
          const auto axis = static_cast<std::size_t>(k);
          CHECK(now.velocity[axis][0] == Approx(i.velocity[k]).margin(1e-12));
          CHECK(now.velocity[axis][1] == Approx(j.velocity[k]).margin(1e-12));
          CHECK(now.position[axis][0] == Approx(t * (k ? 0.1 : 1.2) + rest * i.velocity[k]).margin(1e-11));
        }
        CHECK(now.spin[0][0] == Approx(i.spin[0]).margin(1e-11));
        CHECK(now.spin[0][1] == Approx(j.spin[0]).margin(1e-11));
      }
}

TEST_CASE("a pair that only grazes within a step is not missed") {
  Grains<2> grains;
  add_ball<2>(grains, {{0, 0}}, {{1, 0}});
  add_ball<2>(grains, {{1.2, 0.999}}, {{-1, 0}});
  HybridEngine<2> engine(grains, setup_of<2>(1, {0, -1}, 0.14));
  engine.collect_impacts(true);
  engine.advance_to(12);
  CHECK(engine.take_impacts().size() == 1);
}

TEST_CASE("a ball in flight falls and bounces on its parabola, also on a bead") {
  Grains<3> grains;
  add_ball<3>(grains, {{0, 0, 3}}, {{0, 0, 0}});
  add_ball<3>(grains, {{0, 0, 0}}, {}, false);
  auto setup = setup_of<3>(0.8, {0, -1}, 0.02);
  setup.gravity = {{0, 0, -1}};
  HybridEngine<3> engine(grains, setup);
  engine.collect_impacts(true);
  engine.advance_to(200);
  const auto impacts = engine.take_impacts();
  REQUIRE(impacts.size() >= 1);
  CHECK(impacts[0].time == Approx(2).margin(1e-10));  // 2 m down
  CHECK(impacts[0].v_n == Approx(-2).margin(1e-10));
  CHECK(engine.state().velocity[2][0] == Approx(1.6 - 2).margin(1e-9));  // t = 4, two after the bounce
  CHECK(engine.state().position[2][0] == Approx(1 + 1.6 * 2 - 2).margin(1e-9));
  CHECK(std::abs(engine.energy().residual()) < 1e-12);
}

TEST_CASE("a column of 10 comes to rest between two side walls, and the floor bears its weight") {
  Grains<2> grains;
  for (int k = 0; k < 10; ++k) add_ball<2>(grains, {{0, 0.6 + 1.1 * k}}, {{0.1 * (k % 3 - 1), 0}});
  auto setup = setup_of<2>(0.6, {0.3, 0.2}, 0.01);
  setup.gravity = {{0, -1}};
  setup.walls = {floor_at<2>(), {{{-0.55, 0}}, {{1, 0}}}, {{{0.55, 0}}, {{-1, 0}}}};
  setup.walls[1].surface.friction = setup.walls[2].surface.friction = 0;  // or they would bear a part
  HybridEngine<2> engine(grains, setup);
  engine.advance_to(6000);
  engine.collect_collisions(true);
  engine.advance_to(8000);
  double up = 0;
  for (const auto& c : engine.take_collisions())
    if (c.b == wall_id(0)) up -= c.force[1];
  CHECK(up / 20 == Approx(10).epsilon(0.01));
  const auto e = engine.energy();
  // Eight collisions of a pair in a step do not carry the weight of ten all the way down: what is left over keeps the
  // grains sinking by some g Δt, and pushing them apart takes it back.
  CHECK(e.translation < 10 * 0.5 * 0.1 * 0.1);
  CHECK(std::abs(e.residual()) < 1e-9 * e.gravity_work);
  CHECK(e.projection_work > 0);
  // and the contacts tell what they carry: the lowest all, the highest one grain
  double lowest = 0, highest = 0;
  for (const auto& c : engine.contacts()) {
    if (c.b == wall_id(0)) lowest = c.normal_force;
    if (c.a == 8 && c.b == 9) highest = c.normal_force;
  }
  CHECK(lowest == Approx(10).epsilon(0.05));
  CHECK(highest == Approx(1).epsilon(0.1));
  CHECK(engine.state().position[1][9] > 9);
}

TEST_CASE(
    "a grain on a floor that shakes is thrown when A w^2 > g, and stays when it is less; the account closes") {
  for (const double strength : {0.8, 1.5}) {
    const double A = 0.05, f = std::sqrt(strength / A) / (2 * M_PI);
    Grains<2> grains;
    add_ball<2>(grains, {{0, 0.5}}, {});
    auto setup = setup_of<2>(0, {0.3, 0}, 2e-3);
    setup.gravity = {{0, -1}};
    setup.walls = {floor_at<2>()};
    setup.walls[0].motion.amplitude = A, setup.walls[0].motion.frequency = f;
    HybridEngine<2> engine(grains, setup);
    double highest = 0;
    for (std::int64_t k = 1; k < 4000; ++k) {
      engine.advance_to(k);
      const double gap = engine.state().position[1][0] - 0.5 - A * std::sin(2 * M_PI * f * engine.time());
      if (k > 1000) highest = std::max(highest, gap);
    }
    CAPTURE(strength, highest);
    CHECK((highest > 0.01) == (strength > 1));
    CHECK(highest < 0.2);
    const auto e = engine.energy();
    CHECK(std::abs(e.residual()) < 1e-9);
    CHECK(std::abs(e.wall_work) > 0.01);
  }
}

TEST_CASE("grains in a drum that turns and between walls that shake keep their account") {
  Gas<2> gas(4, 1.3);
  for (auto* column : {&gas.grains.position[0], &gas.grains.position[1]})
    for (double& x : *column) x -= 2.6;
  auto setup = setup_of<2>(0.8, {0.4, 0.3}, 0.004);
  setup.gravity = {{0, -1}};
  Wall<2> drum;
  drum.outline = Cylinder<2>{{}, 4, 1.5};
  drum.surface.friction = 0.9;
  Wall<2> paddle;
  paddle.point = {{0, -3.4}}, paddle.normal = {{0, 1}}, paddle.outline = Segment{{{1, 0}}};
  paddle.motion.amplitude = 0.2, paddle.motion.frequency = 0.7;
  setup.walls = {drum, paddle};
  HybridEngine<2> engine(gas.grains, setup);
  engine.advance_to(5000);
  const auto e = engine.energy();
  CHECK(e.wall_work != 0);
  CHECK(std::abs(e.residual()) < 1e-9 * (e.normal_loss + e.shear_loss));
  for (std::size_t i = 0; i < 16; ++i) CHECK(norm(engine.state().place(i)) < 3.6);
}

TEST_CASE("grains that move too far in a step are told of") {
  Grains<2> grains;
  add_ball<2>(grains, {{0, 0}}, {{40, 0}});
  HybridEngine<2> engine(grains, setup_of<2>(1, {}, 0.01));
  CHECK_THROWS_WITH(engine.advance_to(5),
                    Catch::Contains("moves 0.4 diameters in a step") && Catch::Contains("grain 0"));
}

namespace {

/// A heap that falls onto a line of beads, under gravity on an incline.
struct Heap {
  Grains<2> grains;
  hybrid::HybridSetup<2> setup = setup_of<2>(0.6, {0.5, 0.2}, 0.01);
  Heap() {
    for (int i = 0; i < 60; ++i) {
      Random random(2, Purpose::start, static_cast<std::uint64_t>(i));
      add_ball<2>(grains, {{(i % 10 + 0.5) * 1.2, 1.3 + 1.2 * (i / 10)}},
                  {{random.normal(), random.normal()}}, true, 0.5 * random.uniform(0.9, 1.1));
    }
    for (int i = 0; i < 12; ++i) add_ball<2>(grains, {{i + 0.5, 0}}, {}, false);
    setup.domain.length[0] = 12;
    setup.gravity = {{std::sin(0.3), -std::cos(0.3)}};
  }
};

std::string bytes(const HybridEngine<2>& engine) {
  std::ostringstream out;
  engine.save(out);
  return out.str();
}

}  // namespace

TEST_CASE("a flowing heap is the same bytes at any number of threads, and interrupted or not") {
  const Heap heap;
  HybridEngine<2> whole(heap.grains, heap.setup);
  auto setup = heap.setup;
  setup.threads = 3;
  HybridEngine<2> shared(heap.grains, setup), first(heap.grains, heap.setup), second(heap.grains, setup);
  whole.advance_to(500);
  shared.advance_to(500);
  CHECK(bytes(whole) == bytes(shared));
  first.advance_to(123);
  std::istringstream state(bytes(first));
  second.restore(state);
  second.advance_to(500);
  CHECK(bytes(whole) == bytes(second));
  const auto told = whole.tells();
  CHECK(told[0].second > 500);  // collisions
  const auto e = whole.energy();
  CHECK(std::abs(e.residual()) < 1e-9 * e.normal_loss);
}

TEST_CASE("a heap at rest does not sink into itself, its bed bears its weight, and it moves no more") {
  Heap heap;
  heap.setup.gravity = {{0, -1}};
  HybridEngine<2> engine(heap.grains, heap.setup);
  engine.advance_to(4000);
  engine.collect_collisions(true);
  double deepest = 0, weight = 0;
  for (const double mass : heap.grains.mass) weight += mass;
  weight -= 12;  // the bed
  for (int step = 4001; step <= 5000; ++step) {
    engine.advance_to(step);
    deepest = std::max(deepest, engine.tells()[2].second);
  }
  double down = 0;
  for (const auto& c : engine.take_collisions())
    if (c.b >= 60) down += c.force[1];
  CHECK(-down / 10 == Approx(weight).epsilon(0.01));
  CHECK(deepest < 1e-3);  // g Δt² is 1e-4
  // At the end of a step a grain at rest has what gravity gave it in that, g Δt; a few still roll into their places.
  CHECK(engine.energy().translation < 2 * 60 * 0.5 * 1e-4);
}

TEST_CASE("in a stack of 20 on a bead each carries those above it") {
  Grains<2> grains;
  for (int k = 1; k <= 20; ++k) add_ball<2>(grains, {{0, 1.0 * k}}, {});
  add_ball<2>(grains, {{0, 0}}, {}, false);
  auto setup = setup_of<2>(0.6, {0.3, 0.2}, 0.01);
  setup.gravity = {{0, -1}};
  setup.walls = {{{{-0.5, 0}}, {{1, 0}}}, {{{0.5, 0}}, {{-1, 0}}}};
  for (auto& wall : setup.walls) wall.surface.friction = 0;
  HybridEngine<2> engine(grains, setup);
  engine.advance_to(6000);
  std::map<std::pair<std::int64_t, std::int64_t>, double> force;
  for (const auto& c : engine.contacts()) force[{c.a, c.b}] = c.normal_force;
  for (int k = 0; k < 19; ++k) CHECK(force[{k, k + 1}] == Approx(19 - k).epsilon(0.01));
  CHECK(force[{0, 20}] == Approx(20).epsilon(0.01));
  CHECK(engine.tells()[2].second < 2e-3);
  CHECK(engine.energy().translation < 20 * 0.5 * 4e-4);  // 2 g Δt each
}

// Newton's second law, grain by grain: what collisions gave is the change of momentum less gravity's share.
TEST_CASE("the collisions of a flowing heap add up to its changes of momentum") {
  Heap heap;
  HybridEngine<2> engine(heap.grains, heap.setup);
  engine.collect_collisions(true);
  engine.advance_to(300);
  std::map<std::int64_t, Vec<2>> given;
  for (const auto& c : engine.take_collisions()) {
    const Vec<2> J{{c.force[0], c.force[1]}};
    given[c.a] = given[c.a] - J;
    if (!is_wall(c.b)) given[c.b] = given[c.b] + J;
  }
  for (std::size_t i = 0; i < 60; ++i)
    for (int k = 0; k < 2; ++k) {
      const auto axis = static_cast<std::size_t>(k);
      const double change =
          engine.state().velocity[axis][i] - heap.grains.velocity[axis][i] - 3 * heap.setup.gravity[k];
      CHECK(given[static_cast<std::int64_t>(i)][k] == Approx(change).margin(1e-10));
    }
}

TEST_CASE("a sphere on a plane that tilts rolls as gravity has it by then, and the account closes") {
  Grains<2> grains;
  add_ball<2>(grains, {{0, 0.5}}, {});
  auto setup = setup_of<2>(0, {0.8, 0}, 2e-3);
  const Tilt tilt{0.1, 0.5, 0.1, 1};
  setup.gravity = gravity_on_incline<2>(1, tilt.from);
  setup.tilt = tilt;
  setup.walls = {floor_at<2>()};
  HybridEngine<2> engine(grains, setup);
  engine.advance_to(2000);
  // v = 5/7 ∫ g sin θ dt, with θ = 0.1 + 0.1 t up to t = 4
  const double expected = 5.0 / 7 * (std::cos(0.1) - std::cos(0.5)) / 0.1;
  CHECK(engine.state().velocity[0][0] == Approx(expected).epsilon(2e-3));
  CHECK(std::abs(engine.energy().residual()) < 1e-9);
}
