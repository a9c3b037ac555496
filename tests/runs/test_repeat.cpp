#include <catch2/catch.hpp>

#include "common/error.hpp"
#include "engines/soft/soft_method.hpp"
#include "folder.hpp"
#include "make_engine.hpp"
#include "run/run.hpp"

using namespace chute;
using namespace chute::test;

namespace repeat_tests {

namespace {

/// A small flow that writes every kind of file.
scene::Scene flow(std::vector<std::string> settings = {}) {
  settings.insert(settings.begin(),
                  {"grains.count=60", "bed.count=12", "run.duration=12", "contact.normal.stiffness=1e5",
                   "contact.tangential.viscosity=150", "output.frames={every=2}", "output.series={every=0.5}",
                   "output.profiles={from=4, bin=1.0, every=0.1}", "output.impacts={from=4}",
                   "output.fields={from=\"steady\", every=0.2}", "output.impact_histograms={from=3}",
                   "output.contacts=true", "output.checkpoint=1.5"});
  return scene::read_scene(CHUTE_SOURCE_DIR "/scenes/demo.toml", settings);
}

run::RunResult go(const scene::Scene& scene, const fs::path& folder,
                  run::Existing existing = run::Existing::refuse, std::function<bool(double)> progress = {},
                  int threads = 1) {
  run::RunOptions options;
  options.directory = folder;
  options.existing = existing;
  options.threads = threads;
  options.progress = std::move(progress);
  return run::run_scene(scene, options);
}

struct Killed {};

}  // namespace

TEST_CASE("a run writes every file that the scene asks for") {
  const Folder folder;
  const auto result = go(flow(), folder / "a");
  CHECK(result.finished);
  const auto files = tree(folder / "a");
  for (const char* name : {"scene.toml", "run.json", "frames.pvd", "frames/000000.vtp", "frames/000006.vtp",
                           "contacts/000000.vtp", "contacts/000006.vtp", "impacts.vtp", "series.csv",
                           "profiles.csv", "fields.csv", "impact_histograms.csv", "checkpoint"}) {
    INFO(name);
    CHECK(files.count(name) == 1);
  }
  CHECK(files.size() == 9 + 7 + 7);  // times 0, 2, … 12
  CHECK(files.at("run.json").find("\"end\": \"finished\"") != std::string::npos);
}

TEST_CASE("the same scene and seed give the same bytes, with any number of threads") {
  const Folder folder;
  go(flow(), folder / "a");
  const auto expected = results(folder / "a");
  go(flow(), folder / "b", run::Existing::refuse, {}, 2);
  CHECK(results(folder / "b") == expected);
  // the resolved scene, run again, too
  go(scene::read_scene(folder / "a" / "scene.toml"), folder / "c");
  CHECK(results(folder / "c") == expected);
  go(flow({"seed=8"}), folder / "d");
  CHECK(results(folder / "d") != expected);
  CHECK(results(folder / "d").at("frames/000000.vtp") != expected.at("frames/000000.vtp"));
}

TEST_CASE("many grains are shared by threads, and the bytes stay the same") {
  const auto many = scene::read_scene(
      CHUTE_SOURCE_DIR "/scenes/demo.toml",
      {"grains.count=" + std::to_string(2 * soft::SoftMethod::grains_per_thread + 500), "bed.count=300",
       "run.duration=0.8", "contact.normal.stiffness=1e4", "contact.tangential.viscosity=50",
       "output.contacts=false", "output.frames={every=0.4}", "output.profiles={every=0.1}",
       "output.impacts={from=0.4}"});
  const Folder folder;
  go(many, folder / "one");
  go(many, folder / "two", run::Existing::refuse, {}, 2);
  const auto expected = results(folder / "one");
  CHECK(expected.count("frames/000002.vtp") == 1);
  CHECK(results(folder / "two") == expected);
}

TEST_CASE("an interrupted and resumed run gives the bytes of an uninterrupted one") {
  const Folder folder;
  // contacts that remember have the most to lose
  const auto scene = flow({"run.duration=25", "output.frames={every=5}",
                           "contact.tangential={law=\"cundall-strack\", "
                           "stiffness=3e4, friction=0.5}"});
  const auto whole = go(scene, folder / "whole");
  const auto expected = results(folder / "whole");

  // stopped whenever the run asks, some ten times a second: each time it leaves a checkpoint
  int stops = 0;
  std::int64_t steps = 0;
  for (auto existing = run::Existing::refuse;; existing = run::Existing::resume, ++stops) {
    const auto part = go(scene, folder / "stopped", existing, [](double) { return false; });
    steps += part.steps;
    if (part.finished) break;
    CHECK(content(folder / "stopped/run.json").find("\"end\": \"interrupted\"") != std::string::npos);
    REQUIRE(part.steps > 0);
  }
  CHECK(steps == whole.steps);  // nothing was done twice
  CHECK(results(folder / "stopped") == expected);

  // killed without a word: goes on from the last checkpoint
  int kills = 0;
  for (auto existing = run::Existing::refuse;; existing = run::Existing::resume, ++kills) {
    const int patience = 1 + kills % 3;
    int asked = 0;
    try {
      go(scene, folder / "killed", existing, [&](double) {
        if (++asked >= patience && kills < 12) throw Killed{};
        return true;
      });
      break;
    } catch (const Killed&) {
    }
  }
  CHECK(results(folder / "killed") == expected);
  CHECK(stops + kills > 0);  // the run takes long enough to be disturbed
}

TEST_CASE("a finished run that is resumed stays as it is") {
  const Folder folder;
  go(flow(), folder / "a");
  const auto expected = results(folder / "a");
  const auto again = go(flow(), folder / "a", run::Existing::resume);
  CHECK(again.finished);
  CHECK(again.steps == 0);
  CHECK(results(folder / "a") == expected);
  CHECK(run::is_finished_run_of(folder / "a", flow()));
  CHECK_FALSE(run::is_finished_run_of(folder / "a", flow({"seed=8"})));
  // nor what another program made
  auto record = content(folder / "a" / "run.json");
  const auto build = record.find("\"build\": \"") + 10;
  record[build] = record[build] == '0' ? '1' : '0';
  write(folder / "a" / "run.json", record);
  CHECK_FALSE(run::is_finished_run_of(folder / "a", flow()));
  CHECK_FALSE(run::is_finished_run_of(folder / "b", flow()));
}

}  // namespace repeat_tests
