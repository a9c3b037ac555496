#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <catch2/catch.hpp>
#include <sstream>

#include "engines/soft/soft_engine.hpp"

using namespace chute;

namespace {

constexpr double k_n = 1e5;
const laws::PairCoefficient k_s{2.0 / 7 * k_n, 0, 0, 0}, k_hertz_s{2.0 / 3 * 1e6, 0, 0, 0};
const laws::Normal spring = laws::SpringDashpot::from_restitution(k_n, 0.9);
const laws::Normal hertz =
    laws::HertzKuwabaraKono::from_damping(laws::Hertz::from_stiffness(1e6), 200, laws::MassScaling::none);

struct Named {
  const char* name;
  laws::ContactLaws law;
};
const std::vector<Named> laws_with_memory = {
    {"cundall-strack", {spring, laws::CundallStrack{k_s, {0.5, true}}}},
    {"cundall-strack without cap", {spring, laws::CundallStrack{k_s, {0.5, false}}}},
    {"mindlin", {hertz, laws::MindlinSpring{k_hertz_s, {0.5, true}}}},
    {"walton-braun-mindlin", {spring, laws::WaltonBraunMindlin{k_s, 0.5}}},
    {"saw-tooth", {spring, laws::SawTooth{0.5, 1e-3}}},
    {"walton-braun", {laws::WaltonBraun::from_restitution(k_n, 0.8), laws::CundallStrack{k_s, {0.5, true}}}},
};

/// A dense gas of unequal grains in a periodic box: contacts begin and end all the time, grains cross the
/// borders.
template <int D>
Grains<D> gas() {
  boost::random::mt19937_64 engine(3);
  boost::random::normal_distribution<double> normal;
  Grains<D> grains;
  const int side = D == 2 ? 8 : 4;
  int count = 1;
  for (int k = 0; k < D; ++k) count *= side;
  for (int n = 0; n < count; ++n) {
    Vec<D> place;
    for (int k = 0, rest = n; k < D; ++k, rest /= side) place[k] = 1.08 * (rest % side) + 0.54;
    const double R = 0.5 - 0.08 * (n % 3), m = R * R * R;
    grains.add(place, R, m, 0.4 * m * R * R, true);
    for (int k = 0; k < D; ++k) grains.velocity[k].back() = normal(engine);
    for (int k = 0; k < turns<D>; ++k) grains.spin[k].back() = normal(engine);
  }
  return grains;
}

template <int D>
soft::SoftSetup<D> box(const laws::ContactLaws& law, soft::Scheme scheme = soft::Scheme::gear5) {
  soft::SoftSetup<D> setup;
  for (int k = 0; k < D; ++k) setup.domain.length[k] = 1.08 * (D == 2 ? 8 : 4);
  setup.laws = law;
  setup.scheme = scheme;
  setup.time_step = 1e-4;  // the fastest contacts take 3e-3
  setup.skins = soft::usual_skins<D>(1);
  return setup;
}

template <int D>
bool same(const Grains<D>& a, const Grains<D>& b) {
  return a.position == b.position && a.velocity == b.velocity && a.spin == b.spin && a.wraps == b.wraps;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("Same bytes whatever the lists, the borders and the processor do", "", ((int D), D), 2,
                       3) {
  for (const auto& [name, law] : laws_with_memory) {
    INFO(name);
    soft::SoftEngine<D> usual(gas<D>(), box<D>(law));
    auto setup = box<D>(law);
    setup.skins = {0.001, 0.01};
    soft::SoftEngine<D> often(gas<D>(), setup);
    setup.skins = {0.3, 0.8};
    setup.search = search::Method::all_pairs;
    setup.isa = Isa::baseline;
    soft::SoftEngine<D> rarely(gas<D>(), setup);
    usual.advance_to(10000), often.advance_to(10000), rarely.advance_to(10000);
    CHECK(often.neighbours().near_builds() > 2 * usual.neighbours().near_builds());
    CHECK(same(usual.state(), often.state()));
    CHECK(same(usual.state(), rarely.state()));
    int crossed = 0;
    for (const int w : usual.state().wraps[0]) crossed += std::abs(w);
    CHECK(crossed > 0);
  }
}

TEMPLATE_TEST_CASE_SIG("A run that was interrupted in the middle of contacts goes on to the same bytes", "",
                       ((int D), D), 2, 3) {
  for (const auto& [name, law] : laws_with_memory)
    for (const auto scheme : {soft::Scheme::gear5, soft::Scheme::verlet}) {
      INFO(name);
      soft::SoftEngine<D> straight(gas<D>(), box<D>(law, scheme));
      straight.advance_to(3001);
      while (straight.contacts().empty()) straight.advance_to(straight.step() + 1);
      std::stringstream file;
      straight.save(file);
      soft::SoftEngine<D> resumed(gas<D>(), box<D>(law, scheme));
      resumed.restore(file);
      std::stringstream again;  // looked at and saved once more, it is still the same
      resumed.energy();
      resumed.save(again);
      CHECK(again.str() == file.str());
      straight.advance_to(6000), resumed.advance_to(6000);
      CHECK(same(straight.state(), resumed.state()));
      CHECK(straight.energy().shear_loss == resumed.energy().shear_loss);
      CHECK(straight.energy().normal_loss == resumed.energy().normal_loss);
    }
}

TEMPLATE_TEST_CASE_SIG("What was there is what is stored and what was dissipated, with every law", "",
                       ((int D), D), 2, 3) {
  for (const auto& [name, law] : laws_with_memory)
    for (const auto scheme : {soft::Scheme::gear5, soft::Scheme::verlet}) {
      auto setup = box<D>(law, scheme);
      setup.time_step = 2e-5;
      soft::SoftEngine<D> engine(gas<D>(), setup);
      double worst = 0;
      for (int k = 1; k <= 40; ++k) {
        engine.advance_to(2500 * k);
        worst = std::max(worst, std::abs(engine.energy().residual()));
      }
      const auto e = engine.energy();
      WARN(D << "D " << name << (scheme == soft::Scheme::gear5 ? " gear5" : " verlet") << ": of " << e.start
             << " lost " << e.normal_loss << " normal, " << e.shear_loss << " tangential; residual at most "
             << worst);
      CHECK(worst < 2e-3 * e.start);
      CHECK(e.normal_loss + e.shear_loss > 0.2 * e.start);
    }
}

TEST_CASE("A pair that turns as one body keeps its tangential spring, about every axis") {
  // Two touching grains, moved by hand: j is pushed aside, then both turn rigidly about an axis through the
  // contact.
  const double R = 0.5, xi = 1e-7, push = 1e-3, dt = 1e-3;
  const laws::ContactLaws law{laws::SpringDashpot::from_restitution(1e9, 1),
                              laws::CundallStrack{{1e5, 0, 0, 0}, {1e9, true}}};
  soft::ContactStages<3> stages(Domain<3>{}, law);
  soft::Contacts<3> contacts;
  for (const Vec<3>& axis :
       {Vec<3>{{1, 0, 0}}, Vec<3>{{0, 1, 0}}, Vec<3>{{0, 0, 1}}, Vec<3>{{0.48, 0.6, 0.64}}}) {
    stages.memory() = soft::ContactMemory<3>(law, soft::SlipRule::trapezoid);
    Grains<3> grains;
    grains.add({{-R + xi / 2, 0, 0}}, R, 1, 0.1, true);
    grains.add({{R - xi / 2, 0, 0}}, R, 1, 0.1, true);
    search::PairList pairs;
    pairs.add(grains, 0, 1);
    stages.evaluate({pairs}, grains, contacts, 0);
    grains.velocity[1][1] = push / dt;  // one step's slip, by the spring's own count of it
    stages.evaluate({pairs}, grains, contacts, dt);
    grains.velocity[1][1] = 0;
    stages.evaluate({pairs}, grains, contacts, dt);
    const Vec<3> before{{contacts.shear_force[0][0], contacts.shear_force[1][0], contacts.shear_force[2][0]}};
    REQUIRE(before[1] < -50);

    const auto rotate = [&](const Vec<3>& a, double angle) {
      return std::cos(angle) * a + std::sin(angle) * cross(axis, a) +
             ((1 - std::cos(angle)) * dot(axis, a)) * axis;
    };
    const double omega = 2;
    const int steps = 3000;  // almost one full turn
    for (int k = 1; k <= steps; ++k)
      for (std::size_t g = 0; g < 2; ++g) {
        const auto place = rotate({{g == 0 ? -R + xi / 2 : R - xi / 2, 0, 0}}, omega * k * dt);
        const auto speed = omega * cross(axis, place);
        for (int c = 0; c < 3; ++c) {
          grains.position[c][g] = place[c];
          grains.velocity[c][g] = speed[c];
          grains.spin[c][g] = omega * axis[c];
        }
        if (g == 1) stages.evaluate({pairs}, grains, contacts, dt);
      }
    const auto expected = rotate(before, omega * steps * dt);
    for (int c = 0; c < 3; ++c) {
      INFO("axis " << axis[0] << " " << axis[1] << " " << axis[2] << ", component " << c);
      // The lever arms of (2.7) are the full radii: the overlap makes a rigid turn slip by Ω ξ.
      CHECK(contacts.shear_force[c][0] == Approx(expected[c]).margin(std::abs(before[1]) * 2e-3));
    }
  }
}

TEST_CASE("A contact forgets; every bounce of a hysteretic ball has the same restitution") {
  // Falls on a fixed grain; between bounces it flies freely, so speeds before successive impacts have the
  // ratio e_n.
  soft::SoftSetup<2> setup;
  setup.laws = {laws::WaltonBraun::from_restitution(1e6, 0.8), laws::Frictionless{}};
  setup.gravity = {{0, -1}};
  setup.time_step = 2e-6;
  setup.skins = soft::usual_skins<2>(1);
  Grains<2> grains;
  grains.add({{0, 1.1}}, 0.5, 1, 0.1, true);
  grains.add({{0, 0}}, 0.5, 1, 0.1, false);
  soft::SoftEngine<2> engine(std::move(grains), setup);
  engine.collect_impacts(true);
  engine.advance_to(1000000);
  const auto impacts = engine.take_impacts();
  REQUIRE(impacts.size() > 2);
  for (std::size_t k = 1; k < impacts.size(); ++k)
    CHECK(impacts[k].v_n / impacts[k - 1].v_n == Approx(0.8).epsilon(2e-3));
}

TEST_CASE("Laws without a memory carry none") {
  using laws::ContactLaws;
  soft::ContactStages<2> stages(
      Domain<2>{}, ContactLaws{spring, laws::RegularisedCoulomb{10, 0.5, laws::MassScaling::none, {}}});
  CHECK(!stages.memory().needed());
  soft::ContactStages<2> with(Domain<2>{}, ContactLaws{spring, laws::CundallStrack{k_s, {0.5, true}}});
  CHECK(with.memory().needed());
}
