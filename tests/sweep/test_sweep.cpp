#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "../runs/make_engine.hpp"
#include "common/error.hpp"
#include "folder.hpp"
#include "run/flow.hpp"
#include "run/run.hpp"
#include "scene/world.hpp"
#include "starts/square.hpp"
#include "sweep/sweep.hpp"

using namespace chute;
using namespace chute::sweep;
using test::content;
using test::Folder;
namespace fs = std::filesystem;

namespace {

const fs::path ball = CHUTE_SOURCE_DIR "/scenes/sweep-ball.toml";
const std::vector<std::string> small{"grains.count=3", "run.duration=2", "contact.normal.stiffness=2e5"};

Base base() {
  auto set = small;
  set.push_back(
      "sweep.axis=[{key=\"incline.sin\",values=[0.0,0.06]},{key=\"grains.size_ratio\",values=[2.25,3]}]");
  set.push_back("sweep.seeds=2");
  return Base(ball, set);
}

bool go(const Base& what, const fs::path& folder, int jobs = 1, int shard = 1, int shards = 1,
        bool resume = false) {
  SweepOptions options;
  options.directory = folder;
  options.jobs = jobs, options.shard = shard, options.shards = shards, options.resume = resume;
  options.progress = [](double) { return true; };
  return run_sweep(what, options);
}

}  // namespace

TEST_CASE("independent grains move as each would alone, to the last bit") {
  for (const char* method : {"soft", "event"}) {
    CAPTURE(method);
    auto scene = scene::read_scene(ball, {"sweep=", "grains.count=5", "run.duration=0.5",
                                          "grains.start.spread=0.1", std::string("engine.method=") + method});
    const auto together = test::make_engine(scene);
    const auto start = scene::make_world<2>(scene);
    together.engine->advance_to(20000);
    const auto view = together.engine->grains();
    for (std::size_t i = 0; i < 5; ++i) {
      auto alone = scene;
      alone.grains.count = 1;
      auto* begin = alone.grains.start.as<starts::Alone>();
      begin->spread = 0;
      begin->x = start.grains.position[0][i];
      begin->velocity = start.grains.velocity[0][i];
      begin->velocity_up = start.grains.velocity[1][i];
      const auto one = test::make_engine(alone);
      REQUIRE(one.engine->time_step() == together.engine->time_step());
      one.engine->advance_to(20000);
      const auto v = one.engine->grains();
      CHECK(v.position[0][0] == view.position[0][i]);
      CHECK(v.position[1][0] == view.position[1][i]);
      CHECK(v.velocity[0][0] == view.velocity[0][i]);
      CHECK(v.spin[0][0] == view.spin[0][i]);
    }
  }
}

TEST_CASE("grains that may not rotate never spin, and feel friction all the same") {
  const auto scene =
      scene::read_scene(ball, {"sweep=", "grains.count=2", "grains.rotation=false", "run.duration=1"});
  const auto made = test::make_engine(scene);
  made.engine->advance_to(5000);
  for (std::size_t i = 0; i < 2; ++i) CHECK(made.engine->grains().spin[0][i] == 0);
  CHECK(made.engine->energy().shear_loss > 0);
}

TEST_CASE("a sweep of one start says what a run of it says") {
  const Folder folder;
  const std::vector<std::string> one{"grains.independent=", "grains.count=1", "run.duration=8",
                                     "incline.sin=0.06"};
  auto set = one;
  set.insert(set.end(), {"sweep=", "seed=1"});
  const auto scene = scene::read_scene(ball, set);
  const auto followed = follow(scene, [](double) { return true; });
  run::RunOptions options;
  options.directory = folder / "run";
  run::run_scene(scene, options);
  const auto flow = run::read_flow(folder / "run");
  REQUIRE(followed.starts.size() == 1);
  CHECK(followed.starts[0].verdict == flow.verdict);
  CHECK(followed.starts[0].v_x.mean == flow.v_x.mean);
  CHECK(followed.starts[0].omega.mean == flow.omega.mean);
}

