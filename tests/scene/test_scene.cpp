#include <catch2/catch.hpp>
#include <filesystem>

#include "beds/row.hpp"
#include "common/atomic_file.hpp"
#include "common/toml_reader.hpp"
#include "engines/soft/soft_method.hpp"
#include "example.hpp"
#include "measure/outputs.hpp"
#include "scene/world.hpp"
#include "starts/square.hpp"

using namespace chute;
using namespace chute::scene;
using namespace chute::test;

namespace scene_tests {

namespace {
Scene parse(const std::string& text, const std::vector<std::string>& settings = {}) {
  return parse_scene(text, "scene.toml", settings);
}
constexpr double pi = 3.14159265358979323846;
}  // namespace

TEST_CASE("every key of the design's example is read") {
  auto s = parse(example);
  CHECK(s.title == "Dense flow of 300 discs on a rough incline (thesis 5.2)");
  CHECK(s.units == Units::reduced);
  CHECK(s.seed == 1);
  CHECK(s.incline.theta() == Approx(0.1 * pi));
  CHECK(s.incline.gravity == 1);
  const auto* bed = s.bed.as<beds::Row>();
  REQUIRE(bed);
  CHECK(bed->diameter == 1);
  CHECK(bed->count == 30);
  CHECK(s.grains.count == 300);
  REQUIRE(s.grains.diameter);
  CHECK(s.grains.diameter->mean == 1);
  CHECK(s.grains.diameter->std == 0.05);
  CHECK(s.grains.density == Approx(6 / pi));
  CHECK(setting_of(s).mean_mass == Approx(1));
  CHECK(setting_of(s).reference().m_eff == Approx(0.5));  // of two grains
  const auto* start = s.grains.start.as<starts::Square>();
  REQUIRE(start);
  CHECK(start->spacing == 1.25);
  CHECK(start->velocity == 2);
  CHECK(start->spread == 2);
  REQUIRE(s.engine.as<soft::SoftMethod>());
  CHECK(s.engine.as<soft::SoftMethod>()->steps_per_contact == 50);
  CHECK(s.duration == 400);
  const auto& frames = s.wants<measure::FramesOutput>()->frames;
  REQUIRE(frames);
  CHECK(frames->every == 0.5);
  const auto& profiles = s.wants<measure::ProfilesOutput>()->spec;
  REQUIRE(profiles);
  CHECK(profiles->from == 200);
  CHECK(profiles->bin == 1);
  CHECK(s.wants<measure::SeriesOutput>()->series.every == 1);  // 400 rows
  CHECK(s.checkpoint == 40);                                   // a tenth of the run
  CHECK(profiles->every == 0.02);                              // 0.02 √(d/g)
}

TEST_CASE("SI scenes have Earth's gravity and need a density") {
  const auto s =
      parse(with("seed = 1", "seed = 1",
                 with("\"reduced\"", "\"SI\"", with("count = 300", "count = 300\ndensity = 2500"))));
  CHECK(s.incline.gravity == 9.81);
  CHECK(setting_of(s).mean_mass == Approx(2500 * pi / 6));
}

TEST_CASE("angles are written in degrees, radians or as a sine") {
  const auto theta = [](const std::string& line) {
    return parse(with("angle = \"18 deg\"", line)).incline.theta();
  };
  CHECK(theta("angle = \"30 deg\"") == Approx(pi / 6));
  CHECK(theta("angle = \"30deg\"") == Approx(pi / 6));
  CHECK(theta("angle = \"0.3 rad\"") == 0.3);
  CHECK(theta("angle = \"-12.5 deg\"") == Approx(-12.5 * pi / 180));
  CHECK(theta("sin = 0.5") == Approx(pi / 6));
}

TEST_CASE("the resolved scene reads back the same, for every scene of the collection") {
  std::size_t seen = 0;
  for (const auto& entry : std::filesystem::directory_iterator(CHUTE_SOURCE_DIR "/scenes")) {
    const auto name = entry.path().filename().string();
    if (entry.path().extension() != ".toml") continue;
    const auto table = parse_toml(read_file(entry.path()), name);
    if (table.contains("data") || table.contains("experiment") || table.contains("sweep"))
      continue;  // recipes, experiments, sweeps
    INFO(name);
    const auto text = to_toml(read_scene(entry.path()));
    CHECK(to_toml(parse(text)) == text);
    ++seen;
  }
  CHECK(seen >= 3);
}

TEST_CASE("the resolved scene reads back the same, with every choice") {
  for (const auto& text :
       {example, with("angle = \"18 deg\"", "sin = 0.1"), with("angle = \"18 deg\"", "angle = \"0.1 rad\""),
        with("restitution = 0.6", "damping = 0.1\nmass_scaling = \"both\""),
        with("law = \"coulomb-viscous\"\nviscosity = 1000\nfriction = 0.5", "law = \"frictionless\""),
        with("kind = \"row\"", "kind = \"disordered-row\"\ngap_max = 0.1"),
        with("integrator = \"gear5\"", "integrator = \"verlet\"\ntime_step = 1e-5"),
        with("title = \"Dense", "title = \"a \\\"quoted\\\" \\\\ title\\n with lines; Dense"),
        with("frames = { every = 0.5 }",
             "frames = { every = 0.1, from = 3 }\ncontacts = true\nimpacts = { from = 1 }"),
        with("diameter = { mean = 1.0, std = 0.05 }", "size_ratio = 1.2")}) {
    auto scene = parse(text);
    const auto resolved = to_toml(scene);
    INFO(resolved);
    auto again = parse(resolved);
    CHECK(to_toml(again) == resolved);
    CHECK(again.title == scene.title);
    CHECK(again.incline.theta() == scene.incline.theta());
    CHECK(again.grains.density == scene.grains.density);
    CHECK(again.wants<measure::SeriesOutput>()->series.every ==
          scene.wants<measure::SeriesOutput>()->series.every);
    const auto k = [](const Scene& s) {
      return std::get<laws::SpringDashpot::Keys>(s.contact.normal).stiffness;
    };
    CHECK(k(again) == k(scene));
  }
}

TEST_CASE("settings of the command line win over the file") {
  auto s = parse(example, {"grains.count=12", "grains.diameter.std=0", "incline.angle=20 deg",
                           "contact.normal.restitution=", "contact.normal.damping=3", "title=plain words",
                           "output.profiles="});
  CHECK(s.grains.count == 12);
  CHECK(s.grains.diameter->std == 0);
  CHECK(s.incline.theta() == Approx(20 * pi / 180));
  const auto& normal = std::get<laws::SpringDashpot::Keys>(s.contact.normal);
  CHECK_FALSE(normal.restitution);
  CHECK(normal.damping == 3);
  CHECK(s.title == "plain words");
  CHECK_FALSE(s.wants<measure::ProfilesOutput>()->wanted());
  CHECK(parse(example, {"incline.angle=\"20 deg\""}).incline.theta() == Approx(20 * pi / 180));
  CHECK(parse(example, {"grains.count=12", "grains.count=13"}).grains.count == 13);  // the last one counts
}

TEST_CASE("a height of profile bins that is not given is one bed diameter") {
  auto s = parse(with("diameter = 1.0\n", "diameter = 0.25\n", with(", bin = 1.0", "")));
  CHECK(s.wants<measure::ProfilesOutput>()->spec->bin == 0.25);
}

TEST_CASE("every interval of outputs is a whole number of steps where a step can be") {
  const auto step_with = [](const char* series, const char* frames) {
    const auto s =
        parse(example, {fmt::format("output={{series={{every={}}},frames={{every={}}}}}", series, frames)});
    return s.engine->step(setting_of(s));
  };
  const auto is_whole = [](double interval, double step) {
    return std::abs(interval / step - std::round(interval / step)) < 1e-6;
  };
  for (const auto& [series, frames] :
       {std::pair("0.2", "0.5"), {"0.5", "0.2"}, {"0.3", "0.5"}, {"0.07", "0.1"}})
    for (const char* every : {series, frames}) CHECK(is_whole(std::stod(every), step_with(series, frames)));
  // where one divides the other, the step is that of the shorter one alone, to the last bit
  CHECK(step_with("0.1", "0.5") == step_with("0.1", "0.1"));
  CHECK(step_with("0.3", "0.1") == step_with("0.1", "0.1"));
  // of 1 and the square root of 2 there is no such step
  CHECK(step_with("1", "1.4142135623") == step_with("1", "1"));
}

TEST_CASE("the time step resolves the contact of the smallest grains, not of the mean ones") {
  const auto s = parse(example, {"grains.diameter.std=0.2", "grains.start.spacing=1.7"});
  const auto setting = setting_of(s);
  const auto world = make_world<2>(s);
  double smallest = 1;
  for (std::size_t i = 0; i < world.grains.moving; ++i) smallest = std::min(smallest, world.grains.mass[i]);
  const double t_n = s.contact.impact(setting.reference(), laws::Pair(smallest / 2)).contact_time;
  CHECK(s.engine->step(setting) <= t_n / 50);
  CHECK(s.engine->step(setting) > 0.98 * t_n / 50);
  const auto same = parse(example, {"grains.diameter.std=0"});
  const double mean = same.contact.impact(laws::Pair(0.5)).contact_time;
  CHECK(same.engine->step(setting_of(same)) == Approx(mean / 50).epsilon(1e-3));
}

TEST_CASE("the resolved scene reads back the same, in space and on every bed and start") {
  for (const std::vector<std::string>& settings : std::vector<std::vector<std::string>>{
           {"bed={kind=\"flat\", length=30}"},
           {"bed={kind=\"none\"}", "domain.size=[30]"},
           {"dimensions=3", "domain.size=[30, 6]"},
           {"dimensions=3", "bed={kind=\"lattice\", count=30, count_across=6, arrangement=\"triangular\"}"},
           {"grains.start={kind=\"square\", spacing=1.3}"},
           {"grains.count=1", "grains.start={kind=\"none\"}"}}) {
    const auto text = to_toml(parse(example, settings));
    INFO(text);
    CHECK(to_toml(parse(text)) == text);
  }
}

namespace {

/// The example with its contacts replaced.
std::string with_contact(const std::string& contact) {
  const auto begin = example.find("[contact.normal]"), end = example.find("[engine]");
  return example.substr(0, begin) + contact + example.substr(end);
}
scene::Scene parsed(const std::string& text, const std::vector<std::string>& settings = {}) {
  return scene::parse_scene(text, "scene.toml", settings);
}

}  // namespace

TEST_CASE("a restitution alone is a scene: what it leaves open is chosen, told, and right") {
  const auto open = parsed(with_contact("[contact]\nnormal = { restitution = 0.6 }\n"));
  const auto setting = scene::setting_of(open);
  const auto contact = open.contact.laws(setting.reference());
  const auto impact = laws::normal_impact(contact, 3, setting.reference());
  CHECK(impact.restitution == Approx(0.6));
  // Impacts of 3 √(gd), and of the fastest grain of the start, overlap by a hundredth of a diameter at most.
  CHECK(setting.fastest > 3);
  const auto fastest = laws::normal_impact(contact, setting.fastest, setting.reference());
  CHECK(fastest.deepest < 0.01);
  CHECK(fastest.deepest > 0.002);
  const double dt = open.engine->step(setting);
  for (const auto& fact : open.engine->facts(setting))
    if (fact.name == "gamma_s dt 7/2m") {
      CHECK(fact.value <= 0.08);
      CHECK(fact.value > 0.03);
    }
  CHECK(dt > 0);
  REQUIRE(open.chosen.size() == 3);
  CHECK(open.chosen[0].starts_with("contact.normal.stiffness = "));
  CHECK(open.chosen[1].starts_with("contact.tangential.viscosity = "));
  CHECK(open.chosen[2] == "contact.tangential.friction = 0.5");
  // The complete scene holds them, and leaves nothing open.
  const auto again = parsed(scene::to_toml(open));
  CHECK(scene::to_toml(again) == scene::to_toml(open));
  CHECK(again.chosen.empty());
}

TEST_CASE("what a scene says is never chosen otherwise") {
  const auto some = parsed(with_contact(
      "[contact.normal]\nrestitution = 0.8\nstiffness = 2e5\n[contact.tangential]\nfriction = 0.3\n"));
  CHECK(scene::to_toml(some).find("stiffness = 200000.0") != std::string::npos);
  CHECK(scene::to_toml(some).find("friction = 0.3") != std::string::npos);
  CHECK(some.chosen.size() == 1);
  CHECK(parsed(example).chosen.empty());
  const auto bare = parsed(
      "[incline]\nangle=\"20 deg\"\n[bed]\ncount=20\n[grains]\ncount=50\ndiameter={mean=1}\n"
      "[run]\nduration=10\n[contact.normal]\nrestitution=0.5\n");
  CHECK(bare.chosen.size() == 5);  // seed and units, too
  const auto rigid = parsed(
      "[incline]\nangle=\"20 deg\"\n[bed]\ncount=20\n[grains]\ncount=50\ndiameter={mean=1}\n"
      "[run]\nduration=10\n[contact.normal]\nrestitution=0.5\n[engine]\nmethod=\"contact\"\n");
  CHECK_THAT(rigid.chosen[1], Catch::Contains("of no effect"));  // rigid grains have no slip that dies away
}

}  // namespace scene_tests
