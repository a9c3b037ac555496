#include <algorithm>
#include <catch2/catch.hpp>

#include "common/error.hpp"
#include "example.hpp"
#include "scene/scene.hpp"
#include "scene/world.hpp"

using namespace chute;
using namespace chute::test;

namespace errors_tests {

namespace {

std::string refused(const std::string& text, const std::vector<std::string>& settings = {}) {
  try {
    scene::make_world<2>(scene::parse_scene(text, "scene.toml", settings));
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}
std::string refused(const std::string& from, const std::string& to) { return refused(with(from, to)); }
std::string set(const std::string& setting) { return refused(example, std::vector<std::string>{setting}); }

}  // namespace

TEST_CASE("an unknown key is answered with its line and the nearest key") {
  CHECK(refused("spacing =", "spacng =") ==
        "scene.toml:13: grains.start.spacng: unknown key, did you mean spacing?");
  CHECK(refused("seed = 1", "sede = 1") == "scene.toml:3: sede: unknown key, did you mean seed?");
  CHECK(refused("[run]\nduration", "[run]\ndurations") ==
        "scene.toml:27: run.durations: unknown key, did you mean duration?");
  CHECK(refused("count = 300", "cuont = 300") ==
        "scene.toml:11: grains.cuont: unknown key, did you mean count?");
  CHECK(refused("[engine]", "[engin]") == "scene.toml:22: engin: unknown key, did you mean engine?");
  CHECK(refused("[output]", "[outptu]") == "scene.toml:28: outptu: unknown key, did you mean output?");
  CHECK(
      refused("method = \"soft\"", "colour = \"red\"") ==
      "scene.toml:23: engine.colour: unknown key, known: method, integrator, contact_ends, steps_per_contact, time_step, "
      "deepest_overlap");
}

TEST_CASE("a wrong type says what was written and what is wanted") {
  CHECK(refused("count = 300", "count = \"many\"") ==
        "scene.toml:11: grains.count: 'many' is not a whole number");
  CHECK(refused("count = 300", "count = 3.5") == "scene.toml:11: grains.count: 3.5 is not a whole number");
  CHECK(refused("stiffness = 5e6", "stiffness = true") ==
        "scene.toml:16: contact.normal.stiffness: true is not a number");
  CHECK(refused("title = \"Dense flow of 300 discs on a rough incline (thesis 5.2)\"", "title = 3") ==
        "scene.toml:1: title: 3 is not a text in quotes");
  CHECK(refused("frames = { every = 0.5 }", "frames = 3") ==
        "scene.toml:29: output.frames: must be a table: [output.frames]");
}

TEST_CASE("a run of more steps than can be counted is refused") {
  const auto said = set("run.duration=1e50");
  INFO(said);
  CHECK(said.find("run.duration: 1e+50 takes ") != said.npos);
  CHECK(said.find("more than 1e+15") != said.npos);
  CHECK(set("run.duration=1e6") == "accepted");
  CHECK_THAT(set("run.duration=1e9"), Catch::Contains("output.frames.every: 0.5 makes 2e+09 of them"));
  CHECK(refused(example, std::vector<std::string>{"engine.time_step=1e-7", "run.duration=1e9"})
            .find("run.duration: ") != said.npos);
}

TEST_CASE("a number out of range says the range") {
  CHECK(refused("diameter = 1.0", "diameter = -1.0") ==
        "scene.toml:8: bed.diameter: -1 is not allowed, must be > 0");
  CHECK(refused("mean = 1.0", "mean = -0.5") ==
        "scene.toml:12: grains.diameter.mean: -0.5 is not allowed, must be > 0");
  CHECK(refused("restitution = 0.6", "restitution = 1.5") ==
        "scene.toml:17: contact.normal.restitution: 1.5 is not allowed, must be in (0, 1]");
  CHECK(refused("restitution = 0.6", "restitution = 0") ==
        "scene.toml:17: contact.normal.restitution: 0 is not allowed, must be in (0, 1]");
  CHECK(refused("friction = 0.5", "friction = -0.1") ==
        "scene.toml:21: contact.tangential.friction: -0.1 is not allowed, must be >= 0");
  CHECK(refused("duration = 400", "duration = inf") ==
        "scene.toml:27: run.duration: inf is not allowed, must be > 0");
  CHECK(refused("duration = 400", "duration = nan") ==
        "scene.toml:27: run.duration: nan is not allowed, must be > 0");
}

TEST_CASE("a word that is not known is answered with the nearest one") {
  CHECK(refused("kind = \"row\"", "kind = \"rwo\"")
            .starts_with("scene.toml:7: bed.kind: \"rwo\" is not known, did you mean \"row\"?, allowed: row, "
                         "disordered-row"));
  CHECK(refused("law = \"spring-dashpot\"", "law = \"spring-dahspot\"")
            .starts_with("scene.toml:15: contact.normal.law: \"spring-dahspot\" is not known, did you mean "
                         "\"spring-dashpot\"?, allowed: spring-dashpot"));
}

TEST_CASE("what is required is said to be missing, at the table that lacks it") {
  CHECK(refused("friction = 0.5\n", "") ==
        "scene.toml:18: contact.tangential.friction: missing, but required");
  CHECK(refused("[run]\nduration = 400\n", "") == "scene.toml:1: run: missing, but required");
  CHECK(refused("\"reduced\"", "\"SI\"") ==
        "scene.toml:10: grains: density is missing; SI scenes need it (kg/m³)");
  CHECK(refused(std::string()) ==
        "scene.toml:1: incline: missing, but required\nscene.toml:1: bed: missing, but required\n"
        "scene.toml:1: grains: missing, but required\nscene.toml:1: contact: missing, but required\n"
        "scene.toml:1: run: missing, but required");
}

TEST_CASE("several slips are told at once, each with its line, and none that follows from another") {
  auto text = with("count = 30\n", "count = -30\n");
  text = with("restitution = 0.6 ", "restitution = 1.6 ", text);
  text = with("viscosity = 1000", "viscosty = 1000", text);
  text = with("duration = 400", "duration = \"long\"", text);
  text = with("bin = 1.0", "bins = 1.0", text);
  CHECK(refused(text) ==
        "scene.toml:9: bed.count: -30 is not allowed, must be in [3, 10000000]\n"
        "scene.toml:17: contact.normal.restitution: 1.6 is not allowed, must be in (0, 1]\n"
        "scene.toml:20: contact.tangential.viscosty: unknown key, did you mean viscosity?\n"
        "scene.toml:27: run.duration: 'long' is not a number\n"
        "scene.toml:30: output.profiles.bins: unknown key, did you mean bin?");
  // Not more than ten.
  std::string many = example;
  for (int k = 0; k < 20; ++k) many = "nonsense_" + std::to_string(k) + " = 1\n" + many;
  const auto said = refused(many);
  CHECK(std::count(said.begin(), said.end(), '\n') == 9);
  // A word that decides which keys there are is the last thing that can be said.
  CHECK(refused(with("method = \"soft\"", "method = \"sfot\"", with("count = 30\n", "count = -30\n")))
            .starts_with("scene.toml:23: engine.method: \"sfot\" is not known"));
}

TEST_CASE("a key outside of its table is answered with where it belongs") {
  CHECK(refused("seed = 1", "gravity = 9.81") ==
        "scene.toml:3: gravity: unknown key, did you mean incline.gravity?");
  CHECK(refused("seed = 1", "friction = 0.3").starts_with("scene.toml:3: friction: unknown key"));
}

TEST_CASE("of two that exclude each other exactly one is wanted") {
  const std::string angle = "incline.angle: give either angle = \"18 deg\" or sin = 0.31, or tan = 0.32";
  CHECK(refused("angle = \"18 deg\"", "angle = \"18 deg\"\nsin = 0.3") ==
        "scene.toml:6: incline.sin: give either angle = \"18 deg\" or sin = 0.31, or tan = 0.32");
  CHECK(refused("angle = \"18 deg\"", "") == "scene.toml:4: " + angle);
  CHECK(refused("restitution = 0.6", "restitution = 0.6\ndamping = 3.0") ==
        "scene.toml:18: contact.normal.damping: give either restitution or damping");
  CHECK(refused("restitution = 0.6", "") ==
        "scene.toml:14: contact.normal.restitution: give either restitution or damping");
  CHECK(refused("count = 300", "count = 300\nsize_ratio = 2.0")
            .starts_with("scene.toml:12: grains.size_ratio: give either"));
}

TEST_CASE("angles that are none") {
  const auto angle = [](const std::string& value) { return refused("\"18 deg\"", value); };
  for (const char* text : {"18", "steep", "18 degrees", "deg", "", "inf deg", "18 deg 5", "0x1f rad"})
    CHECK(angle('"' + std::string(text) + '"') == "scene.toml:5: incline.angle: \"" + std::string(text) +
                                                      "\" is not an angle, write \"18 deg\" or \"0.3 rad\"");
  CHECK(angle("\"100 deg\"") ==
        "scene.toml:5: incline.angle: \"100 deg\" is not allowed, must be between -90 deg and 90 deg");
  CHECK(angle("18") == "scene.toml:5: incline.angle: 18 is not a text in quotes");
}

TEST_CASE("settings that are wrong say so, and that they came from --set") {
  CHECK(set("grains.count") == "--set grains.count: expected key=value");
  CHECK(set("=3") == "--set =3: expected key=value");
  CHECK(set("grains..count=3") == "--set grains..count: empty key");
  CHECK(set("grains.count=-3") ==
        "--set grains.count: grains.count: -3 is not allowed, must be in [1, 10000000]");
  CHECK(set("grains.cuont=3") == "--set grains.cuont: grains.cuont: unknown key, did you mean count?");
  CHECK(set("contact=3") == "--set contact: contact: must be a table: [contact]");
  CHECK(set("run.duration=") == "scene.toml:26: run.duration: missing, but required");
}

TEST_CASE("a required key under a misspelt name is named, not the rule that misses it") {
  CHECK(refused("stiffness = 5e6", "stifness = 5e6")
            .ends_with(": contact.normal.stifness: unknown key, did you mean stiffness?"));
  CHECK(refused("duration = 400", "duraton = 400")
            .ends_with(": run.duraton: unknown key, did you mean duration?"));
}

TEST_CASE("what is not TOML is refused with its line") {
  CHECK(refused("[bed]", "[bed").starts_with("scene.toml:6: not TOML: "));
  CHECK(refused("count = 30\n", "count = \n").starts_with("scene.toml:9: not TOML: "));
  CHECK(refused(std::string("\xff\xfe")).starts_with("scene.toml:1: not TOML: "));
  for (const auto& text : {std::string("[bed"), std::string("a = 1\na = 2"), std::string("\xff\xfe")})
    CHECK(refused(text).find('\n') == std::string::npos);
}

TEST_CASE("grains that do not fit are refused at the key to change") {
  for (const auto& [from, to, key] : {std::tuple{"spacing = 1.25", "spacing = 0.5", "grains.start.spacing"},
                                      {"count = 30\n", "count = 3\n", "bed.count"}}) {
    const auto says = refused(from, to);
    INFO(says);
    CHECK(says.find(key) != says.npos);
    CHECK(says.starts_with("scene.toml"));  // a wrong file is named
  }
}

}  // namespace errors_tests