TEST_CASE("a sweep gives the same tables whatever the jobs and shards, resumed or not") {
  const Folder folder;
  CHECK(go(base(), folder / "whole"));
  const auto table = content(folder / "whole/sweep.csv"), starts = content(folder / "whole/starts.csv");
  const auto lines = [](const std::string& text) {  // the header's and the rows'
    return std::count(text.begin(), text.end(), '\n') - std::count(text.begin(), text.end(), '#');
  };
  CHECK(lines(table) == 1 + 4);
  CHECK(lines(starts) == 1 + 4 * 2 * 3);
  CHECK_THAT(table, Catch::Contains("\n# column v_x_median ("));  // what it is stands there
  // on the level line everything stops; at sin θ = 0.06 nothing does
  CHECK_THAT(table, Catch::Contains(",0,2.25,6,6,0,") && Catch::Contains(",0.06,2.25,6,0,"));

  CHECK(go(base(), folder / "jobs", 3));
  CHECK(content(folder / "jobs/sweep.csv") == table);

  CHECK_FALSE(go(base(), folder / "shards", 1, 2, 3));
  CHECK_FALSE(fs::exists(folder / "shards/sweep.csv"));
  CHECK_FALSE(go(base(), folder / "shards", 1, 1, 3));
  CHECK(go(base(), folder / "shards", 1, 3, 3));
  CHECK(content(folder / "shards/sweep.csv") == table);
  CHECK(content(folder / "shards/starts.csv") == starts);

  // some points lost, one damaged: made again
  int k = 0;
  for (const auto& point : fs::directory_iterator(folder / "whole/points"))
    if (++k % 2) test::write(point.path(), k == 1 ? "{" : "");
  fs::remove(folder / "whole/sweep.csv");
  CHECK(go(base(), folder / "whole", 1, 1, 1, true));
  CHECK(content(folder / "whole/sweep.csv") == table);
}

TEST_CASE("a folder that holds something else is left alone") {
  const Folder folder;
  fs::create_directories(folder / "other");
  test::write(folder / "other/precious.txt", "x");
  CHECK_THROWS_WITH(go(base(), folder / "other"), Catch::Contains("holds other things"));
  CHECK(content(folder / "other/precious.txt") == "x");

  CHECK(go(base(), folder / "a", 2));
  CHECK_THROWS_WITH(go(base(), folder / "a"), Catch::Contains("--resume goes on with it"));
  auto changed = base();
  changed.set.push_back("run.duration=3");
  CHECK_THROWS_WITH(go(changed, folder / "a", 1, 1, 1, true),
                    Catch::Contains("holds another sweep: run.duration is 2 there, and 3 here"));
}

TEST_CASE("a sweep that grows keeps what is done, and has the table of one made in one go") {
  const Folder folder;
  const auto with = [](const std::string& setting) {
    auto grown = base();
    grown.set.push_back(setting);
    return grown;
  };
  const auto points = [&](const char* name) {
    std::map<std::string, fs::file_time_type> found;
    for (const auto& entry : fs::directory_iterator(folder / name / "points"))
      found[entry.path().filename()] = fs::last_write_time(entry.path());
    return found;
  };
  CHECK(go(base(), folder / "grown"));
  const auto before = points("grown");
  CHECK(before.size() == 8);
  CHECK_THROWS_WITH(go(with("sweep.seeds=3"), folder / "grown"), Catch::Contains("--resume keeps"));
  // One more value, one more seed, and one more axis, on which the scene's own value stands.
  auto larger = with("sweep.seeds=3");
  larger.set.push_back(
      with_more_values(larger, {"incline.sin=0.03", "contact.tangential.friction=0.13,0.3"}));
  CHECK(go(larger, folder / "grown", 1, 1, 1, true));
  const auto after = points("grown");
  CHECK(after.size() == 3 * 2 * 2 * 3);
  for (const auto& [name, time] : before) {
    REQUIRE(after.count(name) == 1);
    CHECK(after.at(name) == time);
  }
  CHECK(go(larger, folder / "whole"));
  CHECK(content(folder / "grown/sweep.csv") == content(folder / "whole/sweep.csv"));
  const auto state = sweep_state(folder / "grown");
  CHECK(state.points == 36);
  CHECK(state.found == 36);
  CHECK(state.table);
  CHECK(std::accumulate(state.starts.begin(), state.starts.end(), std::size_t{0}) == 36 * 3);
  // What is not swept may not change.
  auto changed = larger;
  changed.set.push_back("run.duration=3");
  CHECK_THROWS_WITH(go(changed, folder / "grown", 1, 1, 1, true),
                    Catch::Contains("holds another sweep: run.duration is 2 there, and 3 here"));
}

