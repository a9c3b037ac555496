// What comes in fast: cradles, bounces, gases, and the ball on a line.
#include <catch2/catch.hpp>
#include <sstream>

#include "core/sphere.hpp"
#include "engines/event/event_engine.hpp"
#include "few_grains.hpp"

using namespace chute;
using namespace chute::test;
using contact::Impacts;

namespace {

std::vector<double> cradle(Impacts impacts, double time_step, double way) {
  Grains<2> grains;
  add_ball<2>(grains, {{-1 - way, 0}}, {{1, 0}});
  add_ball<2>(grains, {{0, 0}});
  add_ball<2>(grains, {{1, 0}});
  auto setup = setup_of<2>(0, time_step);
  setup.contact.restitution = laws::ConstantRestitution{1};
  setup.impacts = impacts;
  ContactEngine<2> engine(grains, setup);
  engine.advance_to(std::llround((way + 0.5) / time_step));
  CHECK(std::abs(engine.energy().stored() - engine.energy().start) < 1e-10);
  return {engine.state().velocity[0].begin(), engine.state().velocity[0].end()};
}

}  // namespace

TEST_CASE("a cradle: Walton's impacts send the last grain off, Moreau's make them part together") {
  for (const double h : {0.01, 0.0037})
    for (const double way : {0.0, 0.2, 0.2345}) {
      const auto walton = cradle(Impacts::walton, h, way), moreau = cradle(Impacts::moreau, h, way);
      const double third = 1.0 / 3;
      CAPTURE(h, way);
      for (std::size_t k = 0; k < 3; ++k) {
        CHECK(walton[k] == Approx(k == 2 ? 1 : 0).margin(1e-10));
        CHECK(moreau[k] == Approx(k == 0 ? -third : 2 * third).margin(1e-10));
      }
    }
}

TEST_CASE("two grains collide as Walton has it, where and when they touch") {
  const laws::Walton walton{0.3, 0.4};
  for (const double offset : {0.0, 0.3, -0.7})
    for (const double h : {0.01, 0.013}) {
      Grains<2> grains;
      add_ball<2>(grains, {{0, 0}}, {{1.2, 0.1}});
      add_ball<2>(grains, {{2, offset}}, {{-0.8, 0.05}});
      grains.spin[0] = {1, -2};
      auto setup = setup_of<2>(0.3, h);
      setup.contact = {laws::ConstantRestitution{0.7}, walton};
      ContactEngine<2> engine(grains, setup);
      const Vec<2> d{{2, offset}}, v{{-2, -0.05}};
      const double b = dot(d, v), v2 = dot(v, v), t = (-b - std::sqrt(b * b - v2 * (dot(d, d) - 1))) / v2;
      const auto steps = static_cast<std::int64_t>(t / h) + 10;
      engine.collect_impacts(true);
      engine.advance_to(steps);
      laws::Collider<2> i{{{1.2, 0.1}}, {{1}}, 0.5, 1, 10}, j{{{-0.8, 0.05}}, {{-2}}, 0.5, 1, 10};
      const Vec<2> way = d + t * v;
      walton((1 / norm(way)) * way, 0.7, i, j);
      CAPTURE(offset, h, t);
      const double rest = static_cast<double>(steps) * h - t;
      const auto& now = engine.state();
      for (int k = 0; k < 2; ++k) {
        const auto axis = static_cast<std::size_t>(k);
        CHECK(now.velocity[axis][0] == Approx(i.velocity[k]).margin(1e-11));
        CHECK(now.velocity[axis][1] == Approx(j.velocity[k]).margin(1e-11));
        CHECK(now.position[axis][0] == Approx(t * (k ? 0.1 : 1.2) + rest * i.velocity[k]).margin(1e-11));
      }
      CHECK(now.spin[0][0] == Approx(i.spin[0]).margin(1e-10));
      const auto impacts = engine.take_impacts();
      REQUIRE(impacts.size() == 1);
      CHECK(impacts[0].time == Approx(t).margin(1e-10));
      CHECK(std::abs(engine.energy().residual()) < 1e-12);
    }
}

