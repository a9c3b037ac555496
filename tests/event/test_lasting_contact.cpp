#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "common/error.hpp"
#include "few_grains.hpp"

using namespace chute;
using namespace chute::test;
using chute::event::EventEngine;
using chute::event::EventSetup;
using chute::event::HardContact;

namespace {

EventSetup<2> on_earth(const HardContact& contact, double contact_time) {
  EventSetup<2> setup;
  setup.gravity = {{0, -1}};
  setup.contact = contact;
  setup.contact_time = contact_time;
  setup.tick = 0.01;
  return setup;
}

/// A ball of radius 1 and mass 3 that falls from 0.5 onto the top of a bead. Without a cut-off its bounces
/// end at t = 1 + 2e/(1 − e).
Grains<2> dropped() {
  Grains<2> grains;
  add_ball<2>(grains, {{0, 2.5}}, {}, 1, 3, true);
  add_ball<2>(grains, {{0, 0}}, {}, 1, 1, false);
  return grains;
}

}  // namespace

TEST_CASE(
    "without a cut-off, inelastic collapse stops the run, with the grain and the time of the closed form") {
  for (const double e : {0.3, 0.5, 0.8}) {
    EventEngine<2> engine(dropped(), on_earth({laws::ConstantRestitution{e}, {}}, 0));
    const double end = 1 + 2 * e / (1 - e);
    engine.advance_to(static_cast<std::int64_t>(100 * end) - 5);
    CHECK_THROWS_WITH(engine.advance_to(2000), Catch::Contains("grain 0: inelastic collapse"));
    CHECK_THROWS_WITH(engine.advance_to(2000), Catch::Contains(fmt::format("t = {:.4g}", end)));
  }
}

TEST_CASE("a restitution that rises to 1 at rest does not prevent the collapse") {
  EventEngine<2> engine(dropped(), on_earth({laws::PowerLawRestitution{1 - 0.8, 1}, {}}, 0));
  CHECK_THROWS_WITH(engine.advance_to(1'000'000), Catch::Contains("inelastic collapse"));
}

TEST_CASE(
    "with t_c the ball comes to rest: one lasting contact that carries its weight, and no more impacts") {
  for (const double e : {0.0, 0.5, 0.8})
    for (const double t_c : {1e-2, 1e-3}) {
      CAPTURE(e, t_c);
      EventEngine<2> engine(dropped(), on_earth({laws::ConstantRestitution{e}, {}}, t_c));
      engine.collect_impacts(true);
      const double end = 1 + 2 * e / (1 - e);
      engine.advance_to(static_cast<std::int64_t>(100 * end) + 10);
      CHECK(engine.take_impacts().size() <= 2 + (e > 0 ? std::log(t_c / 2) / std::log(e) : 0));
      const auto before = engine.work().collisions;
      engine.advance_to(engine.step() + 100);
      CHECK(engine.take_impacts().empty());
      const auto contacts = engine.contacts();
      REQUIRE(contacts.size() == 1);
      CHECK(contacts[0].normal_force == Approx(3).epsilon(0.02));
      CHECK(engine.grains().force[1][0] == Approx(3).epsilon(0.02));
      CHECK(engine.grains().force[0][0] == Approx(0).margin(1e-9));
      const double apex = t_c * t_c / 8;  // of the bounce that lasts t_c
      CHECK(engine.state().position[1][0] - 2 <= apex * (1 + 1e-6));
      CHECK(static_cast<double>(engine.work().collisions - before) <= 2.1 / t_c);
      CHECK(engine.energy().residual() == Approx(0).margin(1e-11));
    }
}

