#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <sstream>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "folder.hpp"
#include "read/run_frames.hpp"
#include "read/table.hpp"
#include "write/convert.hpp"
#include "write/frame_file.hpp"

using namespace chute;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

/// Grains of a chute of 2 or 3 dimensions as its own frame has them, with numbers that use all digits.
read::GrainFrame chute_frame(int dimensions, std::size_t count = 40) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> number(-3, 3), part(0, 1);
  read::GrainFrame frame;
  frame.own = true;
  frame.units = "SI";
  frame.dimensions = dimensions;
  frame.time = 1.0 / 3;
  frame.gravity = {3.1, 0.25, -9.3};
  frame.domain.min()[0] = -1.5, frame.domain.max()[0] = 31 + 1.0 / 7;
  if (dimensions == 3) frame.domain.min()[1] = 0, frame.domain.max()[1] = 10 * std::sqrt(2.0);
  const auto array = [&](const char* name, int components, auto&& value) {
    read::PointArray a{name, components, {}};
    for (std::size_t i = 0; i < count; ++i)
      for (int c = 0; c < components; ++c) a.values.push_back(value(i, c));
    frame.arrays.push_back(a);
    frame.names.push_back(name);
  };
  for (std::size_t i = 0; i < count; ++i) {
    frame.x.push_back(-1.5 + 32 * part(random));
    frame.y.push_back(10 * part(random));
    frame.z.push_back(dimensions == 3 ? 5 * part(random) : 0);
    frame.radius.push_back(0.4 + 0.2 * part(random));
  }
  const bool flat = dimensions == 2;
  const auto any = [&](std::size_t, int) { return number(random); };
  array("id", 1, [](std::size_t i, int) { return static_cast<double>(i); });
  array("type", 1, [&](std::size_t i, int) { return i < 25 ? 1.0 : 0.0; });
  array("material", 1, [&](std::size_t i, int) { return static_cast<double>(i % 3); });
  array("radius", 1, [&](std::size_t i, int) { return frame.radius[i]; });
  array("mass", 1, [&](std::size_t, int) { return 1e-5 * part(random); });
  array("velocity", 3, [&](std::size_t i, int c) { return flat && c == 2 ? 0 : any(i, c); });
  array("angular_velocity", 3, [&](std::size_t i, int c) { return flat && c < 2 ? 0 : 1e-9 * any(i, c); });
  if (flat)
    array("angle", 1, any);
  else
    array("orientation", 4, any);
  array("force", 3, [&](std::size_t i, int c) { return 1e12 * any(i, c); });
  array("heat", 1, any);  // that chute has no name for
  array("strain", 6, any);
  return frame;
}

void same_numbers(const std::vector<double>& a, const std::vector<double>& b) {
  REQUIRE(a.size() == b.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < a.size(); ++i) different += !(a[i] == b[i]);
  CHECK(different == 0);
}

/// All that chute has names for, to the last bit.
void same_grains(const read::GrainFrame& a, const read::GrainFrame& b) {
  REQUIRE(a.size() == b.size());
  CHECK(a.dimensions == b.dimensions);
  same_numbers(a.x, b.x), same_numbers(a.y, b.y), same_numbers(a.z, b.z), same_numbers(a.radius, b.radius);
  for (const char* name : {"id", "type", "material", "mass", "velocity", "angular_velocity", "force", "heat",
                           a.dimensions == 2 ? "angle" : "orientation"}) {
    CAPTURE(name);
    const auto *one = a.find(name), *other = b.find(name);
    REQUIRE(one);
    REQUIRE(other);
    CHECK(one->components == other->components);
    same_numbers(one->values, other->values);
  }
}

read::GrainFrame read_back(const test::Folder& folder, const std::string& name, const std::string& bytes) {
  write_atomically(folder / name, bytes);
  return read::read_frame(folder / name);
}

}  // namespace