TEST_CASE("a sweep that keeps its runs says where they are, and what they are is in them") {
  const Folder folder;
  SweepOptions options;
  options.directory = folder / "kept";
  options.keep_runs = true;
  options.progress = [](double) { return true; };
  auto what = base();
  what.set.insert(what.set.end(), {"sweep.seeds=1", "output.frames={every=1}"});
  CHECK(run_sweep(what, options));
  const fs::path one = folder / "kept/runs/incline.sin=0.06_grains.size_ratio=3_seed=1";
  CHECK(fs::exists(one / "frames/000002.vtp"));
  const auto table = content(folder / "kept/sweep.csv");
  CHECK_THAT(table,
             Catch::Contains("\nstopped,runs/incline.sin=0_grains.size_ratio=2.25_seed=1,0,2.25,3,3,"));
  const auto flow = run::read_flow(one);
  CHECK_THAT(table, Catch::Contains(std::string(measure::name(flow.verdict)) +
                                    ",runs/incline.sin=0.06_grains.size_ratio=3_seed=1,0.06,3,3,"));
  CHECK(sweep_state(folder / "kept").found == 4);
}

TEST_CASE("a wrong place of the grid is refused before anything is written") {
  const Folder folder;
  auto wrong = base();
  wrong.set.push_back("sweep.axis=[{key=\"contact.normal.restitution\",values=[0.5,1.5]}]");
  CHECK_THROWS_AS(go(wrong, folder / "a"), InputError);
  CHECK_FALSE(fs::exists(folder / "a"));
}

TEST_CASE("the lower boundary of a stiff inelastic ball is that of the corrected closed form") {
  // e_n = 0.1 and strong friction are near the theory's e_n = 0 without slip: sin θ_AB = 0.02287 for Φ = 2.25
  const Folder folder;
  const Base stiff(CHUTE_SOURCE_DIR "/scenes/boundaries-ball.toml",
                   {"contact.normal.restitution=0.1", "contact.normal.stiffness=2e7",
                    "contact.tangential.friction=0.5", "contact.tangential.viscosity=1000", "grains.count=6",
                    "run.duration=12", "sweep.axis=[{key=\"grains.size_ratio\",values=[2.25]}]",
                    "sweep.boundary={axis={key=\"incline.sin\",from=0.02,to=0.026,count=2},tolerance=0.0002,"
                    "velocities=[0.2]}"});
  CHECK(go(stiff, folder / "a", 2));
  const auto text = content(folder / "a/boundaries.csv");
  const auto row = text.substr(text.find("\n2.25,") + 6);
  const double boundary = std::stod(row);
  CHECK(boundary == Approx(0.02287).epsilon(0.03));
  CHECK(boundary > 0.02287 - 0.0001);
}

TEST_CASE("a sweep goes on with the scene as it was read, whatever happens to the file") {
  const Folder folder;
  test::write(folder / "scene.toml", content(ball));
  const Base read(folder / "scene.toml", base().set);
  const auto before = scene::to_toml(read.scene({"sweep="}));
  test::write(folder / "scene.toml", "title = \"something else\"\n");
  CHECK(scene::to_toml(read.scene({"sweep="})) == before);
}

TEST_CASE("boundaries that cannot be written are an error, and points that are missing are another shard's") {
  const Folder folder;
  const Base stiff(
      CHUTE_SOURCE_DIR "/scenes/boundaries-ball.toml",
      {"grains.count=2", "run.duration=1", "sweep.axis=[{key=\"grains.size_ratio\",values=[2.25]}]",
       "sweep.boundary={axis={key=\"incline.sin\",from=0,to=0.1,count=2},tolerance=0.1,velocities=[0.2]}"});
  CHECK(go(stiff, folder / "a"));
  fs::remove(folder / "a/boundaries.csv");
  fs::create_directories(folder / "a/boundaries.csv/in the way");
  CHECK_THROWS_WITH(go(stiff, folder / "a", 1, 1, 1, true), Catch::Contains("boundaries.csv: cannot write"));
  const PointStore known = PointStore(folder / "empty").only_known();
  CHECK_THROWS_AS(known.get(stiff.scene({"sweep=", "incline.sin=0.1"}), [](double) { return true; }),
                  PointStore::PointIsMissing);
}

TEST_CASE("a run and a sweep give the same verdicts on independent starts") {
  const Folder folder;
  const auto scene =
      scene::read_scene(ball, {"sweep=", "grains.count=4", "run.duration=8", "incline.sin=0.06"});
  const auto followed = follow(scene, [](double) { return true; });
  run::RunOptions options;
  options.directory = folder / "run";
  run::run_scene(scene, options);
  const auto json = nlohmann::json::parse(content(folder / "run/run.json"));
  REQUIRE(json.at("starts").size() == 4);
  for (std::size_t k = 0; k < 4; ++k) {
    CHECK(json.at("starts")[k].at("verdict") == measure::name(followed.starts[k].verdict));
    CHECK(json.at("starts")[k].at("v_x") == followed.starts[k].v_x.mean);
  }
}