TEST_CASE("a ball rolls over a bead and leaves it as the theory of rolling says; a smooth one slides") {
  // On the bead: γ̈ = (m/m_eff) (g/L) sin γ, L = R + r = 2, until it lifts off where v² = g L cos γ; then it
  // falls freely.
  const double L = 2, v_0 = 0.1, end = 6;
  for (const bool rolls : {true, false}) {
    const double k = (rolls ? 5.0 / 7 : 1) / L, dt = 1e-5;
    double gamma = 0, rate = v_0 / L, t = 0;
    for (; rate * rate * L < std::cos(gamma); t += dt) {  // velocity Verlet
      rate += dt / 2 * k * std::sin(gamma);
      gamma += dt * rate;
      rate += dt / 2 * k * std::sin(gamma);
    }
    const double pull = rolls ? 10.0 / 7 : 2;  // 2m/m_eff: cos γ = 10/17 or 2/3 for v_0 → 0
    CHECK(std::cos(gamma) == Approx((pull + v_0 * v_0 / L) / (1 + pull)).epsilon(1e-4));
    const double v = L * rate, rest = end - t;
    REQUIRE(rest > 0);
    const Vec<2> expected{{L * std::sin(gamma) + v * std::cos(gamma) * rest,
                           L * std::cos(gamma) - v * std::sin(gamma) * rest - rest * rest / 2}};
    for (const double t_c : {4e-2, 1e-2, 2.5e-3}) {
      Grains<2> grains;
      add_ball<2>(grains, {{0, L}}, {{v_0, 0}}, 1, 1, true);
      grains.spin[0][0] = rolls ? -v_0 : 0;
      add_ball<2>(grains, {{0, 0}}, {}, 1, 1, false);
      EventEngine<2> engine(grains,
                            on_earth({laws::ConstantRestitution{0.5}, {.friction = rolls ? 1e6 : 0}}, t_c));
      engine.collect_impacts(true);
      engine.advance_to(std::llround(end / 0.01));
      const double error = norm(engine.state().place(0) - expected);
      CAPTURE(rolls, t_c, error, engine.take_impacts().size());
      CHECK(error < 3 * t_c);
      CHECK(error < 0.02);
      if (rolls)
        CHECK(engine.state().spin[0][0] == Approx(-v).epsilon(0.05));  // it lags where the force fades
    }
  }
}

TEST_CASE("a ball wedged between two beads stays there, whatever friction takes") {
  for (const double mu : {0.0, 0.13, 1.0})
    for (const double e : {0.0, 0.7}) {
      Grains<2> grains;
      add_ball<2>(grains, {{0.01, std::sqrt(3.0) + 0.01}}, {}, 1, 1, true);
      add_ball<2>(grains, {{-1, 0}}, {}, 1, 1, false);
      add_ball<2>(grains, {{1, 0}}, {}, 1, 1, false);
      const double t_c = 1e-3;
      CAPTURE(mu, e);
      EventEngine<2> engine(grains,
                            on_earth({laws::ConstantRestitution{e}, {.friction = mu, .beta = 0.34}}, t_c));
      engine.advance_to(1000);
      CHECK(engine.contacts().size() == 2);
      CHECK(engine.state().position[0][0] == Approx(0).margin(1e-3));
      CHECK(engine.state().position[1][0] == Approx(std::sqrt(3.0)).margin(1e-4));
      CHECK(engine.energy().translation < t_c * t_c);
      CHECK(engine.energy().residual() == Approx(0).margin(1e-11));
      CHECK(engine.work().collisions < 100 / t_c * 10);
    }
}

TEST_CASE("a heap at rest goes on, at a cost that its contacts and its height bound") {
  // A bounce of at least g t_c/4 lasts t_c/2 under the grain's own weight, and n times less under n grains.
  const int rows = 5;
  for (const double e : {0.0, 0.3}) {
    Heap heap(6, rows, 0.05);
    heap.setup.contact = {laws::ConstantRestitution{e}, {.friction = 0.5}};
    heap.setup.contact_time = 5e-3;
    EventEngine<2> engine(heap.grains, heap.setup);
    engine.advance_to(100);
    const auto before = engine.work().collisions;
    engine.advance_to(105);
    CAPTURE(e);
    const auto contacts = static_cast<double>(engine.contacts().size());
    REQUIRE(contacts > 30);
    const double per_contact =
        static_cast<double>(engine.work().collisions - before) / contacts / (0.5 / heap.setup.contact_time);
    CHECK(per_contact < 2 * 2 * rows);
    CHECK(per_contact > 1);
    const auto energy = engine.energy();
    CHECK(energy.translation / 30 < 1e-3);
    CHECK(energy.residual() == Approx(0).margin(1e-9 * (energy.gravity_work + energy.start)));
  }
}