TEST_CASE("a ball that is dropped bounces to e_n^2k of its height, with Walton's impacts exactly") {
  constexpr double e_n = 0.8, height = 1;
  for (const auto impacts : {Impacts::walton, Impacts::moreau})
    for (const double h : {0.01, 0.0025}) {
      Grains<2> grains;
      add_ball<2>(grains, {{0, 0.5 + height}});
      auto setup = setup_of<2>(0, h);
      setup.contact.restitution = laws::ConstantRestitution{e_n};
      setup.impacts = impacts;
      pull<2>(setup, {{0, -1}});
      setup.walls = {floor_at<2>()};
      ContactEngine<2> engine(grains, setup);
      std::vector<double> tops;
      double before = 0;
      for (std::int64_t step = 1; tops.size() < 5; ++step) {
        engine.advance_to(step);
        const double v = engine.state().velocity[1][0];
        if (before > 0 && v <= 0) tops.push_back(engine.state().position[1][0] - 0.5 + v * v / 2);
        before = v;
      }
      CAPTURE(h, impacts == Impacts::walton);
      for (std::size_t k = 0; k < tops.size(); ++k) {
        const double expected = height * std::pow(e_n, 2.0 * static_cast<double>(k + 1));
        CHECK(tops[k] == Approx(expected).margin(impacts == Impacts::walton ? 1e-9 : 2 * h));
      }
      if (impacts == Impacts::walton) CHECK(std::abs(engine.energy().residual()) < 1e-9);
      // and comes to rest, where it weighs what it weighs
      engine.advance_to(engine.step() + std::llround(60 / h));
      REQUIRE(engine.contacts().size() == 1);
      CHECK(engine.contacts()[0].normal_force == Approx(1).epsilon(1e-8));
      CHECK(engine.state().position[1][0] == Approx(0.5).margin(2e-4));
    }
}

TEST_CASE("a gas in a periodic box keeps its momentum, and loses what impacts took") {
  const auto run = []<int D>(std::integral_constant<int, D>, std::int64_t per_side) {
    Grains<D> grains;
    const auto n = static_cast<std::int64_t>(std::llround(std::pow(per_side, D)));
    Vec<D> before{};
    for (std::int64_t i = 0; i < n; ++i) {
      Random random(5, Purpose::start, static_cast<std::uint64_t>(i));
      Vec<D> place, velocity;
      auto rest = i;
      for (int k = 0; k < D; ++k, rest /= per_side) {
        place[k] = (static_cast<double>(rest % per_side) + 0.5) * 1.3;
        velocity[k] = random.normal();
      }
      add_ball<D>(grains, place, velocity);
      before = before + velocity;
    }
    auto setup = setup_of<D>(0.4, 0.005);
    setup.contact = {laws::ConstantRestitution{0.8}, laws::Walton{0.4, 0.3}};
    for (int k = 0; k < D; ++k) setup.domain.length[k] = static_cast<double>(per_side) * 1.3;
    ContactEngine<D> engine(grains, setup);
    engine.collect_impacts(true);
    engine.advance_to(1000);
    Vec<D> after{};
    for (std::size_t i = 0; i < engine.state().moving; ++i) after = after + engine.state().speed(i);
    for (int k = 0; k < D; ++k) CHECK(after[k] == Approx(before[k]).margin(1e-12 * static_cast<double>(n)));
    const auto e = engine.energy();
    CHECK(engine.take_impacts().size() > 300);
    CHECK(e.normal_loss + e.shear_loss == Approx(e.start - e.stored()).epsilon(1e-10));
    CHECK(e.shear_loss > 0);
  };
  run(std::integral_constant<int, 2>{}, 12);
  run(std::integral_constant<int, 3>{}, 5);
}

TEST_CASE("a ball on a line of beads runs as fast as with the event-driven method") {
  constexpr double size_ratio = 2.25, r = 5e-3, density = 7800;
  Grains<2> grains;
  const auto add = [&](Vec<2> place, double radius, bool moves) {
    const double mass = sphere_mass(density, radius);
    grains.add(place, radius, mass, sphere_inertia(mass, radius), moves);
  };
  add({{2 * r, (size_ratio + 1.05) * r}}, size_ratio * r, true);
  grains.velocity[0][0] = 0.4;
  for (int i = 0; i < 20; ++i) add({{r + i * 2 * r, 0}}, r, false);
  Surroundings<2> around;
  around.domain.length[0] = 40 * r;
  around.gravity = gravity_on_incline<2>(9.81, std::asin(0.1));
  const hard::HardContact contact{laws::ConstantRestitution{0.7}, {.friction = 0.13, .beta = 0.34}};
  event::EventSetup<2> hard{around};
  hard.contact = contact;
  hard.contact_time = 1e-5;
  hard.tick = 0.1;
  ContactSetup<2> setup{around};
  setup.contact = contact;
  setup.static_friction = 0.13;
  setup.time_step = 1e-4;
  setup.diameter = 2 * r;
  setup.reference_impulse = setup.time_step * 9.81 * grains.mass[0];
  setup.impact_velocity = 4 * 9.81 * setup.time_step;
  setup.tolerance = 1e-8;
  event::EventEngine<2> reference(grains, hard);
  ContactEngine<2> engine(grains, setup);
  constexpr double from = 5, until = 605;
  const auto velocity = [&](Engine& e) {
    e.advance_to(std::llround(from / e.time_step()));
    const double begin = e.grains().unwrapped(0, 0);
    e.advance_to(std::llround(until / e.time_step()));
    return (e.grains().unwrapped(0, 0) - begin) / (until - from);
  };
  const double expected = velocity(reference), found = velocity(engine);
  CAPTURE(expected, found);
  CHECK(found == Approx(expected).epsilon(0.005));
}
