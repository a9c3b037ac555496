#include <catch2/catch.hpp>
#include <sstream>

#include "common/error.hpp"
#include "few_grains.hpp"

using namespace chute;
using namespace chute::test;
using chute::event::EventEngine;
using chute::event::EventSetup;
using chute::event::HardContact;

namespace {

/// A ball of radius 1 above one bead of radius 1, under g = 1.
template <int D>
EventSetup<D> free_space(const HardContact& contact, double contact_time = 0) {
  EventSetup<D> setup;
  setup.gravity[D - 1] = -1;
  setup.contact = contact;
  setup.contact_time = contact_time;
  setup.tick = 0.01;
  return setup;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("a ball dropped on the top of a bead: every bounce where the closed form has it", "",
                       ((int D), D), 2, 3) {
  const double e = 0.8, height = 0.5;
  Grains<D> grains;
  Vec<D> top{};
  top[D - 1] = 2 + height;
  add_ball<D>(grains, top, {}, 1, 3, true);
  add_ball<D>(grains, {}, {}, 1, 1, false);
  EventEngine<D> engine(grains, free_space<D>({laws::ConstantRestitution{e}, {}}));
  engine.collect_impacts(true);
  engine.advance_to(880);
  const auto impacts = engine.take_impacts();
  REQUIRE(impacts.size() >= 8);
  double t = std::sqrt(2 * height), v = std::sqrt(2 * height), lost = 0;
  for (std::size_t k = 0; k < 8; ++k) {
    CHECK(impacts[k].time == Approx(t).epsilon(1e-13));
    CHECK(impacts[k].v_n == Approx(-v).epsilon(1e-12));
    CHECK(impacts[k].v_t == Approx(0).margin(1e-14));
    CHECK(impacts[k].gamma == Approx(0).margin(1e-14));
    CHECK(impacts[k].place[D - 1] == Approx(1));
    CHECK(impacts[k].grain == 0);
    CHECK(impacts[k].bead == 1);
    v *= e;
    t += 2 * v;
  }
  for (std::size_t k = 0, n = impacts.size(); k < n; ++k)
    lost += 0.5 * 3 * (1 - e * e) * impacts[k].v_n * impacts[k].v_n;
  CHECK(engine.energy().normal_loss == Approx(lost).epsilon(1e-12));
  CHECK(engine.energy().residual() == Approx(0).margin(1e-13));
}

TEST_CASE("an oblique hit: slip after it against slip before it is Walton's two lines") {
  const double e = 0.89, mu = 0.21, beta = 0.39;
  const double corner = 3.5 * mu * (1 + e) / (1 + beta);  // (2.31), corrected
  for (const double psi : {0.1, 0.5, 0.99 * corner, 1.01 * corner, 2.0, 6.0})
    for (const bool fixed : {true, false})
      for (const double mass : {1.0, 5.0}) {
        CAPTURE(psi, fixed, mass);
        // Starts 1 away from contact on the line between centres, without gravity.
        Grains<2> grains;
        const Vec<2> n{{0.6, 0.8}}, s{{0.8, -0.6}};
        const Vec<2> v = -1.0 * n + psi * s;
        const Vec<2> start = 3.0 * n - 1.0 * v;  // R_i + R_j = 3 at t = 1
        add_ball<2>(grains, start, v, 1, mass, true);
        add_ball<2>(grains, {}, {}, 2, 2, !fixed);
        auto setup = free_space<2>({laws::ConstantRestitution{e}, {.friction = mu, .beta = beta}});
        setup.gravity = {};
        EventEngine<2> engine(grains, setup);
        engine.advance_to(150);
        const auto& g = engine.state();
        const Vec<2> after = g.speed(0) - g.speed(1);
        const double v_s = dot(after, s) + g.spin[0][0] * 1 + g.spin[0][1] * 2;
        CHECK(dot(after, n) == Approx(e).epsilon(1e-12));
        const double expected = psi <= corner ? -beta * psi : psi - 3.5 * mu * (1 + e);  // (2.30), (2.28)
        CHECK(v_s == Approx(expected).epsilon(1e-12));
        CHECK(engine.energy().residual() == Approx(0).margin(1e-13));
        if (!fixed) {
          CHECK(mass * g.speed(0)[0] + 2 * g.speed(1)[0] == Approx(mass * v[0]).epsilon(1e-13));
          CHECK(mass * g.speed(0)[1] + 2 * g.speed(1)[1] == Approx(mass * v[1]).epsilon(1e-13));
        }
      }
}

TEST_CASE("in 3D the same, turned into an arbitrary plane") {
  const double e = 0.7, mu = 0.3, beta = 0.5, psi = 0.4;
  const Vec<3> n{{2.0 / 7, 3.0 / 7, 6.0 / 7}}, s{{6.0 / 7, 2.0 / 7, -3.0 / 7}};
  const Vec<3> v = -1.0 * n + psi * s;
  Grains<3> grains;
  add_ball<3>(grains, 2.0 * n - 1.0 * v, v, 1, 1, true);
  add_ball<3>(grains, {}, {}, 1, 1, true);
  auto setup = free_space<3>({laws::ConstantRestitution{e}, {.friction = mu, .beta = beta}});
  setup.gravity = {};
  EventEngine<3> engine(grains, setup);
  engine.advance_to(150);
  const auto& g = engine.state();
  Vec<3> spin;
  for (int k = 0; k < 3; ++k)
    spin[k] = g.spin[static_cast<std::size_t>(k)][0] + g.spin[static_cast<std::size_t>(k)][1];
  const Vec<3> after = g.speed(0) - g.speed(1) - cross(spin, n);
  CHECK(dot(after, n) == Approx(e).epsilon(1e-12));
  CHECK(dot(after, s) == Approx(-beta * psi).epsilon(1e-12));
  CHECK(norm(after - e * n + beta * psi * s) < 1e-12);
  CHECK(engine.energy().residual() == Approx(0).margin(1e-13));
}

TEMPLATE_TEST_CASE_SIG("an elastic gas, smooth or perfectly rough, keeps energy and momentum to rounding", "",
                       ((int D), D), 2, 3) {
  for (const bool rough : {false, true}) {
    Gas<D> gas(D == 2 ? 12 : 5, 1.3);
    gas.setup.contact = {laws::ConstantRestitution{1}, {.friction = rough ? 1e9 : 0, .beta = 1}};
    EventEngine<D> engine(gas.grains, gas.setup);
    const auto momentum = [&] {
      Vec<D> sum{};
      for (std::size_t i = 0; i < gas.grains.moving; ++i) sum = sum + engine.state().speed(i);
      return sum;
    };
    const double energy = engine.energy().stored(), rotation = engine.energy().rotation;
    const Vec<D> before = momentum();
    engine.advance_to(400);
    CHECK(engine.work().collisions > 10000);
    CHECK(engine.energy().stored() == Approx(energy).epsilon(1e-12));
    if (rough)
      CHECK(std::abs(engine.energy().rotation / rotation - 1) > 0.01);  // exchanged with translation
    else
      CHECK(engine.energy().rotation == Approx(rotation).epsilon(1e-12));
    CHECK(norm(momentum() - before) < 1e-11);
  }
}

TEST_CASE("no two grains ever overlap, and the energy account closes, in an inelastic rough flow") {
  Heap heap(12, 6, 0.4);
  heap.setup.contact = {laws::ConstantRestitution{0.7}, {.friction = 0.4, .beta = 0.3}};
  heap.setup.contact_time = 1e-3;
  EventEngine<2> engine(heap.grains, heap.setup);
  for (int step = 10; step <= 300; step += 10) {
    engine.advance_to(step);
    const auto& g = engine.state();
    double deepest = 0;
    for (std::size_t i = 0; i < g.moving; ++i)
      for (std::size_t j = i + 1; j < g.size(); ++j)
        deepest = std::max(deepest,
                           g.radius[i] + g.radius[j] - norm(heap.setup.domain.way(g.place(i), g.place(j))));
    CHECK(deepest < 1e-12);
    const auto e = engine.energy();
    CHECK(e.residual() == Approx(0).margin(1e-10 * (e.gravity_work + e.normal_loss + e.start)));
  }
  CHECK(engine.work().collisions > 5000);
}

TEST_CASE("saved and restored, a run goes on to the same bytes; where it stops to look does not matter") {
  Heap heap(12, 6, 0.4);
  heap.setup.contact = {laws::ConstantRestitution{0.7}, {.friction = 0.4, .beta = 0.3}};
  heap.setup.contact_time = 1e-3;
  const auto bytes = [](const EventEngine<2>& engine) {
    std::ostringstream out;
    engine.save(out);
    return out.str();
  };
  EventEngine<2> straight(heap.grains, heap.setup), looked(heap.grains, heap.setup),
      first(heap.grains, heap.setup), second(heap.grains, heap.setup);
  straight.collect_impacts(true);
  second.collect_impacts(true);
  straight.advance_to(70);
  straight.take_impacts();
  straight.advance_to(200);
  for (int step = 1; step <= 200; ++step) looked.advance_to(step);
  first.advance_to(70);
  std::istringstream saved(bytes(first));
  second.restore(saved);
  second.advance_to(200);
  CHECK(bytes(straight) == bytes(looked));
  CHECK(bytes(straight) == bytes(second));
  const auto a = straight.take_impacts(), b = second.take_impacts();
  REQUIRE(a.size() == b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    CHECK(a[k].time == b[k].time);
    CHECK(a[k].grain == b[k].grain);
    CHECK(a[k].gamma == b[k].gamma);
  }
}

TEMPLATE_TEST_CASE_SIG("the work per collision does not grow with the number of grains", "", ((int D), D), 2,
                       3) {
  double least = 1e9, most = 0;
  for (const int side : D == 2 ? std::vector{10, 30, 100} : std::vector{5, 10, 20}) {
    Gas<D> gas(side, 1.25);
    gas.setup.contact = {laws::ConstantRestitution{0.95}, {}};
    EventEngine<D> engine(gas.grains, gas.setup);
    engine.advance_to(10);
    const auto& w = engine.work();
    const auto done = static_cast<double>(w.collisions);
    CHECK(done > 250);
    const double candidates = static_cast<double>(w.candidates) / done;
    CAPTURE(side, w.collisions, w.moves, w.outdated, candidates);
    CHECK(w.layouts == 1);
    least = std::min(least, candidates), most = std::max(most, candidates);
  }
  CHECK(most < 1.25 * least);
}

TEST_CASE("overlapping grains, and a domain shorter than two contacts, are refused") {
  Grains<2> grains;
  add_ball<2>(grains, {{0, 1.9}}, {}, 1, 1, true);
  add_ball<2>(grains, {{0, 0}}, {}, 1, 1, false);
  CHECK_THROWS_WITH(EventEngine<2>(grains, free_space<2>({})),
                    Catch::Contains("grain 0 overlaps grain 1 by 0.1"));
  grains.position[1][0] = 2.5;
  auto setup = free_space<2>({});
  setup.domain.length[0] = 3;
  CHECK_THROWS_AS(EventEngine<2>(grains, setup), WorkError);
}

TEST_CASE("a grain that falls past the bed is named") {
  Grains<2> grains;
  add_ball<2>(grains, {{5, 3}}, {}, 1, 1, true);
  add_ball<2>(grains, {{0, 0}}, {}, 1, 1, false);
  auto setup = free_space<2>({});
  setup.floor = -4;
  EventEngine<2> engine(grains, setup);
  CHECK_THROWS_WITH(engine.advance_to(1000), Catch::Contains("grain 0: it fell through the bed"));
}

TEST_CASE("grains that leave the box get a new grid, and nothing is missed") {
  Heap heap(6, 6, 0.2);
  heap.setup.contact = {laws::ConstantRestitution{1}, {}};
  for (std::size_t i = 0; i < heap.grains.moving; ++i)
    heap.grains.velocity[1][i] += 12;  // thrown ten boxes high
  EventEngine<2> engine(heap.grains, heap.setup);
  const double start = engine.energy().stored();
  engine.advance_to(1000);
  CHECK(engine.work().layouts > 1);
  const auto e = engine.energy();
  CHECK(e.stored() - e.gravity_work == Approx(start).epsilon(1e-10));
  const auto& g = engine.state();
  for (std::size_t i = 0; i < g.moving; ++i) {
    CHECK(g.position[1][i] > 0.5);  // none fell through the bed
    for (std::size_t j = i + 1; j < g.size(); ++j)
      CHECK(norm(heap.setup.domain.way(g.place(i), g.place(j))) > (g.radius[i] + g.radius[j]) * (1 - 1e-11));
  }
}
