// Methods without dynamics as runs of scenes: packings, gases and shaking, and what other methods make of their packings.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <fstream>

#include "common/error.hpp"
#include "folder.hpp"
#include "make_engine.hpp"
#include "run/run.hpp"

using namespace chute;
using namespace chute::test;

namespace statistical_tests {

namespace {

std::vector<std::string> small_packing() {
  return {"grains.count=200", "domain.size=[20]", "run.duration=3", "output.frames={every=1}"};
}

}  // namespace

TEST_CASE(
    "runs that count shakes or sweeps say so, and are the same bytes, interrupted or not, with any number of threads") {
  const Folder folder;
  const auto check = [&](const std::string& file, const std::string& clock,
                         std::vector<std::string> settings) {
    settings.push_back("output.checkpoint=1");
    const auto scene = scene::read_scene(scenes + file, settings);
    run::RunOptions options;
    options.directory = folder / ("whole" + file);
    run::run_scene(scene, options);
    CHECK_THAT(content(options.directory / "run.json"), Catch::Contains("\"clock\": \"" + clock + "\""));
    CHECK_THAT(content(options.directory / "series.csv"), Catch::Contains("\n" + clock + ",x,"));
    const auto parts = folder / ("parts" + file);
    options.directory = parts;
    options.threads = 2;
    int calls = 0;
    options.progress = [&](double) { return ++calls < 2; };
    const bool done = run::run_scene(scene, options).finished;
    options.existing = run::Existing::resume;
    options.progress = nullptr;
    if (!done) CHECK(run::run_scene(scene, options).finished);
    for (const auto& [name, bytes] : tree(folder / ("whole" + file)))
      if (name != "run.json") CHECK(content(parts / name) == bytes);
  };
  auto packing = small_packing();
  packing.push_back("engine.jolt=0.1");
  check("packing-2d.toml", "shakes", packing);
  check("packing-3d.toml", "shakes", {"grains.count=150", "domain.size=[5, 5]", "run.duration=3"});
  check("mehta-barker.toml", "shakes",
        {"grains.count=150", "domain.size=[5, 5]", "run.duration=4", "engine.sweeps=100",
         "output.frames={every=2}"});
  check("tonks-column.toml", "sweeps",
        {"run.duration=60", "output.frames={every=20}", "output.series.every=10",
         "output.heights={from=10, every=5}"});
  check("hard-discs.toml", "sweeps",
        {"run.duration=60", "output.frames={every=20}", "output.series.every=10",
         "output.pairs={from=10, every=10}", "engine.equilibrate=20"});
  check("shake-brazil-nut.toml", "shakes",
        {"grains.count=60", "run.duration=4", "output.frames={every=2}", "engine.sweeps=300"});
}

TEST_CASE("every table that goes with the run's clock names it: sweeps, not time") {
  const Folder folder;
  run::RunOptions options;
  options.directory = folder / "gas";
  run::run_scene(scene::read_scene(scenes + "hard-discs.toml",
                                   {"run.duration=60", "output.series.every=10", "output.moments={every=20}",
                                    "output.velocities={every=20}", "output.diffusion={every=1, longest=30}",
                                    "engine.equilibrate=20"}),
                 options);
  for (const char* name : {"series.csv", "moments.csv", "velocities.csv", "diffusion.csv"}) {
    const auto text = content(options.directory / name);
    CAPTURE(name, text.substr(0, 300));
    CHECK(text.find("\nsweeps,") != std::string::npos);
    CHECK(text.find("\ntime,") == std::string::npos);
  }
}

TEST_CASE("a packing laid bottom to top comes to rest under soft forces without flying apart") {
  const Folder folder;
  run::RunOptions options;
  options.directory = folder / "packing";
  run::run_scene(scene::read_scene(scenes + "packing-2d.toml", small_packing()), options);
  const auto scene = scene::read_scene(
      scenes + "packing-2d.toml",
      {"domain.size=[20]",
       "grains.count=", "grains.diameter=", "grains.start={from=\"" + options.directory.string() + "\"}",
       "contact.tangential={law=\"cundall-strack\", friction=0.5, stiffness_ratio=0.3}", "engine.method=soft",
       "run.duration=15", "output.frames=", "output.contacts=false", "output.series.every=1"});
  const auto made = make_engine(scene);
  const auto height = [&] {
    const auto grains = made.engine->grains();
    double sum = 0;
    for (std::size_t i = 0; i < grains.moving; ++i)
      sum += grains.position[1][i] / static_cast<double>(grains.moving);
    return sum;
  };
  const double before = height();
  double fastest = 0;
  for (int t = 1; t <= 15; ++t) {
    made.engine->advance_to(std::llround(t / made.engine->time_step()));
    fastest = std::max(fastest, made.engine->energy().translation);
  }
  CHECK(fastest < 0.05 * 200);  // in m g d a grain: nothing falls far
  CHECK(made.engine->energy().translation < 1e-3 * 200);
  CHECK(height() == Approx(before).epsilon(0.06));
}

TEST_CASE("what the methods without dynamics cannot do is refused at its key") {
  const auto refused = [&](const std::string& file, std::vector<std::string> settings) {
    return message<InputError>([&] { scene::read_scene(scenes + file, settings); });
  };
  CHECK_THAT(refused("packing-2d.toml", {"incline.angle=10 deg"}),
             Catch::Contains("restructuring lays grains straight down"));
  CHECK_THAT(refused("packing-2d.toml", {"output.impacts={from=0}"}), Catch::Contains("tells of no impacts"));
  CHECK_THAT(refused("hard-discs.toml",
                     {"contact.tangential={law=\"cundall-strack\", friction=0.5, stiffness_ratio=0.3}"}),
             Catch::Contains("monte-carlo knows no friction"));
  CHECK_THAT(refused("hard-discs.toml", {"output.frames={every=2000}", "output.contacts=true"}),
             Catch::Contains("tells of no contacts"));
  CHECK_THAT(refused("hard-discs.toml", {"domain.periodic=[\"x\"]"}),
             Catch::Contains("output.pairs: needs a domain that repeats in all directions"));
  CHECK_THAT(refused("chute-3d.toml", {"output.bed=true", "bed={kind=\"none\"}",
                                       "domain={periodic=[\"x\"], size=[10, 10, 10]}"}),
             Catch::Contains("output.bed: tells of planes of beads that repeat along and across"));
}

TEST_CASE("hard grains that overlap at the start are the scene's fault, told at its key") {
  const Folder folder;
  const auto file = folder / "two.vtk";
  const auto at_distance = [&](double distance) {
    std::ofstream(file) << fmt::format(
        "# vtk DataFile Version 3.0\ntwo\nASCII\nDATASET POLYDATA\nPOINTS 2 double\n"
        "1 1 0\n{} 1 0\nVERTICES 2 4\n1 0\n1 1\nPOINT_DATA 2\n"
        "SCALARS radius double 1\nLOOKUP_TABLE default\n0.5\n0.5\n",
        1 + distance);
    return scene::read_scene(
        scenes + "hard-discs.toml",
        {"grains.count=", "grains.diameter=", "grains.start={from=\"" + file.string() + "\"}"});
  };
  CHECK_NOTHROW(make_engine(at_distance(1.01)));
  CHECK_THAT(
      message<InputError>([&] { make_engine(at_distance(0.9)); }),
      Catch::Contains("grains.start: grain 0 overlaps grain 1 by 0.2 of the smaller radius at the start"));
  // as much as soft grains overlap is no slip: they are pushed apart
  const auto apart = make_engine(at_distance(0.99));
  CHECK(apart.engine->grains().position[0][1] - apart.engine->grains().position[0][0] >= 1);
  CHECK(apart.engine->grains().position[0][1] - apart.engine->grains().position[0][0] < 1.01);
}

TEST_CASE("scattered grains lie apart, and an intruder at the bottom") {
  for (const char* file : {"packing-2d.toml", "packing-3d.toml"}) {
    const auto made = make_engine(scene::read_scene(
        scenes + file, {"grains.count=300", "grains.start={kind=\"scattered\", intruder=3, fraction=0.3}"}));
    const auto grains = made.engine->grains();
    double least = 9;
    for (std::size_t i = 0; i < 300; ++i)
      for (std::size_t j = i + 1; j < 300; ++j) {
        const auto way = grains.way(i, j);
        least = std::min(least, std::sqrt(way[0] * way[0] + way[1] * way[1] + way[2] * way[2]) -
                                    grains.radius[i] - grains.radius[j]);
      }
    CHECK(least >= 0);
    const auto up = static_cast<std::size_t>(grains.dimensions) - 1;
    CHECK(grains.radius[0] == 1.5);
    CHECK(grains.position[up][0] == 1.5);
    CHECK(grains.material[0] == 1);
    for (std::size_t i = 0; i < 300; ++i) CHECK(grains.position[up][i] >= grains.radius[i]);
  }
}

TEST_CASE(
    "frames of a run that counts no time say what it counts, and walls that a method cannot know are refused") {
  const Folder folder;
  run::RunOptions options;
  options.directory = folder / "packing";
  run::run_scene(scene::read_scene(scenes + "packing-2d.toml", small_packing()), options);
  CHECK_THAT(content(options.directory / "frames/000001.vtp"), Catch::Contains("Name=\"clock\""));
  const auto with_wall = [](const std::string& normal) {
    auto settings = small_packing();
    settings.push_back("wall=[{point=[0, -1], normal=" + normal + "}]");
    return scene::read_scene(scenes + "packing-2d.toml", settings);
  };
  CHECK_NOTHROW(with_wall("[0, 2]"));
  CHECK_THROWS_WITH(with_wall("[1, 1]"),
                    Catch::Contains("wall[0].normal: engine.method = \"restructuring\" knows no "
                                    "walls but a level floor"));
}

}  // namespace statistical_tests
