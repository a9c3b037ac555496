#include <catch2/catch.hpp>

#include "../runs/make_engine.hpp"
#include "common/error.hpp"
#include "run/facts.hpp"
#include "scene/world.hpp"

using namespace chute;

namespace {

/// An SI scene of steel balls with the given contact tables.
std::string text(const std::string& contact) {
  return R"(units = "SI"
[incline]
sin = 0.2
[bed]
diameter = 0.01
count = 10
[grains]
count = 4
diameter = { mean = 0.01 }
density = 7800
[run]
duration = 1e-3
)" + contact;
}

scene::Scene parse(const std::string& contact) { return scene::parse_scene(text(contact), "test.toml"); }

laws::Pair reference_pair(const scene::Scene& s) { return scene::setting_of(s).reference(); }

laws::NormalImpact impact_of(const scene::Scene& s) { return s.contact.impact(reference_pair(s)); }

const std::string frictionless = "[contact.tangential]\nlaw = \"frictionless\"\n";
std::string normal(const std::string& keys) { return "[contact.normal]\n" + keys + "\n" + frictionless; }
std::string shear(const std::string& keys) {
  return "[contact.normal]\nlaw = \"spring-dashpot\"\nstiffness = 1e6\nrestitution = "
         "0.7\n[contact.tangential]\n" +
         keys + "\n";
}

