#include <catch2/catch.hpp>

#include "engines/soft/bounce.hpp"
#include "two_grains.hpp"

namespace collision_tests {
using namespace chute;
using namespace chute::test;

namespace {

struct Bounce {
  double restitution, contact_time;
};

struct HeadOn {
  laws::ContactLaws contact;
  double dt;
  soft::Scheme scheme = soft::Scheme::gear5;
  double m_i = Acetate::mass, m_j = Acetate::mass;
  bool j_moves = true;
  soft::ContactEnds ends = soft::ContactEnds::sampled;
  double contact_time = 0;  ///< known: weights are means over a step, also where surfaces are a little apart

  /// Two balls meet head on; the contact begins the given part of a step after a step.
  Bounce at_phase(double part) const {
    const double R = Acetate::radius, v = 1;
    Grains<2> grains;
    add_ball<2>(grains, {{0, 0}}, {{v, 0}}, R, m_i);
    add_ball<2>(grains, {{2 * R + v * dt * (10 + part), 0}}, {{0, 0}}, R, m_j, j_moves);
    auto with = setup<2>(contact, dt, 2 * R, scheme);
    with.ends = ends;
    with.contact_time = contact_time;
    soft::SoftEngine<2> engine(grains, with);
    const auto steps = through_one_contact(engine);
    engine.advance_to(engine.step() + 5);
    const auto& g = engine.state();
    return {(g.velocity[0][1] - g.velocity[0][0]) / v, static_cast<double>(steps) * dt};
  }
  std::vector<Bounce> at_phases(int count) const {
    std::vector<Bounce> all;
    for (int k = 0; k < count; ++k) all.push_back(at_phase((k + 0.5) / count));
    return all;
  }
};

double worst_restitution(const std::vector<Bounce>& all, double e_n) {
  double worst = 0;
  for (const auto& b : all) worst = std::max(worst, std::abs(b.restitution - e_n));
  return worst;
}

double mean_restitution(const std::vector<Bounce>& all) {
  double sum = 0;
  for (const auto& b : all) sum += b.restitution / static_cast<double>(all.size());
  return sum;
}

const Oscillator acetate{Acetate::stiffness, Acetate::damping, Acetate::mass / 2};
const laws::ContactLaws acetate_law = smooth(Acetate::stiffness, Acetate::damping);

}  // namespace

TEST_CASE("the stated material has the stated restitution") {
  CHECK(acetate.restitution() ==
        Approx(0.87).margin(1e-4));  // the truth of the cases below, against the thesis
}

TEST_CASE("two acetate spheres bounce with e_n = 0.87 at t_n/50, gear5") {
  double worst = 0;
  for (const auto& b : HeadOn{acetate_law, acetate.contact_time() / 50}.at_phases(50)) {
    worst = std::max(worst, std::abs(b.restitution - 0.87));
    CHECK(std::abs(b.restitution - 0.87) < 0.0005);
    CHECK(std::abs(b.contact_time - acetate.contact_time()) <= acetate.contact_time() / 50);
  }
  INFO("largest error " << worst);
  CHECK(worst < 0.0005);
}

// Law (3.1) pulls with γ_n e_n v at the end of a contact, so a step that the contact misses or has too many
// there changes e_n by up to γ_n δt e_n / m_eff. Which it is depends on where in a step the contact began:
// over all phases, as in a flow, it averages out.
TEST_CASE("two acetate spheres bounce with e_n = 0.87, whatever the phase of the step") {
  const auto scheme = GENERATE(soft::Scheme::gear5, soft::Scheme::verlet);
  const double per = GENERATE(50.0, 50.3, 50.8);
  const double dt = acetate.contact_time() / per, one_step = Acetate::damping * dt / acetate.m_eff;
  HeadOn impact{acetate_law, dt, scheme};
  const auto sampled = impact.at_phases(100);
  impact.ends = soft::ContactEnds::weighted;
  const auto weighted = impact.at_phases(100);
  INFO("means " << mean_restitution(weighted) << ", " << mean_restitution(sampled));
  CHECK(std::abs(mean_restitution(sampled) - 0.87) < 0.0005);
  CHECK(worst_restitution(sampled, acetate.restitution()) < one_step);
  CHECK(worst_restitution(weighted, acetate.restitution()) < 0.06 * one_step);
  if (per != 50) CHECK(worst_restitution(sampled, acetate.restitution()) > 0.1 * one_step);
}

// What weights near the ends of a contact leave is of second order, also where a contact is no whole number of steps.
TEST_CASE("restitution is wrong in second order of the step, with sampled ends in first") {
  const auto scheme = GENERATE(soft::Scheme::gear5, soft::Scheme::verlet);
  const double e_n = GENERATE(0.1, 0.3, 0.6, 0.9);
  const bool apart_too =
      GENERATE(false, true);  // with a memory it begins with the contact, else half a step before
  const double m_eff = Acetate::mass / 2, log_e = std::log(e_n);
  const Oscillator pair{Acetate::stiffness,
                        -2 * log_e * std::sqrt(Acetate::stiffness * m_eff / (pi * pi + log_e * log_e)),
                        m_eff};
  const auto worst = [&](double steps, soft::ContactEnds ends) {
    HeadOn impact{smooth(Acetate::stiffness, pair.gamma), pair.contact_time() / steps, scheme};
    impact.ends = ends;
    impact.contact_time = apart_too ? pair.contact_time() : 0;
    return worst_restitution(impact.at_phases(40), e_n);
  };
  const double rough = worst(25.3, soft::ContactEnds::weighted),
               usual = worst(50.3, soft::ContactEnds::weighted),
               fine = worst(100.3, soft::ContactEnds::weighted);
  const double sampled = worst(50.3, soft::ContactEnds::sampled),
               sampled_fine = worst(100.3, soft::ContactEnds::sampled);
  INFO("e_n " << e_n << ": " << rough << ", " << usual << ", " << fine << "; sampled " << sampled << ", "
              << sampled_fine);
  CHECK(usual < 0.4 * rough);
  CHECK(fine < 0.4 * usual);
  CHECK(sampled_fine > 0.4 * sampled);
  CHECK(rough < sampled);  // half as many steps are as good
  CHECK(usual < 0.25 * sampled);
}

// Sixteen moments of a step, of which the engine is asked, against many by hand; weighted ends are asked for with t_n.
TEST_CASE("what `check` tells of bounces is what they do") {
  const auto scheme = GENERATE(soft::Scheme::gear5, soft::Scheme::verlet);
  const auto ends = GENERATE(soft::ContactEnds::sampled, soft::ContactEnds::weighted);
  const double t_n = acetate.contact_time(), dt = t_n / GENERATE(20.3, 50.3);
  HeadOn impact{acetate_law, dt, scheme};
  impact.ends = ends, impact.contact_time = t_n;
  const auto all = impact.at_phases(200);
  const double worst = worst_restitution(all, acetate.restitution());
  const laws::Pair pair{Acetate::mass / 2, Acetate::radius / 2};
  const auto law = laws::normal_impact(acetate_law, 1, pair);
  const auto told = soft::bounce_error(acetate_law, pair, 1, law, {scheme, ends, dt});
  REQUIRE(told);
  INFO(told->worst << " told, " << worst << " found; mean " << told->mean);
  CHECK(told->worst < 1.01 * worst);
  CHECK(told->worst > 0.8 * worst);
  CHECK(std::abs(told->mean - (mean_restitution(all) - acetate.restitution())) < 0.1 * worst);
  CHECK_FALSE(soft::bounce_error(acetate_law, pair, 1, law, {scheme, ends, t_n / 2000}));
}

/// A ball that lies on a bead is knocked up by another, in the plane y = 0 of both: how fast it flies.
struct KnockedUp {
  static constexpr double stiffness = 1e5, mass = 1, radius = 0.5, gravity = 1;
  Oscillator pair;
  soft::ContactEnds ends;

