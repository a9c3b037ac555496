#include <catch2/catch.hpp>
#include <cmath>
#include <sstream>

#include "engines/lammps/contact_model.hpp"

using namespace chute;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

const laws::Pair mean{0.5, 0.25}, with_bed{1, 0.25}, odd{0.37, 0.19};

laws::RegularisedCoulomb coulomb(double viscosity, laws::MassScaling scaling = laws::MassScaling::none) {
  laws::RegularisedCoulomb law;
  law.viscosity = viscosity, law.friction = 0.4, law.scaling = scaling;
  return law;
}

/// The numbers in a text, in order.
std::vector<double> numbers(const std::string& text) {
  std::istringstream in(text);
  std::vector<double> found;
  for (std::string word; in >> word;) {
    char* end = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    if (*end == 0) found.push_back(value);
  }
  return found;
}

/// The forces that LAMMPS's documentation gives for `pair_style granular`: along and across.
struct Force {
  double normal, shear;
};
Force documented(const std::string& text, double overlap, double closing, double slip, laws::Pair p) {
  const auto n = numbers(text);
  const double a = std::sqrt(p.r_eff * overlap);
  const bool hertz = text.starts_with("hertz");
  const double spring = n[0] * (hertz ? a : 1), k = spring;
  double eta = n[1];
  if (text.find("mass_velocity") != std::string::npos) eta *= p.m_eff;
  if (text.find("viscoelastic") != std::string::npos) eta *= a * p.m_eff;
  if (text.find("tsuji") != std::string::npos) {
    const double e = n[1];
    eta = (1.2728 - 4.2783 * e + 11.087 * e * e - 22.348 * std::pow(e, 3) + 27.467 * std::pow(e, 4) -
           18.022 * std::pow(e, 5) + 4.8218 * std::pow(e, 6)) *
          std::sqrt(p.m_eff * k);
  }
  double total = spring * overlap + eta * closing;
  if (text.find("limit_damping") != std::string::npos) total = std::max(0.0, total);
  return {total, std::min(n[2] * eta * slip, n[3] * std::abs(total))};
}

}  // namespace

TEST_CASE("A pair's model is the law: forces by LAMMPS's formulas are chute's") {
  const double overlap = 0.013, slip = 0.07;
  const laws::Pair pair = GENERATE(mean, with_bed, odd);
  const double closing = GENERATE(0.6, -0.9);
  const bool attraction = GENERATE(true, false);
  const auto hertz = laws::Hertz::from_material(3e4, 0.3);
  const std::vector<laws::Normal> normals{laws::SpringDashpot::from_restitution(1e4, 0.6),
                                          laws::SpringDashpot::from_damping(1e4, 30, laws::MassScaling::both),
                                          hertz,
                                          laws::HertzLinearDamping(hertz, 20, laws::MassScaling::damping),
                                          laws::HertzKuwabaraKono::from_relaxation(hertz, 0.01)};
  for (const auto& normal : normals) {
    laws::ContactLaws contact{normal, laws::Frictionless{}, attraction};
    const bool constant = std::holds_alternative<laws::SpringDashpot>(normal) ||
                          std::holds_alternative<laws::HertzLinearDamping>(normal);
    if (constant) contact.shear = coulomb(15);
    const auto model = lammps::model_of(contact, pair);
    REQUIRE(!model.wrong);
    CAPTURE(model.text);
    const auto force = documented(model.text, overlap, closing, slip, pair);
    double truth = std::visit(
        [&](const auto& law) -> double {
          if constexpr (requires { law(overlap, closing, pair).total; })
            return law(overlap, closing, pair).total;
          return NAN;
        },
        normal);
    if (!attraction) truth = std::max(0.0, truth);
    CHECK(force.normal == Approx(truth).epsilon(1e-13));
    if (constant) CHECK(force.shear == Approx(-coulomb(15)(Vec<1>{{slip}}, truth, pair)[0]).epsilon(1e-13));
  }
}

