#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <functional>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "grains.hpp"
#include "image/png.hpp"
#include "view/render_run.hpp"

using namespace chute;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

struct Folder {
  fs::path path;
  Folder() {
    auto pattern = (fs::temp_directory_path() / "chute-test-XXXXXX").string();
    path = ::mkdtemp(pattern.data());
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
};

/// A run of `count` frames in which the grains move on.
void make_run(const fs::path& folder, int count) {
  auto frame = grains::small_chute();
  for (int i = 0; i < count; ++i) {
    frame.time = 0.5 * i;
    grains::write(frame, folder / "frames" / (std::to_string(i) + ".vtk"));
    for (double& x : frame.x) x += 0.01;
  }
}

view::RenderJob job_for(const Folder& folder, const char* output) {
  view::RenderJob job;
  job.source = folder.path;
  job.output = folder.path / output;
  job.style.width = 200, job.style.height = 150;
  return job;
}

std::vector<std::string> names(const fs::path& folder) {
  std::vector<std::string> result;
  for (const auto& entry : fs::directory_iterator(folder)) result.push_back(entry.path().filename().string());
  std::sort(result.begin(), result.end());
  return result;
}

bool same_files(const fs::path& a, const fs::path& b) {
  if (names(a) != names(b)) return false;
  for (const auto& name : names(a))
    if (read_file(a / name) != read_file(b / name)) return false;
  return true;
}

}  // namespace

// First, as long as this process has not drawn: after that it draws by itself.
TEST_CASE("Several processes draw the same bytes as one") {
  Folder folder;
  make_run(folder.path, 7);
  auto job = job_for(folder, "three");
  job.jobs = 3;
  job.movie = folder.path / "three.mp4";
  CHECK(view::render_run(job).drawn == 7);

  SECTION("what goes wrong in a process is said here") {
    auto bad = job_for(folder, "bad");
    bad.jobs = 2;
    bad.output = "/proc/nowhere";
    CHECK_THROWS_AS(view::render_run(bad), WorkError);
  }
  auto alone = job_for(folder, "one");
  alone.movie = folder.path / "one.mp4";
  CHECK(view::render_run(alone).drawn == 7);
  CHECK(same_files(folder.path / "one", folder.path / "three"));
  CHECK(read_file(folder.path / "one.mp4") == read_file(folder.path / "three.mp4"));
}

TEST_CASE("Pictures drawn from the same are kept, others drawn again") {
  Folder folder;
  make_run(folder.path, 4);
  auto job = job_for(folder, "out");
  CHECK(view::render_run(job).drawn == 4);
  auto again = view::render_run(job);
  CHECK((again.drawn == 0 && again.kept == 4));

  // a damaged picture, and a frame that has changed without changing what the whole run shares
  const auto old = read_file(job.output / "000002.png");
  write_atomically(job.output / "000002.png", old.substr(0, old.size() / 2));
  auto text = read_file(folder.path / "frames/3.vtk");
  text.replace(text.find("grains"), 6, "groins");
  write_atomically(folder.path / "frames/3.vtk", text);
  again = view::render_run(job);
  CHECK((again.drawn == 2 && again.kept == 2));
  CHECK(read_file(job.output / "000002.png") == old);

  job.style.background = view::Background::dark;
  CHECK(view::render_run(job).drawn == 4);
  CHECK(names(job.output) ==
        std::vector<std::string>{"000000.png", "000001.png", "000002.png", "000003.png"});
}

TEST_CASE("A plot beside the grains is drawn again when its table changes, and only then") {
  Folder folder;
  make_run(folder.path, 3);
  write_atomically(folder.path / "series.csv", "time,v_x\n0,1\n0.5,2\n1,3\n");
  auto job = job_for(folder, "out");
  job.style.width = 400, job.style.height = 300;
  view::render_run(job);
  job.plot = {"v_x"};
  CHECK(view::render_run(job).drawn == 3);
  CHECK(view::render_run(job).kept == 3);
  write_atomically(folder.path / "series.csv", "time,v_x\n0,1\n0.5,2\n1,4\n");
  CHECK(view::render_run(job).drawn == 3);
  job.plot = {"v_y"};
  CHECK_THROWS_WITH(view::render_run(job), Contains("no column \"v_y\""));
}

TEST_CASE("A range of frames keeps their numbers and the whole run's colours") {
  Folder folder;
  make_run(folder.path, 6);
  auto job = job_for(folder, "out");
  view::render_run(job);
  auto some = job_for(folder, "some");
  some.frames.first = 1, some.frames.step = 2, some.frames.end = 4;
  CHECK(view::render_run(some).drawn == 2);
  CHECK(names(some.output) == std::vector<std::string>{"000001.png", "000003.png"});
  CHECK(read_file(some.output / "000003.png") == read_file(job.output / "000003.png"));
  CHECK(image::read_png_text(some.output / "000003.png").at("Source") == "3.vtk");
  some.frames.first = 6, some.frames.end.reset();
  CHECK_THROWS_WITH(view::render_run(some), Contains("the run has 6"));
}

