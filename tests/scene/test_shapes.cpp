// [[grains.shape]] in scenes: what is read, written and made. What is refused stands in tests/wrong.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "scene/forms.hpp"
#include "scene/scene.hpp"
#include "scene/world.hpp"

using namespace chute;

namespace shapes_tests {

namespace {

scene::Scene shaped(const std::string& shapes, const std::vector<std::string>& settings = {}) {
  static const std::string rest = R"(
[incline]
angle = "0 deg"
[bed]
kind = "row"
count = 40
[grains]
count = 60
diameter = { mean = 1.0, std = 0.1 }
start = { lattice = "square", spacing = 3, spin = [2] }
[contact.normal]
law = "spring-dashpot"
stiffness = 1e5
restitution = 0.6
[contact.tangential]
law = "frictionless"
[run]
duration = 1
)";
  return scene::parse_scene(rest + shapes, "shapes.toml", settings);
}

const std::string rods = "[[grains.shape]]\naspect = 2\n";
const std::string two_kinds = rods +
                              "share = 2\n[[grains.shape]]\nmember = [{ at = [0, 0], radius = 1 }, "
                              "{ at = [1, 0.5], radius = 0.5 }]\norientation = \"written\"\n";

}  // namespace

TEST_CASE("shapes are written back as they were read, with their defaults") {
  const auto scene = shaped(two_kinds);
  const auto text = scene::to_toml(scene);
  CHECK(text.find("[[grains.shape]]\naspect = 2.0\n") != std::string::npos);
  CHECK(text.find("[[grains.shape.member]]\nat = [1.0, 0.5]\nradius = 0.5\n") != std::string::npos);
  CHECK(scene::to_toml(scene::parse_scene(text, "again.toml")) == text);
  CHECK(scene::to_toml(shaped("")).find("shape") == std::string::npos);
}

TEST_CASE("grains of any shape weigh what round ones of their diameter weigh") {
  const auto world = scene::make_world<2>(shaped(two_kinds)), round = scene::make_world<2>(shaped(""));
  REQUIRE(world.grains.moving == 60);
  REQUIRE(world.clumps.form.size() == 60);
  int of_rods = 0;
  for (std::size_t i = 0; i < 60; ++i) {
    CHECK(world.grains.mass[i] == Approx(round.grains.mass[i]).epsilon(1e-12));
    CHECK(world.clumps.scale[i] == Approx(round.grains.radius[i]).epsilon(1e-12));
    CHECK(world.grains.spin[0][i] == 2);
    of_rods += world.clumps.form[i] == 0;
    if (world.clumps.form[i] == 1) CHECK(world.grains.orientation[0][i] == 0);
  }
  CHECK(of_rods > 30);  // 40 of 60 on average, with a standard deviation of 3.7
  CHECK(of_rods < 52);
}

TEST_CASE("shapes can be those of materials, and grains of a material without one are round") {
  const std::string materials =
      "[[material]]\nname = \"wood\"\nshare = 0.5\ndensity = 0.5\n[[material]]\nname = "
      "\"steel\"\nshare = 0.5\ndensity = 8\n";
  const auto named = [](const std::string& shape, const char* material) {
    return shape + "material = \"" + material + "\"\n";
  };
  const auto world = scene::make_world<2>(shaped(named(rods, "wood") + materials)),
             round = scene::make_world<2>(shaped(materials));
  REQUIRE(world.clumps.forms.size() == 2);
  CHECK(world.clumps.forms[1].members.size() == 1);
  for (std::size_t i = 0; i < 60; ++i) {
    CHECK(world.grains.material[i] == round.grains.material[i]);
    CHECK(world.grains.mass[i] == Approx(round.grains.mass[i]).epsilon(1e-12));
    CHECK(world.clumps.form[i] == world.grains.material[i]);
  }
  // A shape of no material is for those that no other names; where every material has one, nobody is round.
  const auto both =
      scene::make_world<2>(shaped(named(rods, "steel") + "[[grains.shape]]\naspect = 3\n" + materials));
  REQUIRE(both.clumps.forms.size() == 2);
  for (std::size_t i = 0; i < 60; ++i) CHECK(both.clumps.form[i] == 1 - both.grains.material[i]);
}

