// Bodies at rest and starting to move, whose impulses over one step h can be written down: J = F h.
#include <catch2/catch.hpp>

#include "scene.hpp"

using namespace chute;
using namespace chute::contact;
using test::Scene;

namespace {

constexpr double g = 9.81, h = 1e-3, infinite = std::numeric_limits<double>::infinity();
const Goal goal{.tolerance = 1e-12, .iterations = 100'000};

Approx near(double x) { return Approx(x).epsilon(1e-9).margin(1e-12); }

/// The second axis is the normal of the plane, the first points downhill.
template <int D>
Vec<D> gravity_step(double incline) {
  Vec<D> v;
  v[0] = h * g * std::sin(incline);
  v[1] = -h * g * std::cos(incline);
  return v;
}
template <int D>
Vec<D> up() {
  Vec<D> n;
  n[1] = 1;
  return n;
}
template <int D>
double shear(const Vec<D>& r) {
  Vec<D> t(r);
  t[0] = 0;
  return norm(t);
}

TEMPLATE_TEST_CASE_SIG("a block on an incline sticks, slides or leaves", "", ((int D), D), 2, 3) {
  const double mu = 0.4, m = 2;
  for (const double incline : {0.0, 0.2, 0.38, 0.39, 0.7}) {
    Scene<D> scene;
    scene.body(m, infinite, gravity_step<D>(incline));
    scene.touch(0, -1, up<D>(), mu);
    REQUIRE(scene.solve(goal).reached);
    const double weight = m * g * h * std::cos(incline);
    const bool holds = std::tan(incline) <= mu;
    CHECK(scene.impulse[0][0] == near(weight));
    CHECK(shear(scene.impulse[0]) == near(holds ? m * g * h * std::sin(incline) : mu * weight));
    CHECK(scene.velocity[0][0] == near(holds ? 0 : h * g * (std::sin(incline) - mu * std::cos(incline))));
    CHECK(scene.velocity[1][0] == near(0));
  }
  Scene<D> rising;
  rising.body(m, infinite, -1.0 * gravity_step<D>(0.3));
  rising.touch(0, -1, up<D>(), mu);
  REQUIRE(rising.solve(goal).reached);
  CHECK(rising.impulse[0] == Vec<D>{});
}

TEMPLATE_TEST_CASE_SIG("a disc or sphere rolls where tan θ ≤ (1 + κ)/κ μ and else slides", "", ((int D), D),
                       2, 3) {
  const double mu = 0.1, m = 3, radius = 0.5, kappa = D == 2 ? 0.5 : 0.4;
  for (const double incline : {0.1, 0.25, 0.29, 0.33, 0.4, 1.0}) {
    Scene<D> scene;
    scene.body(m, kappa * m * radius * radius, gravity_step<D>(incline));
    scene.touch(0, -1, up<D>(), mu, radius);
    REQUIRE(scene.solve(goal).reached);
    const bool rolls = std::tan(incline) <= (1 + kappa) / kappa * mu;
    const double along = g * std::sin(incline), across = g * std::cos(incline);
    CHECK(scene.velocity[0][0] == near(h * (rolls ? along / (1 + kappa) : along - mu * across)));
    CHECK(shear(scene.impulse[0]) == near(h * m * (rolls ? kappa / (1 + kappa) * along : mu * across)));
    const double turn = scene.spin[D == 2 ? 0 : 2][0];  // clockwise: downhill
    CHECK(turn == near(-h * (rolls ? along / (1 + kappa) / radius : mu * across / (kappa * radius))));
  }
}

TEMPLATE_TEST_CASE_SIG("each of a stack carries what lies on it", "", ((int D), D), 2, 3) {
  const int count = 40;
  const double m = 0.7;
  Scene<D> scene;
  for (int k = 0; k < count; ++k) {
    scene.body(m, 0.1 * m, gravity_step<D>(0));
    scene.touch(k, k - 1, up<D>(), 0.5);
  }
  REQUIRE(scene.solve(goal).reached);
  for (int k = 0; k < count; ++k) {
    CHECK(scene.impulse[static_cast<std::size_t>(k)][0] == near((count - k) * m * g * h));
    CHECK(shear(scene.impulse[static_cast<std::size_t>(k)]) == near(0));
  }
}

TEST_CASE("two supports 90 degrees apart without friction") {
  Scene<2> scene;
  const double m = 5, s = std::sqrt(0.5);
  scene.body(m, 1, {{0, -g * h}});
  scene.touch(0, -1, {{s, s}}, 0);
  scene.touch(0, -1, {{-s, s}}, 0);
  REQUIRE(scene.solve(goal).reached);
  for (const auto& r : scene.impulse) CHECK(r[0] == near(m * g * h * s));
}

/// Two discs on the floor carry a third whose contacts lean by `lean` from the vertical; s = (n_y, −n_x).
Scene<2> pile(double lean, double mu) {
  Scene<2> scene;
  const double m = 1.5, radius = 0.5;
  for (int k = 0; k < 3; ++k) scene.body(m, m * radius * radius / 2, {{0, -g * h}});
  scene.touch(0, -1, {{0, 1}}, mu);
  scene.touch(1, -1, {{0, 1}}, mu);
  scene.touch(2, 0, {{std::sin(lean), std::cos(lean)}}, mu);
  scene.touch(2, 1, {{-std::sin(lean), std::cos(lean)}}, mu);
  return scene;
}

TEST_CASE("a pile of three discs stands if μ ≥ tan(a/2)") {
  const double lean = 40 * 3.14159265358979323846 / 180, weight = 1.5 * g * h, need = std::tan(lean / 2);
  auto stands = pile(lean, need + 0.01);
  REQUIRE(stands.solve(goal).reached);
  for (const std::size_t k : {2u, 3u}) {
    CHECK(stands.impulse[k][0] == near(weight / 2));
    CHECK(std::abs(stands.impulse[k][1]) == near(weight / 2 * need));
  }
  for (const std::size_t k : {0u, 1u}) {
    CHECK(stands.impulse[k][0] == near(3 * weight / 2));
    CHECK(std::abs(stands.impulse[k][1]) == near(weight / 2 * need));
  }
  for (std::size_t k = 0; k < 3; ++k) CHECK(std::hypot(stands.velocity[0][k], stands.velocity[1][k]) < 1e-10);

  auto falls = pile(lean, need - 0.01);
  REQUIRE(falls.solve(goal).reached);
  CHECK(falls.velocity[1][2] < -1e-5);
  CHECK(falls.velocity[0][0] == near(-falls.velocity[0][1]));
}

TEST_CASE("static friction holds what sliding friction does not, and lets go for good") {
  const double lean = 40 * 3.14159265358979323846 / 180, need = std::tan(lean / 2);
  Team team(1);
  const auto run = [&](double held, unsigned char sticking) {
    auto scene = pile(lean, 0);
    const std::vector<double> held_by(4, held), sliding(4, need - 0.05);
    const std::vector<unsigned char> at_rest(4, sticking);
    BodySystem<2> system(scene.bodies(), scene.contacts(), team);
    const auto c = nsgs(system, StaticFriction{held_by, sliding, at_rest}, goal, team);
    REQUIRE(c.reached);
    system.hand_back(scene.bodies(), scene.contacts());
    return scene;
  };
  CHECK(std::abs(run(need + 0.01, 1).velocity[1][2]) < 1e-10);  // at rest it stands
  const auto moving = run(need + 0.01, 0);                      // the same, sliding: it falls
  CHECK(moving.velocity[1][2] < -1e-4);
  // too little to hold: the upper contacts break, and then slide with μ_d, not with μ_s
  const auto broken = run(need - 0.01, 1);
  CHECK(broken.velocity[1][2] == near(moving.velocity[1][2]));
  for (const std::size_t k : {2u, 3u})
    CHECK(std::abs(broken.impulse[k][1]) == near((need - 0.05) * broken.impulse[k][0]));
  // the floor's contacts need less than μ_d: they stick throughout
  for (const std::size_t k : {0u, 1u})
    CHECK(std::abs(broken.impulse[k][1]) < 0.9 * (need - 0.05) * broken.impulse[k][0]);
}

TEST_CASE("static friction on a block: both states between the two angles") {
  const double held[] = {0.5}, sliding[] = {0.3};
  Team team(1);
  for (const double incline : {std::atan(0.29), std::atan(0.4), std::atan(0.51)})
    for (const unsigned char at_rest : {0, 1}) {
      Scene<3> scene;
      scene.body(1, infinite, gravity_step<3>(incline));
      if (!at_rest) scene.velocity[0][0] += 1;  // it was on its way
      scene.touch(0, -1, up<3>(), 0);
      BodySystem<3> system(scene.bodies(), scene.contacts(), team);
      REQUIRE(nsgs(system, StaticFriction{held, sliding, {&at_rest, 1}}, goal, team).reached);
      system.hand_back(scene.bodies(), scene.contacts());
      const bool stays = at_rest && std::tan(incline) <= 0.5;
      const double slides = h * g * (std::sin(incline) - 0.3 * std::cos(incline));
      CHECK(scene.velocity[0][0] == near(stays ? 0 : (at_rest ? 0 : 1) + slides));
    }
}

TEST_CASE("a gap may close within the step, and a wall's own velocity is an offset") {
  Scene<2> scene;
  scene.body(1, infinite, {{0, -0.02}});
  scene.touch(0, -1, {{0, 1}}, 0.5);
  scene.offset[0][0] = 1e-5 / h;  // gap/h
  REQUIRE(scene.solve(goal).reached);
  CHECK(scene.velocity[1][0] == near(-0.01));
  CHECK(scene.impulse[0][0] == near(0.01));
}

}  // namespace
