#include <catch2/catch.hpp>

#include "experiments/binary_impact.hpp"
#include "many_impacts.hpp"

using namespace chute;
using namespace chute::test;

namespace never_gains_tests {

namespace {

constexpr double k = 1e6;
const laws::PairCoefficient k_s{2.0 / 7 * k, 0, 0, 0}, k_s_equal{k, 0, 0, 0}, k_hertz{2.0 / 3 * 1e7, 0, 0, 0};

struct Named {
  const char* name;
  laws::Shear law;
  bool hertz = false;
  double gain = 0;  ///< largest known, of the energy before
};
/// Tangential laws that cannot gain: they only brake, or store no more than was put in.
const std::vector<Named> honest = {
    {"frictionless", laws::Frictionless{}},
    {"(3.10)", laws::Coulomb{0.5}},
    {"(3.11)", laws::Viscous{200, laws::MassScaling::none}},
    {"(3.12)", laws::RegularisedCoulomb{200, 0.5, laws::MassScaling::none, {}}},
    {"(3.13) with (3.25)", laws::CundallStrack{k_s, {0.5, true}}},
    {"(3.13) with (3.25), k_s = k_n", laws::CundallStrack{k_s_equal, {0.5, true}}},
    {"(3.17)", laws::WaltonBraunMindlin{k_s_equal, 0.5}},
    {"(3.22) with (3.25), shrinking", laws::MindlinSpring{k_hertz, {0.5, true}}, true},
    {"(3.22) shrinking, without (3.25)", laws::MindlinSpring{k_hertz, {0.5, false}}, true},
    // as printed it can gain where a contact is loaded again and again, but in no impact
    {"(3.22) with (3.25), as printed", laws::MindlinSpring{k_hertz, {0.5, true}, false}, true},
};
/// Those that can, where F_n or the stiffness rises under a stretched spring; see their headers.
const std::vector<Named> generous = {
    {"(3.13) without (3.25), k_s = k_n", laws::CundallStrack{k_s_equal, {0.5, false}}, false, 0.113},
    {"(3.19)", laws::SawTooth{0.5, 1e-4}, false, 0.040},
    {"(3.22) without (3.25)", laws::MindlinSpring{k_hertz, {0.5, false}, false}, true, 0.191},
};

laws::Normal normal(bool hertz, bool elastic) {
  const auto spring = laws::Hertz::from_stiffness(1e7);
  if (hertz)
    return elastic ? laws::Normal(spring)
                   : laws::HertzKuwabaraKono::from_damping(spring, 1e4, laws::MassScaling::none);
  return laws::SpringDashpot::from_restitution(k, elastic ? 1 : 0.8);
}

}  // namespace

/// So many impacts of each law in the plane, two thirds as many in space.
void never_gain(std::size_t impacts) {
  for (const auto& list : {honest, generous})
    for (const auto& [name, law, hertz, known] : list) {
      const laws::ContactLaws contact{normal(hertz, false), law};
      const double flat = ManyImpacts<2>(1).worst_gain(contact, impacts, 60);
      const double deep = ManyImpacts<3>(2).worst_gain(contact, impacts * 2 / 3, 60);
      WARN(name << ": largest energy after over before, 2D " << flat << ", 3D " << deep);
      CHECK(flat < 1 + 1e-6);
      CHECK(deep < 1 + 1e-6);
    }
  const laws::ContactLaws hysteretic{laws::WaltonBraun::from_restitution(k, 0.8),
                                     laws::CundallStrack{k_s, {0.5, true}}};
  CHECK(ManyImpacts<2>(1).worst_gain(hysteretic, impacts / 3, 60) < 1 + 1e-6);
}

TEST_CASE("random impacts with a dissipative normal force never gain energy") { never_gain(9000); }
TEST_CASE("10^5 random impacts of each law never gain energy", "[.exact]") { never_gain(60000); }

TEST_CASE("With an elastic normal force, nothing is gained but the error of the integration") {
  for (const auto& [name, law, hertz, known] : honest) {
    const laws::ContactLaws contact{normal(hertz, true), law};
    const double coarse = ManyImpacts<2>(1).worst_gain(contact, 20000, 100) - 1;
    const double fine = ManyImpacts<2>(1).worst_gain(contact, 20000, 400) - 1;
    WARN(name << ": gain " << coarse << " with 100 steps per contact, " << fine << " with 400");
    CHECK(coarse < 5e-4);
    CHECK(fine < 5e-5);
  }
}

TEST_CASE(
    "Tangential springs without the cap gain energy where the normal force is elastic; the laws say so") {
  for (const auto& [name, law, hertz, known] : generous) {
    const double gain = ManyImpacts<2>(1).worst_gain({normal(hertz, true), law}, 20000, 400) - 1;
    WARN(name << ": gains up to " << gain << " of the energy before");
    CHECK(gain > 0.8 * known);
    CHECK(gain < 1.1 * known);
  }
}

TEST_CASE("Near-grazing impacts on a fixed grain with mu = 0.5") {
  // A slight touch at high speed: a law that takes the wrong lever or the wrong reduced mass gains here.
  using namespace experiments;
  double worst = 0;
  for (const auto& [name, law, hertz, known] : honest)
    for (const double psi : {10.0, 100.0, 1000.0, 10000.0})
      for (const double spin : {-3.0, 0.0, 3.0}) {
        BinaryImpact<2> impact;
        impact.laws = {normal(false, false), law};
        const double theta = std::atan(psi);
        impact.normal = {{0, -1}};  // the fixed grain lies below
        impact.i = {0.5, 1, {{std::sin(theta), -std::cos(theta)}}, {{spin}}, false};
        impact.j = {0.5, 1, {}, {}, true};
        const auto outcome = collide(impact);
        INFO(name << " psi " << psi << " spin " << spin);
        CHECK(outcome.energy_after <= outcome.energy_before * (1 + 1e-9));
        const double loss = outcome.energy_before - outcome.energy_after;
        CHECK(outcome.normal_loss + outcome.shear_loss == Approx(loss).epsilon(0.02).margin(1e-9));
        worst = std::max(worst, outcome.energy_after / outcome.energy_before - 1);
      }
  WARN("largest relative gain: " << worst);
}

}  // namespace never_gains_tests
