#include <catch2/catch.hpp>

#include "small_chute.hpp"

namespace impacts_tests {
using namespace chute;
using namespace chute::test;

namespace {

constexpr double bead = 0.5, ball = 0.75, stiffness = 1e7;

/// A ball thrown at one bead that lies at the origin, and when and where it meets it: found by halving, in
/// the test.
struct Throw {
  Vec<2> place, velocity, gravity;
  Vec<2> at(double t) const { return place + t * velocity + (0.5 * t * t) * gravity; }
  double meets() const {
    double early = 0, late = 0;
    while (norm(at(late)) > ball + bead) early = late, late += 1e-3;
    for (int i = 0; i < 60; ++i) {
      const double middle = (early + late) / 2;
      (norm(at(middle)) > ball + bead ? early : late) = middle;
    }
    return late;
  }
};

}  // namespace

TEST_CASE("an impact is recorded as it was just before any force acted") {
  const auto thrown = GENERATE(Throw{{{0.4, 3}}, {{0.1, 0}}, {{0.2, -0.98}}},        // downhill side
                               Throw{{{-0.9, 2}}, {{-0.05, -0.3}}, {{0.2, -0.98}}},  // uphill side
                               Throw{{{-3, 1.1}}, {{2.5, 0.4}}, {{0.1, -0.5}}});     // flies in from behind
  Grains<2> grains;
  add_ball<2>(grains, thrown.place, thrown.velocity, ball, 1);
  add_ball<2>(grains, {{0, 0}}, {{0, 0}}, bead, 1, false);
  grains.spin[0][0] = 5;  // v_t is translation only
  const double dt = Oscillator{stiffness, 0, 1}.contact_time() / 50;
  auto s = setup<2>(smooth(stiffness, 100), dt, 1);
  s.gravity = thrown.gravity;
  soft::SoftEngine<2> engine(grains, s);
  engine.collect_impacts(true);
  const double t = thrown.meets();
  engine.advance_to(static_cast<std::int64_t>(t / dt) + 200);
  const auto impacts = engine.take_impacts();
  REQUIRE(impacts.size() == 1);  // one per contact, not one per step
  CHECK(engine.take_impacts().empty());
  const auto& impact = impacts[0];

  const auto centre = thrown.at(t), velocity = thrown.velocity + t * thrown.gravity;
  const auto n = (1 / norm(centre)) * centre;
  const double v_n = dot(velocity, n), v_t = velocity[0] * n[1] - velocity[1] * n[0];
  const double way = norm(velocity) * dt;  // the impact is found at the next step
  CHECK(impact.time >= t - 1e-12);
  CHECK(impact.time <= t + dt + 1e-12);
  CHECK(impact.gamma == Approx(std::atan2(centre[0], centre[1])).margin(way / (ball + bead)));
  CHECK(impact.v_n < 0);
  CHECK(impact.v_n == Approx(v_n).margin(norm(velocity) * way + dt));
  CHECK(impact.v_t == Approx(v_t).margin(norm(velocity) * way + dt));
  CHECK(impact.place[0] == Approx(bead * n[0]).margin(way));
  CHECK(impact.place[1] == Approx(bead * n[1]).margin(way));
  CHECK(impact.place[2] == 0);
  CHECK(impact.phi == 0);
  CHECK(impact.grain == 0);
  CHECK(impact.bead == 1);
}

TEST_CASE("γ > 0 on the downhill side, and v_t > 0 for a ball that goes downhill over the top") {
  for (const double x : {-0.3, 0.3}) {
    Grains<2> grains;
    add_ball<2>(grains, {{x, ball + bead + 0.1}}, {{0.4, -1}}, ball, 1);
    add_ball<2>(grains, {{0, 0}}, {{0, 0}}, bead, 1, false);
    soft::SoftEngine<2> engine(grains, setup<2>(smooth(stiffness, 100), 1e-5, 1));
    engine.collect_impacts(true);
    engine.advance_to(40'000);
    const auto impacts = engine.take_impacts();
    REQUIRE(impacts.size() == 1);
    CHECK(impacts[0].gamma * x > 0);
    CHECK(impacts[0].v_t > 0);
  }
}

TEST_CASE("in 3D an impact tells the angle from the normal and the azimuth") {
  Grains<3> grains;
  const double gamma = 0.4, phi = -2.1;  // comes straight down on this point of the bead
  const Vec<3> n{{std::sin(gamma) * std::cos(phi), std::sin(gamma) * std::sin(phi), std::cos(gamma)}};
  add_ball<3>(grains, (ball + bead) * n + Vec<3>{{0, 0, 0.2}}, {{0, 0, -2}}, ball, 1);
  add_ball<3>(grains, {{0, 0, 0}}, {{0, 0, 0}}, bead, 1, false);
  const double dt = 1e-5;
  soft::SoftEngine<3> engine(grains, setup<3>(smooth(stiffness, 100), dt, 1));
  engine.collect_impacts(true);
  engine.advance_to(12'000);
  const auto impacts = engine.take_impacts();
  REQUIRE(impacts.size() == 1);
  CHECK(impacts[0].gamma == Approx(gamma).margin(2 * dt));
  CHECK(impacts[0].phi == Approx(phi).margin(2 * dt / std::sin(gamma)));
  CHECK(impacts[0].v_n == Approx(-2 * std::cos(gamma)).margin(4 * dt));
  CHECK(impacts[0].v_t == Approx(2 * std::sin(gamma)).margin(4 * dt));
  CHECK(impacts[0].time == Approx(0.1).margin(1.01 * dt));
}

TEST_CASE("of two moving grains the one with the lower id counts as hit") {
  Grains<2> grains;
  add_ball<2>(grains, {{0, 0}}, {{0, 0}}, 0.5, 1);
  add_ball<2>(grains, {{0.3, 1.1}}, {{0, -1}}, 0.5, 1);
  soft::SoftEngine<2> engine(grains, setup<2>(smooth(stiffness, 100), 1e-5, 1));
  engine.collect_impacts(true);
  engine.advance_to(30'000);
  const auto impacts = engine.take_impacts();
  REQUIRE(impacts.size() == 1);
  CHECK(impacts[0].bead == 0);
  CHECK(impacts[0].grain == 1);
  CHECK(impacts[0].gamma > 0);  // the upper one lies downhill of the lower one
  CHECK(impacts[0].v_n < 0);
}

TEST_CASE("contacts that lasted when collecting began are no impacts") {
  const SmallChute chute;
  auto s = chute.setup(50);
  s.gravity = {{0, -1}};  // without slope the grains come to rest on the bed and on each other
  soft::SoftEngine<2> engine(chute.grains(), s), watched(chute.grains(), s);
  watched.collect_impacts(true);
  const std::int64_t from = 150'000;
  engine.advance_to(from);
  watched.advance_to(from);
  REQUIRE(engine.contacts().size() > chute.grains().moving);
  watched.take_impacts();
  engine.collect_impacts(true);
  engine.advance_to(from + 200);
  watched.advance_to(from + 200);
  CHECK(engine.take_impacts().size() == watched.take_impacts().size());
}

TEST_CASE("a soft ball dropped on the top of a bead: the flights are 2v/g of the velocity it leaves with") {
  // Stiff enough for gravity not to matter in an impact: the velocity falls by e_n, each flight lasts 2v/g.
  const double height = 0.2, dt = Oscillator{stiffness, 0, 1}.contact_time() / 50;
  const double q = -std::log(0.8) / pi;  // (3.2): damping that restores 0.8, m = 1
  const double damping = 2 * q * std::sqrt(stiffness / (1 + q * q));
  Grains<2> grains;
  add_ball<2>(grains, {{0, ball + bead + height}}, {{0, 0}}, ball, 1);
  add_ball<2>(grains, {{0, 0}}, {{0, 0}}, bead, 1, false);
  auto s = setup<2>(smooth(stiffness, damping), dt, 1);
  s.gravity = {{0, -1}};
  s.contact_time = Oscillator{stiffness, 0, 1}.contact_time();
  soft::SoftEngine<2> engine(grains, s);
  engine.collect_impacts(true);
  engine.advance_to(static_cast<std::int64_t>(8 / dt));
  const auto impacts = engine.take_impacts();
  REQUIRE(impacts.size() > 12);
  CHECK(std::isnan(impacts[0].flight));
  double v = std::sqrt(2 * height);
  for (std::size_t k = 1; k < 8; ++k) {
    CHECK(impacts[k].flight == Approx(-2 * impacts[k].v_n).margin(3 * dt));
    v *= 0.8;
    CHECK(impacts[k].flight == Approx(2 * v).epsilon(0.01));
    CHECK(impacts[k].gamma_before == Approx(0).margin(1e-12));
    CHECK_FALSE(impacts[k].rolling);
  }
  // The end of the bounces: flights shorter than four contact times are rolling contact.
  CHECK(impacts.back().rolling);
  for (const auto& impact : impacts) CHECK(impact.rolling == (impact.flight < 4 * s.contact_time));
}

}  // namespace impacts_tests