TEST_CASE("the step sees the tips of light rods, and not those that heavy ones would have") {
  const auto step = [](const std::string& rod, const std::string& light) {
    const auto scene =
        shaped("[[material]]\nname = \"a\"\nshare = 0.5\ndensity = " + light +
                   "\n[[material]]\nname = \"b\"\nshare = 0.5\n"
                   "density = 8\n[[contact.between]]\nmaterials = [\"a\", \"b\"]\nrestitution = 0.6\n" +
                   (rod.empty() ? "" : rods + "material = \"" + rod + "\"\n"),
               {"grains.diameter.std=0", "output.series.every=1e6"});
    return scene.engine->step(scene::setting_of(scene));
  };
  const double tip = std::sqrt(scene::sizes_of_forms(shaped(rods)).front().lightest);
  CHECK(step("", "1") / step("", "4") == Approx(0.5).epsilon(1e-2));
  CHECK(step("a", "1") / step("", "1") == Approx(tip).epsilon(1e-2));
  CHECK(step("b", "1") == Approx(step("", "1")).epsilon(1e-2));
}

TEST_CASE("orientations are drawn evenly, in the plane and in space") {
  const auto flat = scene::make_world<2>(shaped(rods, {"grains.count=400"}));
  double cosine = 0;
  for (const double angle : flat.grains.orientation[0]) cosine += angle == 0 ? 0 : std::cos(angle);
  CHECK(std::abs(cosine) < 3 * std::sqrt(200.0));
  const auto solid = scene::make_world<3>(
      shaped(rods, {"dimensions=3", "grains.count=400", "domain.size=[40,9]", "grains.start.spin="}));
  double along_z = 0;  // of the rods, which lie along x in their own frame: the mean of cos² is 1/3
  for (std::size_t i = 0; i < 400; ++i) {
    const auto q = solid.grains.attitude(i);
    CHECK(norm(q) == Approx(1).epsilon(1e-14));
    along_z += std::pow(2 * (q[1] * q[3] - q[0] * q[2]), 2) / 400;
  }
  CHECK(std::abs(along_z - 1.0 / 3) < 3 * std::sqrt(4.0 / 45 / 400));
}

TEST_CASE("one sphere is a round grain: the same world to the last bit, and the same step") {
  const auto one = shaped("[[grains.shape]]\naspect = 1\n"), round = shaped("");
  const auto a = scene::make_world<2>(one), b = scene::make_world<2>(round);
  for (std::size_t i = 0; i < a.grains.size(); ++i) {
    CHECK(a.grains.radius[i] == b.grains.radius[i]);
    CHECK(a.grains.mass[i] == b.grains.mass[i]);
    CHECK(a.grains.inertia[i] == b.grains.inertia[i]);
    CHECK(a.grains.position[1][i] == b.grains.position[1][i]);
  }
  CHECK(one.engine->step(scene::setting_of(one)) == round.engine->step(scene::setting_of(round)));
}

TEST_CASE("the step resolves the contact of two tips") {
  const auto rod = shaped(rods), round = shaped("");
  const auto tips = scene::setting_of(rod).shortest();
  CHECK(tips.name == "the tips of two grains");
  const auto world = scene::make_world<2>(rod);
  const double smallest = *std::min_element(world.clumps.scale.begin(), world.clumps.scale.end());
  const auto& form = world.clumps.forms.front();
  const double at = norm(form.members.front().at);
  CHECK(tips.pair.m_eff ==
        Approx(0.5 * std::pow(2 * smallest, 3) / (1 + at * at / form.gyration[0])).epsilon(1e-12));
  CHECK(rod.engine->step(scene::setting_of(rod)) < 0.9 * round.engine->step(scene::setting_of(round)));
}

}  // namespace shapes_tests
