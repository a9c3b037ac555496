// Fields by cell: what a run writes, read back.
#include <catch2/catch.hpp>

#include "common/error.hpp"
#include "folder.hpp"
#include "read/image_data.hpp"
#include "read/run_frames.hpp"
#include "run/run.hpp"
#include "scene/scene.hpp"

using namespace chute;
using namespace chute::test;

namespace cells_tests {

namespace {

const char* gas = R"(
units = "reduced"
[incline]
angle = "0 deg"
gravity = 0
[domain]
periodic = ["x", "y"]
size = [20, 10]
[bed]
kind = "none"
[grains]
count = 50
diameter = { mean = 1.0 }
start = { kind = "square", spacing = 2, height = 1, velocity = 0.5, spread = 1 }
[contact.normal]
law = "spring-dashpot"
stiffness = 1e4
restitution = 0.9
[contact.tangential]
law = "frictionless"
[engine]
method = "dsmc"
tangential_restitution = -1
time_step = 0.1
[run]
duration = 4
[output]
cells = { every = 2, width = 5, samples = 2 }
)";

run::RunOptions into(const Folder& folder, const std::string& name) {
  run::RunOptions options;
  options.directory = folder / name;
  return options;
}

}  // namespace

TEST_CASE("a run's cells add up to its grains, and give their mean velocity and temperature") {
  const Folder folder;
  run::run_scene(scene::parse_scene(gas, "gas.toml"), into(folder, "run"));
  const auto files = read::read_pvd(folder / "run" / "cells.pvd");
  REQUIRE(files.size() == 3);
  CHECK(*files[2].time == 4);
  const auto data = read::read_image_data(files[2].path);
  CHECK(data.units == "reduced");
  CHECK(data.points == std::array<int, 3>{5, 3, 1});
  const auto number = read::field_of(data, "number", files[2].path),
             rho = read::field_of(data, "density", files[2].path),
             v_x = read::field_of(data, "velocity:x", files[2].path);
  CHECK(number.first[0] == 2.5);
  double grains = 0, mass = 0, momentum = 0;
  for (std::size_t i = 0; i < 8; ++i) {
    grains += number.values[i], mass += 25 * rho.values[i];
    if (std::isfinite(v_x.values[i])) momentum += 25 * rho.values[i] * v_x.values[i];
  }
  CHECK(grains == Approx(50));
  CHECK(mass == Approx(50));
  // Momentum is kept by a gas in a periodic box: that of the start, as its series tells.
  const auto series = content(folder / "run" / "series.csv");
  CHECK(std::abs(momentum / 50 - 0.5) < 5 / std::sqrt(50.0));
  CHECK_THROWS_WITH(read::field_of(data, "densty", "f.vti"), Catch::Contains("did you mean \"density\""));
}

TEST_CASE("cells are the same bytes after a restart") {
  const Folder folder;
  const auto scene = scene::parse_scene(gas, "gas.toml");
  run::run_scene(scene, into(folder, "whole"));
  auto options = into(folder, "parts");
  int calls = 0;
  options.progress = [&](double part) { return part < 0.4 || ++calls > 1000; };
  run::run_scene(scene, options);
  options.progress = nullptr;
  options.existing = run::Existing::resume;
  run::run_scene(scene, options);
  for (const char* name : {"cells.pvd", "cells/000001.vti", "cells/000002.vti", "series.csv"})
    CHECK(content(folder / "whole" / name) == content(folder / "parts" / name));
}

TEST_CASE("a broken file of cells is one clear line") {
  const Folder folder;
  write(folder / "a.vti", "nothing");
  CHECK_THROWS_WITH(read::read_image_data(folder / "a.vti"),
                    Catch::Contains("a.vti: not a VTK file of image data"));
  write(folder / "b.vti", "<VTKFile type=\"ImageData\"><ImageData WholeExtent=\"0 1 0 1 0 0\">");
  CHECK_THROWS_WITH(read::read_image_data(folder / "b.vti"), Catch::Contains("b.vti: damaged or cut short"));
}

TEST_CASE("an automaton's scene has no grains of its own, and its clock counts updates") {
  const Folder folder;
  const std::string text = R"(
[incline]
angle = "0 deg"
[domain]
periodic = ["x"]
size = [30, 17.320508]
[bed]
kind = "none"
[engine]
method = "automaton"
dissipation = 0.2
gravity = 0.3
[run]
duration = 40
[output]
frames = { every = 20 }
cells = { every = 20, width = 5 }
)";
  const auto scene = scene::parse_scene(text, "lattice.toml");
  run::run_scene(scene, into(folder, "run"));
  CHECK(content(folder / "run" / "series.csv").find("\nupdates,") != std::string::npos);
  CHECK(content(folder / "run" / "run.json").find("\"clock\": \"updates\"") != std::string::npos);
  CHECK(fs::exists(folder / "run" / "frames" / "000002.vtp"));
  // Written back it is the same scene.
  CHECK(scene::to_toml(scene::parse_scene(scene::to_toml(scene), "again.toml")) == scene::to_toml(scene));
  CHECK_THROWS_WITH(scene::parse_scene(text + "[grains]\ncount = 3\n", "lattice.toml"),
                    Catch::Contains("grains: engine.method = \"automaton\" lays its grains itself"));
  CHECK_THROWS_WITH(scene::parse_scene(text + "avalanches = {}\n", "lattice.toml"),
                    Catch::Contains("tells of no avalanches"));
}

}  // namespace cells_tests
