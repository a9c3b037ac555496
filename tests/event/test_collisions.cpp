// What passes between hard grains: stresses and networks are made of it.
#include <catch2/catch.hpp>

#include "few_grains.hpp"

using namespace chute;
using namespace chute::test;
using namespace chute::event;

TEST_CASE("a collision tells the impulse on its second grain, with the sign of friction") {
  for (const double side : {-1.0, 1.0}) {
    Grains<2> grains;
    add_ball<2>(grains, {{0, 0}}, {}, 0.5, 1, true);
    add_ball<2>(grains, {{side * 0.4, 1.2}}, {{0, -1}}, 0.5, 2, true);
    EventSetup<2> setup;
    setup.contact = {laws::ConstantRestitution{0.7}, {.friction = 0.3, .beta = 0.2}};
    setup.tick = 1;
    EventEngine<2> engine(grains, setup);
    engine.collect_collisions(true);
    engine.advance_to(1);
    const auto collisions = engine.take_collisions();
    REQUIRE(collisions.size() == 1);
    const auto& c = collisions[0];
    CHECK(c.a == 0);
    CHECK(c.b == 1);
    const auto after = engine.grains();
    for (std::size_t k = 0; k < 2; ++k) {
      const double before = k == 1 ? -1 : 0;
      CHECK(c.force[k] == Approx(2 * (after.velocity[k][1] - before)).margin(1e-12));
      CHECK(c.force[k] == Approx(-1 * after.velocity[k][0]).margin(1e-12));
    }
    CHECK(c.normal[0] * c.force[0] + c.normal[1] * c.force[1] == Approx(c.normal_force));
    CHECK(c.normal_force > 0);
    CHECK(c.shear_force * side < 0);  // against the slip, which is n_x along s = (n_y, −n_x)
    CHECK(std::hypot(c.branch[0], c.branch[1]) == Approx(1));
  }
}

// Newton's second law, grain by grain: what collisions gave is the change of momentum less gravity's share.
TEST_CASE("the collisions of a settling heap add up to its changes of momentum, those with a wall too") {
  Heap heap(6, 4, 0.2);
  heap.setup.contact = {laws::ConstantRestitution{0.6}, {.friction = 0.4, .beta = 0.1}};
  heap.setup.contact_time = 1e-3;
  heap.setup.walls.push_back({{{0, -0.2}}, {{0, 1}}});  // under the gaps of the bed
  EventEngine<2> engine(heap.grains, heap.setup);
  engine.collect_collisions(true);
  const auto start = heap.grains;
  engine.advance_to(60);
  const auto view = engine.grains();
  std::vector<Vec<2>> given(view.size());
  bool with_bed = false, lasting = false;
  for (const auto& c : engine.take_collisions()) {
    const Vec<2> J{{c.force[0], c.force[1]}};
    given[static_cast<std::size_t>(c.a)] = given[static_cast<std::size_t>(c.a)] - J;
    if (!is_wall(c.b)) given[static_cast<std::size_t>(c.b)] = given[static_cast<std::size_t>(c.b)] + J;
    with_bed = with_bed || c.b >= static_cast<std::int64_t>(view.moving);
  }
  for (std::size_t i = 0; i < view.moving; ++i)
    for (int k = 0; k < 2; ++k) {
      const auto axis = static_cast<std::size_t>(k);
      const double change = view.mass[i] * (view.velocity[axis][i] - start.velocity[axis][i]);
      CHECK(given[i][k] ==
            Approx(change - view.mass[i] * heap.setup.gravity[k] * engine.time()).margin(1e-9));
    }
  CHECK(with_bed);
  // what touches for a while has a mean force, friction in it, and grains feel it
  double shear = 0, push = 0;
  for (const auto& c : engine.contacts()) {
    lasting = true;
    shear += std::abs(c.shear_force);
    CHECK(c.normal_force >= 0);
  }
  for (std::size_t i = 0; i < view.moving; ++i) push += view.force[1][i];
  CHECK(lasting);
  CHECK(shear > 0);
  CHECK(push > 0);
}

TEST_CASE("a ball on a smooth floor: bounces at known times, then a weight that rests on it") {
  Grains<3> grains;
  add_ball<3>(grains, {{0, 0, 2.5}}, {{0.3, 0, 0}}, 0.5, 2, true);
  EventSetup<3> setup;
  setup.gravity = {{0, 0, -1}};
  setup.walls.push_back({{}, {{0, 0, 1}}});
  setup.contact = {laws::ConstantRestitution{0.5}, {.friction = 0, .beta = 0}};
  setup.contact_time = 1e-3;
  setup.tick = 0.01;
  EventEngine<3> engine(grains, setup);
  engine.collect_impacts(true);
  engine.collect_collisions(true);
  engine.advance_to(1000);
  const auto impacts = engine.take_impacts();
  REQUIRE(impacts.size() > 5);
  double v = 2, t = 2;  // √(2 g h) and √(2 h/g) for a fall from 2
  for (std::size_t k = 0; k < 5; ++k) {
    CHECK(impacts[k].time == Approx(t).epsilon(1e-12));
    CHECK(impacts[k].v_n == Approx(-v).epsilon(1e-12));
    CHECK(impacts[k].bead == wall_id(0));
    v *= 0.5, t += 2 * v;
  }
  CHECK(engine.grains().position[2][0] == Approx(0.5).epsilon(1e-6));
  double late = 0;
  for (const auto& c : engine.take_collisions())
    if (c.time > 8) late -= c.force[2];  // on the wall
  CHECK(late / 2 == Approx(2).epsilon(2e-3));
  const auto contacts = engine.contacts();
  REQUIRE(contacts.size() == 1);
  CHECK(contacts[0].normal_force == Approx(2).epsilon(1e-2));
}
