#include <catch2/catch.hpp>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>

#include "common/error.hpp"
#include "folder.hpp"
#include "run/growth.hpp"
#include "run/run.hpp"

using namespace chute;
using namespace chute::test;

namespace growth_tests {

namespace {

/// A small flow whose outputs say all their times, so that no default follows from the duration.
scene::Scene flow(std::vector<std::string> settings = {}) {
  settings.insert(settings.begin(),
                  {"grains.count=40", "bed.count=12", "run.duration=6", "contact.normal.stiffness=1e4",
                   "contact.tangential.viscosity=50", "output.frames={every=2}", "output.series={every=0.5}",
                   "output.impacts={from=1}", "output.profiles=", "output.fields=",
                   "output.impact_histograms=", "output.contacts=true"});
  return scene::read_scene(CHUTE_SOURCE_DIR "/scenes/demo.toml", settings);
}

struct Went {
  run::RunResult result;
  std::vector<std::string> told;
};
Went go(const scene::Scene& scene, const fs::path& folder, run::Existing existing = run::Existing::refuse) {
  Went went{};
  run::RunOptions options;
  options.directory = folder;
  options.existing = existing;
  options.warn = [&](const std::string& what) { went.told.push_back(what); };
  went.result = run::run_scene(scene, options);
  return went;
}
auto goes_on(const scene::Scene& scene, const fs::path& folder) {
  return go(scene, folder, run::Existing::resume);
}
double step_of(const fs::path& run) {
  return nlohmann::json::parse(content(run / "run.json")).at("time_step");
}

}  // namespace

TEST_CASE("a run that is made longer has the bytes of one made in one go") {
  const Folder folder;
  go(flow({"run.duration=13"}), folder / "whole");
  const auto expected = results(folder / "whole");
  const auto first = go(flow(), folder / "grown");
  CHECK(results(folder / "grown") != expected);
  const auto second = goes_on(flow({"run.duration=9"}), folder / "grown");
  const auto third = goes_on(flow({"run.duration=13"}), folder / "grown");
  CHECK(second.told.empty());
  CHECK(first.result.steps > second.result.steps);  // what was done is not done again
  CHECK(third.result.finished);
  CHECK(results(folder / "grown") == expected);
  CHECK(run::is_finished_run_of(folder / "grown", flow({"run.duration=13"})));
}

TEST_CASE("averages of a run that is made longer are those of one made in one go") {
  const Folder folder;
  const std::vector<std::string> averages{"output.profiles={from=2, bin=1.0, every=0.1}",
                                          "output.fields={from=\"steady\", every=0.2}",
                                          "output.impact_histograms={from=2}"};
  const auto with = [&](const char* duration) {
    auto settings = averages;
    settings.insert(settings.end(), {duration, "output.contacts=false"});
    return flow(settings);
  };
  go(with("run.duration=20"), folder / "whole");
  go(with("run.duration=8"), folder / "grown");
  goes_on(with("run.duration=20"), folder / "grown");
  for (const auto& [file, name] :
       {std::pair{"profiles.csv", "v_x"}, {"profiles.csv", "eta"}, {"impact_histograms.csv", "value"}}) {
    const auto whole = column(folder / "whole" / file, name), grown = column(folder / "grown" / file, name);
    INFO(file << " " << name);
    REQUIRE(whole.size() == grown.size());
    for (std::size_t k = 0; k < whole.size(); ++k)  // layers that no grain reached have no velocity
      if (std::isnan(whole[k]))
        CHECK(std::isnan(grown[k]));
      else
        CHECK(grown[k] == Approx(whole[k]).epsilon(1e-9));
  }
}

TEST_CASE("the step stays, whatever the outputs; intervals are whole numbers of it") {
  const Folder folder;
  const auto run = folder / "run";
  go(flow({"output.series={every=0.002}"}), run);
  const double step = step_of(run);
  const auto said = message<InputError>([&] { goes_on(flow({"output.frames={every=0.3333}"}), run); });
  const double below = std::floor(0.3333 / step) * step;
  INFO(said);
  CHECK(said.starts_with((run / "checkpoint").string() +
                         ": output.frames: 0.3333 between two looks is no whole"));
  std::ostringstream nearest;
  nearest << std::setprecision(10) << "; " << below << " or " << below + step << " is";
  CHECK(said.ends_with(nearest.str()));
  // Intervals for which a new run would choose another step.
  const auto coarser = flow({"run.duration=8", "output.frames={every=0.5}"});
  go(coarser, folder / "other");
  CHECK(step_of(folder / "other") != step);
  goes_on(coarser, run);
  CHECK(step_of(run) == step);
  const auto times = column(run / "series.csv", "time");
  REQUIRE(times.size() == 3001 + 4);
  CHECK(times[3000] == Approx(6));
  CHECK(times[3001] == Approx(6.5));
  CHECK(content(run / "scene.toml").find("time_step = ") != std::string::npos);
  CHECK(fs::exists(run / "frames/000007.vtp"));  // 0 2 4 6, 6.5 7 7.5 8
  CHECK_FALSE(fs::exists(run / "frames/000008.vtp"));
  // And on again, from a scene that knows nothing of that step.
  goes_on(flow({"run.duration=10"}), run);
  CHECK(step_of(run) == step);
  // A run that begins with the resolved scene takes the same steps.
  go(scene::read_scene(run / "scene.toml"), folder / "again");
  CHECK(step_of(folder / "again") == step);
}

TEST_CASE("outputs that come, change or end on the way are told, and begin where the run goes on") {
  const Folder folder;
  const auto run = folder / "run";
  go(flow({"output.profiles={every=0.5}"}), run);
  const auto went = goes_on(flow({"run.duration=8", "output.impacts=", "output.profiles={every=0.25}",
                                  "output.moments={every=0.5}"}),
                            run);
  CHECK(went.told ==
        std::vector<std::string>{
            "output.profiles has other keys than before: it begins at t = 6, where the run goes on",
            "output.moments begins at t = 6, where the run goes on",
            "output.impacts ends at t = 6: its files stay as they are"});
  const auto times = column(run / "moments.csv", "time");
  REQUIRE(times.size() == 5);
  CHECK(times.front() == Approx(6));
}

TEST_CASE("what a run that goes on may not change is told with both values") {
  const Folder folder;
  const auto run = folder / "run";
  go(flow(), run);
  const auto before = tree(run);
  const auto refused = [&](std::vector<std::string> settings) {
    return message<InputError>([&] { goes_on(flow(std::move(settings)), run); });
  };
  const auto where = (run / "checkpoint").string() + ": belongs to another scene: ";
  const std::string may = "; what may change is run.duration, title and [output]";
  CHECK(refused({"seed=9"}) == where + "seed is 7 there, and 9 here" + may);
  CHECK(refused({"contact.normal.restitution=0.7", "run.duration=20"}) ==
        where + "contact.normal.restitution is 0.6 there, and 0.7 here" + may);
  CHECK(refused({"seed=9", "contact.normal.restitution=0.7"}) ==
        where + "contact.normal.restitution is 0.6 there, and 0.7 here; seed is 7 there, and 9 here" + may);
  CHECK(refused({"engine.time_step=1e-4"}).starts_with(where + "engine.time_step is not given there, and "));
  CHECK(refused({"engine.steps_per_contact=20"}).starts_with(where + "engine.steps_per_contact is 50 there"));
  CHECK(refused({"run.duration=5"}) ==
        "run.duration: 5 is over: the run in " + run.string() + " is at t = 6");
  CHECK(tree(run) == before);
}

TEST_CASE("a scene without rows of its own keeps those of the run that it goes on with") {
  const Folder folder;
  const std::string text = content(CHUTE_SOURCE_DIR "/scenes/chute-2d.toml");
  const std::vector<std::string> small{"grains.count=8", "bed.count=6", "contact.normal.stiffness=1e4",
                                       "contact.tangential.viscosity=50", "run.duration=4"};
  auto longer = small;
  longer.back() = "run.duration=8";
  go(scene::parse_scene(text, "s", small), folder / "run");
  const auto rows = column(folder / "run/series.csv", "time").size();
  goes_on(run::parse_to_go_on(text, "s", longer, folder / "run"), folder / "run");
  CHECK(column(folder / "run/series.csv", "time").size() == 2 * rows - 1);
}

TEST_CASE("a run can be watched: its tables and frames.pvd are as of some seconds ago") {
  const Folder folder;
  const auto run = folder / "run";
  run::RunOptions options;
  options.directory = run;
  std::size_t seen = 0;
  double part = 0, time = 0;
  const auto begin = std::chrono::steady_clock::now();
  options.progress = [&](double done) {
    // Not at a checkpoint: there is only that of the begin.
    if (const auto json = nlohmann::json::parse(content(run / "run.json")); json.at("steps") > 0) {
      seen = column(run / "series.csv", "time").size(), part = done, time = json.at("time");
      CHECK(json.at("end") == "running");
      CHECK(json.at("seconds_left") > 0);
      return false;
    }
    return std::chrono::steady_clock::now() - begin < std::chrono::seconds(60);
  };
  run::run_scene(
      flow({"run.duration=1e6", "output.frames={every=50}", "output.checkpoint=1e6", "output.impacts="}),
      options);
  REQUIRE(seen > 2);
  CHECK(time > 0);
  CHECK(part < 0.5);
}

}  // namespace growth_tests