TEST_CASE("One model for all pairs has each pair's own damping, or is refused") {
  laws::ContactLaws contact{laws::SpringDashpot::from_restitution(1e4, 0.6), laws::Frictionless{}, true};
  const auto model = lammps::model_of_all(contact);
  REQUIRE(!model.wrong);
  CHECK_THAT(model.text, Contains("damping tsuji"));
  for (const auto& pair : {mean, with_bed, odd}) {
    const auto& law = std::get<laws::SpringDashpot>(contact.normal);
    CHECK(documented(model.text, 0.01, 0.5, 0, pair).normal ==
          Approx(law(0.01, 0.5, pair).total).epsilon(1e-12));
  }
  contact.shear = coulomb(15);
  CHECK(lammps::model_of_all(contact).wrong->key == "contact.tangential.law");
  contact.normal = laws::SpringDashpot::from_damping(1e4, 30, laws::MassScaling::damping);
  contact.shear = coulomb(15, laws::MassScaling::damping);
  const auto scaled = lammps::model_of_all(contact);
  REQUIRE(!scaled.wrong);
  for (const auto& pair : {mean, odd}) {
    const auto force = documented(scaled.text, 0.01, 0.5, 0.03, pair);
    CHECK(force.shear == Approx(15 * pair.m_eff * 0.03).epsilon(1e-13));
  }
  contact.normal = laws::SpringDashpot::from_damping(1e4, 30, laws::MassScaling::both);
  CHECK(lammps::model_of_all(contact).wrong->key == "contact.normal");
}

TEST_CASE("The older styles are taken where all pairs have the same coefficients over their masses") {
  laws::ContactLaws contact{laws::SpringDashpot::from_damping(1e4, 30, laws::MassScaling::damping),
                            coulomb(15, laws::MassScaling::damping), true};
  const auto all = lammps::classic_model({{mean, &contact}, {with_bed, &contact}, {odd, &contact}});
  REQUIRE(all);
  CHECK(all->style == "hooke");
  CHECK(all->arguments == "10000 10000 30 15 0.4 1");
  CHECK(lammps::classic_model_of_all({&contact})->arguments == all->arguments);
  contact.attraction = false;
  CHECK_THAT(lammps::classic_model({{mean, &contact}})->arguments, Contains(" limit_damping"));
  // a restitution goes with the root of the mass: one pair alone is exact, several are not
  contact.normal = laws::SpringDashpot::from_restitution(1e4, 0.6);
  CHECK_FALSE(lammps::classic_model({{mean, &contact}, {with_bed, &contact}}));
  CHECK(lammps::classic_model({{odd, &contact}, {odd, &contact}}));
  CHECK_FALSE(lammps::classic_model_of_all({&contact}));
  laws::CundallStrack spring;
  spring.stiffness = {8e3, 0, 0, 0}, spring.spring.friction = 0.5;
  contact.shear = spring;
  CHECK(lammps::classic_model({{mean, &contact}})->style == "hooke/history");
  spring.spring.cap = false;
  contact.shear = spring;
  CHECK_FALSE(lammps::classic_model({{mean, &contact}}));
  CHECK(lammps::model_of(contact, mean).wrong->key == "contact.tangential.cap");
}

TEST_CASE("What LAMMPS has not is refused by its name") {
  laws::ContactLaws contact{laws::SpringDashpot::from_restitution(1e4, 0.6), laws::Coulomb{0.5}, true};
  CHECK_THAT(lammps::model_of(contact, mean).wrong->message,
             StartsWith("\"coulomb\": LAMMPS has no such law"));
  contact.shear = laws::Viscous{3};
  CHECK_THAT(lammps::model_of(contact, mean).wrong->message, StartsWith("\"viscous\""));
  contact.shear = laws::Frictionless{};
  contact.normal = laws::WaltonBraun::from_restitution(1e4, 0.6);
  CHECK(lammps::model_of(contact, mean).wrong->key == "contact.normal.law");
  contact.normal = laws::Hertz::from_stiffness(1e4);
  contact.shear = coulomb(15);  // LAMMPS's is a multiple of a damping that is not there
  CHECK(lammps::model_of(contact, mean).wrong->key == "contact.tangential.law");
}