TEST_CASE("Every format gives back the same numbers, to the last digit") {
  const int dimensions = GENERATE(2, 3);
  CAPTURE(dimensions);
  test::Folder folder;
  const auto frame = chute_frame(dimensions);
  const write::FrameFacts facts{7, frame.time, false};
  SECTION("dump") {
    const auto back = read_back(folder, "a.dump", write::lammps_dump(frame, facts));
    same_grains(frame, back);
    CHECK(back.time == frame.time);
    CHECK(back.units == "SI");
    CHECK(back.domain.min()[0] == frame.domain.min()[0]);
    CHECK(back.domain.max()[0] == Approx(frame.domain.max()[0]).epsilon(1e-15));  // the reader keeps lengths
    CHECK(back.period(1) == frame.period(1));
    // and on from there: a dump of the dump, and VTK of it
    same_grains(frame, read_back(folder, "b.dump", write::lammps_dump(back, facts)));
    const auto vtk = read_back(folder, "b.vtp", write::vtp_frame(back, facts));
    same_grains(frame, vtk);
    CHECK(vtk.own);
    CHECK(vtk.is_fixed(30));
    CHECK_FALSE(vtk.is_fixed(3));
  }
  SECTION("XYZ") {
    const auto back = read_back(folder, "a.xyz", write::xyz_frame(frame, facts));
    same_grains(frame, back);
    CHECK(back.time == frame.time);
    CHECK(back.gravity == frame.gravity);
    CHECK(back.period(0) == frame.period(0));
    CHECK(back.period(1) == frame.period(1));
    CHECK(back.period(2) == 0);
    CHECK(back.find("strain")->values == frame.find("strain")->values);
    same_grains(frame, read_back(folder, "b.xyz", write::xyz_frame(back, facts)));
  }
  SECTION("VTK") {
    const auto back = read_back(folder, "a.vtp", write::vtp_frame(frame, facts));
    same_grains(frame, back);
    CHECK(back.own);
    CHECK(back.time == frame.time);
    CHECK(back.units == frame.units);
    CHECK(back.gravity == frame.gravity);
    CHECK(back.domain.min() == frame.domain.min());
    CHECK(back.domain.max() == frame.domain.max());
    CHECK(back.find("strain")->values == frame.find("strain")->values);
  }
  SECTION("CSV") {
    write_atomically(folder / "a.csv", write::csv_frame(frame, facts));
    const auto table = read::read_table(folder / "a.csv");
    const auto column = [&](const std::string& name) { return table.column(name); };
    same_numbers(column("x"), frame.x);
    same_numbers(column("radius"), frame.radius);
    same_numbers(column("mass"), frame.find("mass")->values);
    const auto v_y = column("velocity_y");
    REQUIRE(v_y.size() == frame.size());
    for (std::size_t i = 0; i < frame.size(); ++i) CHECK(v_y[i] == frame.find("velocity")->at(i, 1));
    const auto last = column(dimensions == 2 ? "angle" : "orientation_z");
    for (std::size_t i = 0; i < frame.size(); ++i)
      CHECK(last[i] == (dimensions == 2 ? frame.find("angle")->at(i) : frame.find("orientation")->at(i, 3)));
  }
}

TEST_CASE("A dump says the box as LAMMPS does") {
  const auto bounds = [](const read::GrainFrame& frame) {
    std::istringstream in(write::lammps_dump(frame, {0, frame.time, false}));
    std::string line, text;
    while (std::getline(in, line) && !line.starts_with("ITEM: ATOMS"))
      if (line.starts_with("ITEM: BOX") || !text.empty()) text += line + "\n";
    return text;
  };
  auto frame = chute_frame(2, 2);
  frame.x = {1, 3}, frame.y = {0.5, 4}, frame.z = {0, 0}, frame.radius = {0.5, 0.25};
  frame.domain.min()[0] = 0, frame.domain.max()[0] = 8;
  // In the plane LAMMPS wants the thickness to repeat; upwards the box ends with the grains.
  CHECK(bounds(frame) == "ITEM: BOX BOUNDS pp ss pp\n0 8\n0 4.25\n-0.5 0.5\n");
  frame.dimensions = 3;
  frame.z = {-1, 2};
  CHECK(bounds(frame) == "ITEM: BOX BOUNDS pp ss ss\n0 8\n0 4.25\n-1.5 2.25\n");
  frame.domain.min()[1] = -2, frame.domain.max()[1] = 6;
  CHECK(bounds(frame) == "ITEM: BOX BOUNDS pp pp ss\n0 8\n-2 6\n-1.5 2.25\n");
  // A tilted box keeps its edges, in bounds that enclose it.
  read::Lattice lattice;
  lattice.origin = {1, 2, 3};
  lattice.edges << 10, 3, -2, 0, 8, 1.5, 0, 0, 6;
  lattice.periodic = {true, true, false};
  frame.lattice = lattice;
  CHECK(bounds(frame) == "ITEM: BOX BOUNDS xy xz yz pp pp ff\n-1 14 3\n2 11.5 -2\n3 9 1.5\n");
  lattice.edges << 0, 3, -2, 4, 8, 1.5, 1, 0, 6;
  frame.lattice = lattice;
  test::Folder folder;
  const auto back = read_back(folder, "a.dump", write::lammps_dump(frame, {0, frame.time, false}));
  CHECK(back.lattice->edges == lattice.edges);
  CHECK(back.lattice->origin == lattice.origin);
  CHECK(back.lattice->periodic == lattice.periodic);
}