TEST_CASE("Movies appear whole or not at all") {
  Folder folder;
  make_run(folder.path, 3);
  auto job = job_for(folder, "out");
  job.output.clear();
  job.style.width = 201;  // odd: H.264 wants even sides
  const auto path = std::string(std::getenv("PATH"));
  SECTION("each kind") {
    for (const char* name : {"m.mp4", "m.gif", "m.png"}) {
      job.movie = folder.path / "movies" / name;
      view::render_run(job);
      CHECK(fs::file_size(job.movie) > 1000);
    }
    CHECK(names(folder.path / "movies") == std::vector<std::string>{"m.gif", "m.mp4", "m.png"});
    CHECK(read_file(folder.path / "movies/m.gif").starts_with("GIF89a"));
    CHECK(read_file(folder.path / "movies/m.png").find("acTL") != std::string::npos);
  }
  SECTION("no ffmpeg") {
    job.movie = folder.path / "movies/m.mp4";
    ::setenv("PATH", folder.path.c_str(), 1);
    CHECK_THROWS_WITH(view::render_run(job), Contains("m.mp4: ffmpeg is not installed"));
    ::setenv("PATH", path.c_str(), 1);
    CHECK(names(folder.path / "movies").empty());
  }
  SECTION("an ffmpeg that fails") {
    const auto fake = folder.path / "bin/ffmpeg";
    fs::create_directories(fake.parent_path());
    std::ofstream(fake) << "#!/bin/sh\nfor last; do :; done\necho half > \"${last#file:}\"\necho 'no room "
                           "left' >&2\nexit 1\n";
    fs::permissions(fake, fs::perms::owner_all);
    job.movie = folder.path / "movies/m.mp4";
    ::setenv("PATH", (fake.parent_path().string() + ":" + path).c_str(), 1);
    CHECK_THROWS_WITH(view::render_run(job), Contains("m.mp4: ffmpeg failed: no room left"));
    ::setenv("PATH", path.c_str(), 1);
    CHECK(names(folder.path / "movies").empty());
  }
  SECTION("a name that says nothing") {
    job.movie = folder.path / "m.avi";
    CHECK_THROWS_AS(view::render_run(job), InputError);
  }
}

TEST_CASE("What cannot be drawn is said in one line") {
  Folder folder;
  make_run(folder.path, 2);
  auto job = job_for(folder, "out");
  SECTION("a frame cut short") {
    const auto file = folder.path / "frames/1.vtk";
    write_atomically(file, read_file(file).substr(0, 900));
    CHECK_THROWS_WITH(view::render_run(job), Contains(file.string() + ": ") && !Contains("\n"));
  }
  SECTION("no contacts for chains") {
    job.style.chains = true;
    CHECK_THROWS_WITH(view::render_run(job), Contains("no contact networks"));
  }
  SECTION("options that do nothing in a plane") {
    using Change = std::function<void(view::FrameStyle&)>;
    for (const auto& change :
         {Change([](auto& s) { s.occlusion = true; }), Change([](auto& s) { s.outlines = true; }),
          Change([](auto& s) { s.floor = false; }), Change([](auto& s) { s.box = true; })}) {
      auto bad = job;
      change(bad.style);
      CHECK_THROWS_WITH(view::render_run(bad), Contains("does nothing here: these grains lie in a plane"));
    }
    job.style.camera.azimuth = 60;
    CHECK_THROWS_WITH(view::render_run(job), Contains("--camera AZIMUTH"));
  }
  SECTION("colours of what has none") {
    job.style.color = "none", job.style.range = {0, 1};
    CHECK_THROWS_WITH(view::render_run(job), Contains("--range does nothing here: nothing is coloured"));
    job.style.range.reset(), job.style.map = "batlow";
    CHECK_THROWS_WITH(view::render_run(job), Contains("--colormap does nothing here: nothing is coloured"));
    job.style.color = "id", job.style.map.clear();
    CHECK_NOTHROW(view::render_run(job));
    fs::remove_all(job.output);
  }
  SECTION("arrows of grains that rest") {
    auto still = grains::small_chute();
    for (auto& array : still.arrays)
      if (array.name == "velocity") std::fill(array.values.begin(), array.values.end(), 0);
    const auto rest = folder.path / "rest";
    grains::write(still, rest / "frames/0.vtk");
    job.source = rest, job.style.arrows = true;
    CHECK_THROWS_WITH(view::render_run(job), Contains("--arrows does nothing here"));
  }
  SECTION("no impacts to mark") {
    job.style.impacts = true;
    CHECK_THROWS_WITH(view::render_run(job), Contains("no impacts.vtp"));
  }
  SECTION("a grain to follow that is not there") {
    job.style.camera.follow = view::Follow{12345};
    CHECK_THROWS_WITH(view::render_run(job), Contains("no grain has the id 12345"));
  }
  SECTION("nothing asked for") {
    job.output.clear();
    CHECK_THROWS_AS(view::render_run(job), InputError);
  }
  CHECK_FALSE(fs::exists(folder.path / "out/000001.png"));
}

