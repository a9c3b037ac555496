// [[wall]] in scenes: what is read, written, made, and refused.
#include <catch2/catch.hpp>

#include "common/error.hpp"
#include "scene/scene.hpp"
#include "scene/world.hpp"

using namespace chute;

namespace walls_tests {

namespace {

/// A scene with these lines as its walls.
scene::Scene with(const std::string& walls, const std::vector<std::string>& settings = {}) {
  static const std::string rest = R"(
units = "reduced"
[incline]
angle = "0 deg"
[domain]
periodic = []
size = [10, 10]
[bed]
kind = "none"
[grains]
count = 4
diameter = { mean = 1.0, std = 0.0 }
start = { lattice = "square", spacing = 1.25, spread = 0.5 }
[contact.normal]
law = "spring-dashpot"
stiffness = 1e5
restitution = 0.6
[contact.tangential]
law = "coulomb-viscous"
viscosity = 300
friction = 0.5
[run]
duration = 1
)";
  return scene::parse_scene(rest + walls, "walls.toml", settings);
}

std::string refused(const std::string& wall, const std::vector<std::string>& settings = {}) {
  try {
    with("[[wall]]\n" + wall, settings);
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing";
}

}  // namespace

TEST_CASE("walls of a scene stand where they are asked for, and the written scene has them") {
  const auto scene = with(
      "[[wall]]\npoint = [0, -1]\nnormal = [0, 2]\nfriction = 0.2\nrestitution = 0.9\n"
      "[[wall]]\nfrom = [0, 0]\nto = [4, 0]\noscillation = { amplitude = 0.1, frequency = 2 }\n"
      "[[wall]]\nradius = 5\npoint = [5, 5]\nspin = 0.3\nvelocity = [0.1, 0]\n");
  const auto world = scene::make_world<2>(scene);
  REQUIRE(world.walls.size() == 3);
  CHECK(world.walls[0].normal == Vec<2>{{0, 1}});
  CHECK(world.walls[0].surface.friction == 0.2);
  CHECK(world.walls[1].height({{5, 0}}) == Approx(1));  // beyond its end
  CHECK(world.walls[1].motion.amplitude == 0.1);
  CHECK(world.walls[2].height({{5, 6}}) == Approx(4));
  CHECK(scene::to_toml(scene) == scene::to_toml(scene::parse_scene(scene::to_toml(scene), "again")));
  const auto space = with("[[wall]]\ncorners = [[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0]]\n",
                          {"dimensions=3", "domain.size=[10, 10, 10]"});
  CHECK(scene::make_world<3>(space).walls[0].height({{2, 2, 3}}) == Approx(3));
  CHECK(scene::to_toml(space) == scene::to_toml(scene::parse_scene(scene::to_toml(space), "again")));
}

TEST_CASE("a bad wall gets one line with file, line and key") {
  for (const auto& [wall, message] : std::vector<std::pair<std::string, std::string>>{
           {"friction = 0.1", "walls.toml:24: wall[0]: lacks its shape, give one: a plane (point, normal)"},
           {"normal = [0, 1]", "wall[0].point: missing: where is the plane?"},
           {"point = [0, 0]\nnormal = [0, 0]",
            "walls.toml:26: wall[0].normal: has no direction, must not be 0"},
           {"point = [0, 0]\nnormal = [0, 1]\nfrom = [0, 0]\nto = [1, 0]",
            "wall[0]: is several things at once"},
           {"point = [0, 0]\nfrom = [0, 0]\nto = [1, 0]", "wall[0].point: belongs to planes and cylinders"},
           {"from = [0, 0]", "wall[0].to: missing: a segment has two ends"},
           {"from = [0, 0]\nto = [0, 0]", "wall[0].to: is the same place as from"},
           {"point = [0, 0, 0]\nnormal = [0, 1]", "wall[0].point: has 3 numbers, needed 2"},
           {"corners = [[0, 0], [1, 0], [1, 1]]", "wall[0].corners: a polygon is a wall in 3D"},
           {"radius = 3\naxis = [0, 1]", "wall[0].axis: belongs to cylinders in 3D"},
           {"point = [0, 0]\nnormal = [0, 1]\nspin = 1",
            "wall[0].spin: only a cylinder can turn in its place"},
           {"radius = 3\noscillation = { amplitude = 1, frequency = 1 }",
            "wall[0].oscillation: a cylinder has no normal"},
           {"point = [0, 0]\nnormall = [0, 1]", "wall[0].normall: unknown key, did you mean normal?"},
           {"point = [0, 0]\nnormal = [0, 1]\nstatic_friction = 1",
            "wall[0].static_friction: engine.method = \"soft\" knows one friction only"},
           {"point = [0, 0]\nnormal = [0, 1]\ntangential_restitution = 1",
            "wall[0].tangential_restitution: engine.method = \"soft\" knows no"},
           {"point = [0, 0]\nnormal = [0, 1]\nrestitution = 0",
            "wall[0].restitution: 0 is not allowed for soft grains"}})
    CHECK_THAT(refused(wall), Catch::Contains(message));
  const std::string plane = "point = [0, 0]\nnormal = [0, 1]";
  CHECK_THAT(refused(plane, {"engine.method=stochastic"}),
             Catch::Contains("engine.method = \"stochastic\" knows no walls"));
  CHECK_THAT(refused(plane + "\nfriction = 0.1", {"contact.tangential={law=\"frictionless\"}"}),
             Catch::Contains("wall[0].friction: the law of [contact.tangential] has no friction"));
  CHECK_THAT(refused("from = [0, 0]\nto = [9, 0]", {"domain.periodic=[\"x\"]"}),
             Catch::Contains("is 9 long: with a grain it does not fit"));
  CHECK_THAT(refused("corners = [[0, 0, 0], [4, 0, 0], [1, 1, 0], [0, 4, 0]]", {"dimensions=3"}),
             Catch::Contains("wall[0].corners: must go round a flat convex polygon"));
}

TEST_CASE("an incline tilts in time, if the method can") {
  const std::vector<std::string> tilt{"incline.angle={from=\"0 deg\", to=\"20 deg\", rate=\"1 deg\"}"};
  const auto scene = with("", tilt);
  const auto world = scene::make_world<2>(scene);
  CHECK(world.gravity_at(0)[0] == 0);
  CHECK(world.gravity_at(10)[0] == Approx(std::sin(10 * M_PI / 180)));
  CHECK(world.gravity_at(100)[0] == Approx(std::sin(20 * M_PI / 180)));
  const auto back = scene::make_world<2>(with("", {tilt[0], "incline.angle.then=\"5 deg\""}));
  CHECK(back.gravity_at(20)[0] == Approx(std::sin(20 * M_PI / 180)));
  CHECK(back.gravity_at(25)[0] == Approx(std::sin(15 * M_PI / 180)));
  CHECK(scene::to_toml(scene) == scene::to_toml(scene::parse_scene(scene::to_toml(scene), "again")));
  const auto wrong = [&](std::string key, std::string value) {
    try {
      with("", {tilt[0], key + "=" + value});
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("nothing");
  };
  CHECK_THAT(wrong("engine.method", "event"),
             Catch::Contains("incline.angle: engine.method = \"event\" keeps the incline where it is"));
  CHECK_THAT(wrong("incline.angle.rate", "\"0 deg\""),
             Catch::Contains("incline.angle.rate: \"0 deg\" is not allowed, must be > 0"));
  CHECK_THAT(wrong("incline.angle.to", "\"steep\""),
             Catch::Contains("incline.angle.to: \"steep\" is not an angle"));
  CHECK_THAT(wrong("incline.angle.then", "\"back\""),
             Catch::Contains("incline.angle.then: \"back\" is not an angle"));
}

}  // namespace walls_tests
