#include <catch2/catch.hpp>

#include "common/error.hpp"
#include "folder.hpp"
#include "run/run.hpp"

using namespace chute;
using namespace chute::test;

namespace directory_tests {

namespace {

scene::Scene tiny(std::vector<std::string> settings = {}) {
  settings.insert(settings.begin(),
                  {"grains.count=8", "bed.count=6", "run.duration=1", "contact.normal.stiffness=1e4",
                   "contact.tangential.viscosity=50", "output.frames={every=0.5}"});
  return scene::read_scene(CHUTE_SOURCE_DIR "/scenes/chute-2d.toml", settings);
}

void go(const scene::Scene& scene, const fs::path& folder, run::Existing existing) {
  run::RunOptions options;
  options.directory = folder;
  options.existing = existing;
  run::run_scene(scene, options);
}

}  // namespace

TEST_CASE("an existing run is refused, resumed or replaced, as asked") {
  const Folder folder;
  const auto run = folder / "run";
  go(tiny(), run, run::Existing::refuse);
  const auto before = tree(run);
  CHECK(message<InputError>([&] { go(tiny(), run, run::Existing::refuse); }) ==
        run.string() +
            ": a run is already there; give --resume to go on with it, --force to replace it, or -o another");
  CHECK(tree(run) == before);
  CHECK(message<InputError>([&] { go(tiny({"seed=9"}), run, run::Existing::resume); }) ==
        (run / "checkpoint").string() +
            ": belongs to another scene: seed is 1 there, and 9 here; what may change is "
            "run.duration, title and [output]");
  CHECK(tree(run) == before);
  go(tiny({"seed=9", "output.frames="}), run, run::Existing::replace);
  CHECK(tree(run).count("frames.pvd") == 0);  // nothing of the old run stays
  CHECK_FALSE(fs::exists(run / "frames"));
  fs::remove(run / "checkpoint");
  CHECK(message<InputError>([&] {
          go(tiny({"seed=9", "output.frames="}), run, run::Existing::resume);
        }) == run.string() + ": has no checkpoint to resume from; give --force to start again");
}

TEST_CASE("an empty folder is taken, --resume or not") {
  const Folder folder;
  fs::create_directory(folder / "empty");
  go(tiny(), folder / "empty", run::Existing::refuse);
  CHECK(fs::exists(folder / "empty/series.csv"));
  go(tiny(), folder / "new", run::Existing::resume);  // so that a script may always say --resume
  CHECK(fs::exists(folder / "new/series.csv"));
}

TEST_CASE("a folder with other people's files is never touched") {
  const Folder folder;
  const auto home = folder / "home";
  fs::create_directories(home / "frames");
  write(home / "thesis.txt", "years of work");
  write(home / "frames/window.txt", "oak");
  write(home / "series.csv", "not chute's");
  const auto before = tree(home);
  for (const auto existing : {run::Existing::refuse, run::Existing::resume, run::Existing::replace}) {
    CHECK(message<InputError>([&] { go(tiny(), home, existing); }) ==
          home.string() + ": holds files that are not a run; give another folder with -o");
    CHECK(tree(home) == before);
  }
  CHECK(message<InputError>([&] { go(tiny(), home / "thesis.txt", run::Existing::replace); }) ==
        (home / "thesis.txt").string() + ": is a file, not a folder for a run");
}

TEST_CASE("--force keeps what is not chute's in a run's folder") {
  const Folder folder;
  const auto run = folder / "run";
  go(tiny(), run, run::Existing::refuse);
  write(run / "notes.txt", "looks good");
  go(tiny({"seed=3"}), run, run::Existing::replace);
  CHECK(content(run / "notes.txt") == "looks good");
  CHECK(content(run / "scene.toml").find("seed = 3") != std::string::npos);
}

TEST_CASE("a scene that cannot start leaves no folder") {
  const Folder folder;
  CHECK(message<InputError>([&] {
          go(tiny({"bed.count=3", "bed.diameter=0.5"}), folder / "run", run::Existing::refuse);
        }).find("bed.count") != std::string::npos);
  CHECK_FALSE(fs::exists(folder / "run"));
}

TEST_CASE("a damaged checkpoint is refused and left alone") {
  const Folder folder;
  const auto run = folder / "run";
  go(tiny(), run, run::Existing::refuse);
  const auto whole = content(run / "checkpoint");
  for (const auto& [damaged, says] : {std::pair{whole.substr(0, whole.size() / 2), "truncated or damaged"},
                                      {whole.substr(0, 3), "not a checkpoint of this version of chute"},
                                      {std::string(), "not a checkpoint of this version of chute"}}) {
    write(run / "checkpoint", damaged);
    const auto before = tree(run);
    const auto said = message<InputError>([&] { go(tiny(), run, run::Existing::resume); });
    INFO(said);
    CHECK(said.starts_with((run / "checkpoint").string() + ": " + says));
    CHECK(said.find('\n') == said.npos);
    CHECK(tree(run) == before);
  }
}

// A bed too soft for the fall: the grains dive into it.
TEST_CASE("a run that leaves physics says who and when, and leaves a checkpoint and run.json") {
  const Folder folder;
  const auto run = folder / "run";
  const auto deep = tiny({"contact.normal.stiffness=40", "contact.tangential.viscosity=1",
                          "grains.start.velocity_up=-3", "run.duration=5"});
  const auto said = message<WorkError>([&] { go(deep, run, run::Existing::refuse); });
  INFO(said);
  CHECK(said.starts_with("the run left physics at t = "));
  CHECK(said.find(": grain ") != said.npos);
  CHECK(said.find("overlaps grain ") != said.npos);
  CHECK(said.find('\n') == said.npos);
  const auto json = content(run / "run.json");
  CHECK(json.find("\"end\": \"left physics\"") != json.npos);
  CHECK(json.find("\"why\": \"the run left physics at t = ") != json.npos);
  CHECK(fs::exists(run / "checkpoint"));
  CHECK_FALSE(run::is_finished_run_of(run, deep));
  // resumed, it fails again in the same way
  CHECK(message<WorkError>([&] { go(deep, run, run::Existing::resume); }) == said);
}

TEST_CASE("a time step too long for the forces ends as an error, not as a file full of nan") {
  const Folder folder;
  const auto wild = tiny({"engine.time_step=0.2", "engine.deepest_overlap=1", "run.duration=200"});
  const auto said = message<WorkError>([&] { go(wild, folder / "run", run::Existing::refuse); });
  CHECK(said.starts_with("the run left physics at t = "));
  for (const auto& [name, text] : tree(folder / "run"))
    if (name.ends_with(".csv")) CHECK(text.find("nan") == text.npos);
}

}  // namespace directory_tests