std::string failure(const std::string& contact) {
  try {
    parse(contact);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("Parameters as restitution and contact time, as a material, or raw") {
  for (const std::string more : {"", "attraction = false"}) {
    const auto asked = [&](const std::string& keys) {
      return impact_of(parse((more.empty() ? "" : "[contact]\n" + more + "\n") + normal(keys)));
    };
    for (const std::string law : {"spring-dashpot", "hertz-linear-damping", "hertz-kuwabara-kono"}) {
      INFO(law << " " << more);
      const std::string at = law == "spring-dashpot" ? "" : "\nat_velocity = 2";
      const auto by_time = asked("law = \"" + law + "\"\ncontact_time = 3e-5\nrestitution = 0.6" + at);
      CHECK(by_time.restitution == Approx(0.6).epsilon(1e-6));
      CHECK(by_time.contact_time == Approx(3e-5).epsilon(1e-6));
      if (law == "spring-dashpot") continue;
      const auto material =
          asked("law = \"" + law + "\"\nyoung = 2e11\npoisson = 0.3\nrestitution = 0.9" + at);
      CHECK(material.restitution == Approx(0.9).epsilon(1e-6));
      const auto elastic = laws::Hertz::from_material(2e11, 0.3).contact_time(
          2, reference_pair(parse(normal("law = \"hertz\"\nyoung = 2e11\npoisson = 0.3\nat_velocity = 2"))));
      CHECK(material.contact_time == Approx(elastic).epsilon(0.02));
    }
  }
  CHECK(impact_of(parse(normal("law = \"hertz\"\ncontact_time = 4e-5\nat_velocity = 3"))).contact_time ==
        Approx(4e-5));
  CHECK(impact_of(parse(normal("law = \"walton-braun\"\nstiffness = 1e6\nrestitution = 0.7"))).restitution ==
        Approx(0.7));
  CHECK(impact_of(parse(normal("law = \"walton-braun\"\nstiffness = 1e6\nunloading_stiffness = 4e6")))
            .restitution == Approx(0.5));
  const auto hard =
      parse(normal("law = \"walton-braun\"\nstiffness = 1e6\nhardening = 1e4\nat_velocity = 1"));
  CHECK(impact_of(hard).restitution ==
        Approx(std::pow(1e4 * std::sqrt(reference_pair(hard).m_eff / 1e6) + 1, -0.5)));
  const auto kono = parse(normal(
      "law = \"hertz-kuwabara-kono\"\nyoung = 1e9\npoisson = 0.3\nrelaxation = 1e-6\nat_velocity = 1"));
  const auto law = std::get<laws::HertzKuwabaraKono>(kono.contact.laws(reference_pair(kono)).normal);
  CHECK(law.damping(reference_pair(kono)) == Approx(1.5e-6 * law.stiffness(reference_pair(kono))));
}

TEST_CASE("Every law can be named, runs, and its scene reads back the same") {
  const std::vector<std::string> normals = {
      "law = \"spring-dashpot\"\nstiffness = 1e6\nrestitution = 0.7",
      "law = \"spring-dashpot\"\nstiffness = 1e6\ndamping = 1.5\nmass_scaling = \"damping\"",
      "law = \"hertz\"\nstiffness = 1e9\nat_velocity = 1",
      "law = \"hertz-linear-damping\"\nstiffness = 1e9\ndamping = 2\nat_velocity = 1",
      "law = \"hertz-kuwabara-kono\"\nyoung = 1e9\npoisson = 0.3\nrestitution = 0.8\nat_velocity = 1",
      "law = \"walton-braun\"\nstiffness = 1e6\nrestitution = 0.7"};
  const std::vector<std::string> shears = {
      "law = \"frictionless\"",
      "law = \"coulomb-viscous\"\nviscosity = 10\nfriction = 0.3",
      "law = \"coulomb\"\nfriction = 0.3",
      "law = \"viscous\"\nviscosity = 10",
      "law = \"cundall-strack\"\nfriction = 0.3\nstiffness = 3e5",
      "law = \"cundall-strack\"\nfriction = 0.3\nstiffness = 3e5\ncap = false",
      "law = \"mindlin\"\nfriction = 0.3\nstiffness = 5e8",
      "law = \"walton-braun-mindlin\"\nfriction = 0.3\nstiffness = 6e5",
      "law = \"saw-tooth\"\nfriction = 0.3\ntooth = 1e-6"};
  for (const auto& n : normals)
    for (const auto& t : shears) {
      const auto scene = parse("[contact.normal]\n" + n + "\n[contact.tangential]\n" + t + "\n");
      const auto resolved = scene::to_toml(scene);
      CHECK(scene::to_toml(scene::parse_scene(resolved, "again.toml")) == resolved);
      auto made = test::make_engine(scene);
      made.engine->advance_to(2000);
      CHECK(std::isfinite(made.engine->energy().stored()));
      CHECK(run::facts(scene).size() > 8);
    }
}

TEST_CASE("k_s/k_n follows the normal law of each pair") {
  const auto scene = parse(
      "[contact.normal]\nlaw = \"hertz-kuwabara-kono\"\nyoung = 1e9\npoisson = 0.3\nrestitution = 0.8\n"
      "at_velocity = 1\n[contact.tangential]\nlaw = \"mindlin\"\nfriction = 0.3\nstiffness_ratio = 0.8\n");
  const auto laws = scene.contact.laws(reference_pair(scene));
  const laws::Pair other(1, 0.7);
  CHECK(std::get<laws::MindlinSpring>(laws.shear).stiffness(other) ==
        Approx(0.8 * std::get<laws::HertzKuwabaraKono>(laws.normal).stiffness(other)));
  const auto linear =
      parse(shear("law = \"cundall-strack\"\nfriction = 0.3\nstiffness_ratio = 0.2857142857"));
  for (const auto& fact : run::facts(linear))
    if (fact.name == "t_s/t_n")  // (3.15): 1 at 2/7, but for the damping of the normal motion
      CHECK(fact.value == Approx(std::sqrt(1 / (1 + std::pow(std::log(0.7) / M_PI, 2)))).epsilon(1e-6));
}

TEST_CASE("Wrong combinations are refused with the key that is wrong") {
  CHECK_THAT(failure(normal("law = \"hertz\"\nstiffness = 1e9")), Catch::Contains("at_velocity"));
  CHECK_THAT(
      failure(normal("law = \"spring-dashpot\"\nstiffness = 1e6\ncontact_time = 1e-5\nrestitution = 0.7")),
      Catch::Contains("either stiffness or contact_time"));
  CHECK_THAT(failure(normal("law = \"spring-dashpot\"\nstiffness = 1e6")),
             Catch::Contains("restitution or damping"));
  CHECK_THAT(failure(normal("law = \"spring-dashpot\"\nstiffness = 1e6\nrestitution = 0.7\nyoung = 1e9")),
             Catch::Contains("young"));
  CHECK_THAT(failure(normal("law = \"hertz\"\nyoung = 1e9\nat_velocity = 1")), Catch::Contains("poisson"));
  CHECK_THAT(failure(normal("law = \"walton-braun\"\nstiffness = 1e6\nunloading_stiffness = 1e5")),
             Catch::Contains("unloading_stiffness"));
  CHECK_THAT(
      failure(normal("law = \"hertz-linear-damping\"\nstiffness = 1e9\ndamping = 1e6\nat_velocity = 1")),
      Catch::Contains("never part"));
  CHECK_THAT(failure(shear("law = \"cundall-strack\"\nfriction = 0.3")), Catch::Contains("stiffness_ratio"));
  CHECK_THAT(failure(shear("law = \"mindlin\"\nfriction = 0.3\nstiffness_ratio = 0.5")),
             Catch::Contains("Hertz"));
  CHECK_THAT(failure(shear("law = \"saw-tooth\"\nfriction = 0.3")), Catch::Contains("tooth"));
  CHECK_THAT(failure(shear("law = \"coulom\"\nfriction = 0.3")), Catch::Contains("coulomb"));
}