TEST_CASE("In space grains stand in their box over a floor, unless told otherwise or bare") {
  Folder folder;
  auto space = grains::cube(3);
  space.domain.max() = {3, 0, 0};
  grains::write(space, folder.path / "frames/0.vtk");
  auto job = job_for(folder, "out");
  const auto draw = [&](auto&& change) {
    auto other = job;
    change(other.style);
    fs::remove_all(other.output);
    view::render_run(other);
    return image::read_png(other.output / "000000.png");
  };
  const auto usual = draw([](auto&) {});
  const auto all = draw([](auto& s) { s.outlines = s.floor = s.box = true; });
  CHECK(usual == all);
  CHECK_FALSE(usual == draw([](auto& s) { s.outlines = false; }));
  CHECK_FALSE(usual == draw([](auto& s) { s.floor = false; }));
  CHECK_FALSE(usual == draw([](auto& s) { s.box = false; }));
  // a box that would make the grains small is drawn where it is asked for
  auto wide = space;
  wide.domain.max() = {40, 0, 0};
  grains::write(wide, folder.path / "frames/0.vtk");
  const auto without = draw([](auto& s) { s.box = false; });
  CHECK(draw([](auto&) {}) == without);
  CHECK_FALSE(draw([](auto& s) { s.box = true; }) == without);
  grains::write(space, folder.path / "frames/0.vtk");
  const auto bare = draw([](auto& s) { s.furniture = false; });
  CHECK(bare == draw([](auto& s) { s.furniture = false, s.outlines = s.floor = s.box = false; }));
  CHECK_FALSE(bare == draw([](auto& s) { s.furniture = false, s.floor = true; }));
}

TEST_CASE("What would do nothing in this run alone is told") {
  Folder folder;
  make_run(folder.path, 1);
  auto job = job_for(folder, "out");
  job.style.trail = 3;
  const auto told = view::render_run(job).notes;
  REQUIRE(told.size() == 1);
  CHECK_THAT(told[0], Contains("--trails does nothing here: there is one frame"));
}

TEST_CASE("Pictures are PNG with their size in print, or pages of that size") {
  const Folder folder;
  make_run(folder.path, 2);
  auto job = job_for(folder, "pictures");
  job.dpi = 254;  // ten pixels a millimetre
  view::render_run(job);
  const auto png = read_file(job.output / "000001.png");
  const auto phys = png.find("pHYs");
  REQUIRE(phys != std::string::npos);
  CHECK(png.substr(phys + 4, 9) == std::string("\0\0\x27\x10\0\0\x27\x10\1", 9));  // 10,000 a metre
  for (const auto format : {view::StillFormat::pdf, view::StillFormat::svg}) {
    job.format = format;
    CHECK(view::render_run(job).drawn == 2);
  }
  CHECK(read_file(job.output / "000001.pdf").starts_with("%PDF"));
  const auto svg = read_file(job.output / "000001.svg");
  CHECK(svg.find(fmt::format("width=\"{:g}pt\"", job.style.width * 72 / 254.0).substr(0, 10)) !=
        std::string::npos);
  job.movie = folder.path / "m.png";
  CHECK_THROWS_WITH(view::render_run(job), Contains("as PNG"));
}

TEST_CASE("a movie of a speed shows as much time, whatever lies between its frames") {
  const Folder folder;
  make_run(folder.path, 5);  // t = 0 … 2
  auto job = job_for(folder, "pictures");
  job.movie = folder.path / "m.png";
  job.speed = 0.5, job.frames_per_second = 10;
  CHECK_THROWS_WITH(view::render_run(job), Contains("--speed is of a movie"));
  job.output.clear();
  std::size_t pictures = 0;
  job.progress = [&](const char* what, std::size_t, std::size_t all) {
    if (std::string(what) == "drawing") pictures = all;
  };
  view::render_run(job);
  CHECK(pictures == 41);  // two units of time in four seconds, both ends shown
  CHECK(fs::exists(job.movie));
  job.speed = 4;
  view::render_run(job);
  CHECK(pictures == 6);
  job.speed = -1;
  CHECK_THROWS_WITH(view::render_run(job), Contains("must be > 0"));
}