TEST_CASE("Ids and types of a dump begin with 1 where LAMMPS is to read it") {
  test::Folder folder;
  const auto frame = chute_frame(3);
  const auto back = read_back(folder, "a.dump", write::lammps_dump(frame, {0, frame.time, true}));
  for (std::size_t i = 0; i < frame.size(); ++i) {
    CHECK(back.find("id")->at(i) == frame.find("id")->at(i) + 1);
    CHECK(back.find("type")->at(i) == frame.find("type")->at(i) + 1);
  }
}

TEST_CASE("Species that are words stay words, and another program's types do not become a bed") {
  test::Folder folder;
  write_atomically(
      folder / "in.xyz",
      "2\nLattice=\"4 0 0 0 3 0 0 0 2\" pbc=\"T F F\" Properties=species:S:1:pos:R:3:radius:R:1:type:I:1\n"
      "Glass 1 1 1 0.5 0\nSteel 2 2 1 0.25 1\n");
  const auto frame = read::read_frame(folder / "in.xyz");
  CHECK_THAT(write::lammps_dump(frame, {}),
             Contains("\nITEM: ATOMS id type x y z radius species\n0 0 1 1 1 0.5 Glass\n"));
  CHECK_THAT(write::xyz_frame(frame, {}), Contains("\nGlass 1 1 1 0.5 0\nSteel 2 2 1 0.25 1\n"));
  const auto back = read_back(folder, "a.vtp", write::vtp_frame(frame, {}));
  CHECK_FALSE(back.is_fixed(0));
  CHECK(back.find("material")->values == std::vector<double>{0, 1});
}

TEST_CASE("Names of arrays that would end a line or a column do not") {
  test::Folder folder;
  auto frame = chute_frame(3);
  frame.arrays.push_back({"hot\nand \"cold\"", 1, frame.radius});
  frame.names.push_back(frame.arrays.back().name);
  const std::vector<std::pair<const char*, std::string>> files{{"a.xyz", write::xyz_frame(frame, {})},
                                                               {"a.dump", write::lammps_dump(frame, {})}};
  for (const auto& [name, bytes] : files) {
    const auto back = read_back(folder, name, bytes);
    CAPTURE(name);
    const auto found = std::ranges::find_if(
        back.arrays, [](const auto& array) { return array.name.starts_with("hot_and_"); });
    REQUIRE(found != back.arrays.end());
    CHECK(found->values == frame.radius);
  }
  CHECK_THAT(write::csv_frame(frame, {}), Contains(",hot_and__cold_"));
}

TEST_CASE("A folder of frames is read frame by frame, and none is mixed with others") {
  test::Folder folder;
  const auto frame = chute_frame(2);
  std::string dumps;
  for (int k = 0; k < 3; ++k)
    dumps += write::lammps_dump(frame, {static_cast<std::uint64_t>(k), 0.5 * k, false});
  write_atomically(folder / "all.dump", dumps);
  write::ConvertJob job;
  job.sources = {folder / "all.dump"};
  job.folder = folder / "out";
  job.format = write::Format::vtp;
  CHECK(write::convert(job).frames == 3);
  const auto found = read::find_frames(folder / "out");
  REQUIRE(found.size() == 3);
  CHECK(found[2].time == 1.0);
  same_grains(frame, read::parse_frame(read::read_files(found[1])));
  CHECK_THROWS_WITH(write::convert(job), Contains("is not empty"));
  job.folder = folder / "one", job.format = write::Format::xyz, job.one_file = true;
  CHECK(write::convert(job).frames == 3);
  CHECK(read::find_frames(folder / "one").size() == 3);
  // What cannot be read leaves no folder.
  write_atomically(folder / "bad.dump",
                   "ITEM: TIMESTEP\n1\nITEM: NUMBER OF ATOMS\n1\nITEM: ATOMS id x y z\n1 0 0 0\n");
  job.sources = {folder / "bad.dump"}, job.folder = folder / "none";
  CHECK_THROWS_AS(write::convert(job), InputError);
  CHECK_FALSE(fs::exists(folder / "none"));
}