  double speed(double steps, double phase, soft::Scheme scheme) const {
    const double dt = pair.contact_time() / steps, v = 1;
    const double pressed = mass * gravity / stiffness;
    Grains<2> grains;
    add_ball<2>(grains, {{0, 2 * radius - pressed}}, {{0, 0}}, radius, mass);
    // from below, past the bead, at moments that differ by a step of the longest
    const double flight = pair.contact_time() * (0.4 + phase / 25);
    const double way = 2 * radius + v * flight, across = std::cos(0.44), up = std::sin(0.44);
    add_ball<2>(grains, {{-way * across, 2 * radius - pressed - way * up}}, {{v * across, v * up}}, radius,
                mass);
    add_ball<2>(grains, {{0, 0}}, {{0, 0}}, radius, mass, false);
    auto with = setup<2>(smooth(stiffness, pair.gamma), dt, 2 * radius, scheme);
    with.ends = ends;
    with.contact_time = pair.contact_time();
    with.gravity = {{0, -gravity}};
    soft::SoftEngine<2> engine(grains, with);
    const auto after = static_cast<std::int64_t>(4 * steps);
    engine.advance_to(after);
    return engine.state().velocity[1][0] + gravity * (static_cast<double>(after) * dt - flight);
  }
};

TEST_CASE("a contact at rest that is torn open within steps pulls as long as it lasts") {
  const auto scheme = GENERATE(soft::Scheme::gear5, soft::Scheme::verlet);
  constexpr double m_eff = KnockedUp::mass / 2, log_e = -2.302585;  // e_n = 0.1
  const Oscillator pair{KnockedUp::stiffness,
                        -2 * log_e * std::sqrt(KnockedUp::stiffness * m_eff / (pi * pi + log_e * log_e)),
                        m_eff};
  const auto error = [&](double steps, soft::ContactEnds ends) {
    double sum = 0;
    for (int k = 0; k < 8; ++k) {
      const double phase = (k + 0.5) / 8;
      const double exact = KnockedUp{pair, soft::ContactEnds::weighted}.speed(1600, phase, scheme);
      sum += std::abs(KnockedUp{pair, ends}.speed(steps, phase, scheme) / exact - 1) / 8;
    }
    return sum;
  };
  const double rough = error(25, soft::ContactEnds::weighted), usual = error(50, soft::ContactEnds::weighted),
               sampled = error(50, soft::ContactEnds::sampled);
  INFO(rough << ", " << usual << "; sampled " << sampled);
  CHECK(usual < sampled);
  if (scheme == soft::Scheme::gear5) {  // with verlet what is left is how old its velocities are
    CHECK(usual < 0.4 * sampled);
    CHECK(rough < 0.5 * sampled);
  }
}

TEST_CASE("a contact lasts t_n (3.3)") {
  const auto scheme = GENERATE(soft::Scheme::gear5, soft::Scheme::verlet);
  const double t_n = acetate.contact_time();
  for (double steps : {20.5, 100.5, 1000.5}) {  // not a whole number: the count may be the one below or above
    const double dt = t_n / steps;
    for (const auto& b : HeadOn{acetate_law, dt, scheme}.at_phases(8))
      CHECK(std::abs(b.contact_time - t_n) <= dt);
  }
}

TEST_CASE("restitution asked per pair holds for unequal masses and with a fixed grain") {
  const double e_n = GENERATE(0.3, 0.6, 0.95);
  const laws::ContactLaws contact{laws::SpringDashpot::from_restitution(Acetate::stiffness, e_n),
                                  laws::Frictionless{}};
  for (double ratio : {0.1, 1.0, 7.0, std::numeric_limits<double>::infinity()}) {
    const bool moves = std::isfinite(ratio);
    const double m_j = moves ? ratio * Acetate::mass : Acetate::mass;
    const double m_eff = moves ? Acetate::mass * ratio / (1 + ratio) : Acetate::mass;
    // t_n of a pair with this restitution: π / ω with the decay ω ln(1/e_n)/π
    const double w = std::sqrt(Acetate::stiffness / m_eff / (1 + std::pow(std::log(e_n) / pi, 2)));
    const HeadOn collision{contact, pi / w / 50, soft::Scheme::gear5, Acetate::mass, m_j, moves};
    for (const auto& b : collision.at_phases(8)) {
      INFO("e_n " << e_n << ", mass ratio " << ratio);
      CHECK(b.restitution == Approx(e_n).margin(5e-4));
      CHECK(b.contact_time == Approx(pi / w).margin(pi / w / 50));
    }
  }
}

TEST_CASE("a fixed grain stays where it is, to the bit") {
  Grains<2> grains;
  add_ball<2>(grains, {{0, 1}}, {{0, -1}}, 0.5, 1);
  add_ball<2>(grains, {{0.25, 0}}, {{0, 0}}, 0.5, 1, false);
  soft::SoftEngine<2> engine(grains, setup<2>(smooth(1e5, 10), 1e-4, 1));
  REQUIRE(through_one_contact(engine) > 10);
  CHECK(engine.state().place(1) == Vec<2>{{0.25, 0}});
  CHECK(engine.state().speed(1) == Vec<2>{{0, 0}});
}

TEST_CASE("free flight is a parabola") {
  const auto scheme = GENERATE(soft::Scheme::gear5, soft::Scheme::verlet);
  Grains<2> grains;
  add_ball<2>(grains, {{0.1, 2}}, {{3, 4}}, 0.5, 2);
  grains.spin[0][0] = -7;
  auto s = setup<2>(smooth(1e5, 10), 1e-3, 1, scheme);
  s.gravity = {{0.3, -0.9}};
  s.domain.length[0] = 5;  // flies around the period several times
  soft::SoftEngine<2> engine(grains, s);
  engine.advance_to(10'000);
  const double t = engine.time();
  CHECK(t == Approx(10));
  const auto view = engine.grains();
  // a polynomial of second degree: exact but for rounding, 1e-16 of the farthest way (45) in each of 10^4
  // steps
  CHECK(view.unwrapped(0, 0) == Approx(0.1 + 3 * t + 0.5 * 0.3 * t * t).epsilon(1e-12));
  CHECK(view.unwrapped(0, 1) == Approx(2 + 4 * t - 0.5 * 0.9 * t * t).margin(5e-11));
  CHECK(view.position[0][0] >= 0);
  CHECK(view.position[0][0] < 5);
  CHECK(view.velocity[0][0] == Approx(3 + 0.3 * t).epsilon(1e-12));
  CHECK(view.velocity[1][0] == Approx(4 - 0.9 * t).epsilon(1e-12));
  CHECK(view.spin[0][0] == -7);
  CHECK(view.orientation[0][0] == Approx(-7 * t).epsilon(1e-12));
  const auto e = engine.energy();
  CHECK(e.gravity_work ==
        Approx(2 * (0.3 * (3 * t + 0.15 * t * t) - 0.9 * (4 * t - 0.45 * t * t))).epsilon(1e-10));
  CHECK(std::abs(e.residual()) < 1e-10 * e.translation);
}

}  // namespace collision_tests
