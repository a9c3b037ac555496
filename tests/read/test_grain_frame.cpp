#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdio>
#include <limits>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "read/contacts.hpp"
#include "read/grain_frame.hpp"
#include "vtk_files.hpp"

using namespace chute;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using vtk_files::Folder;
using vtk_files::Kind;

namespace {

/// What InputError says; fails if nothing is thrown.
template <class Work>
std::string complaint(Work&& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  FAIL("no InputError");
  return "";
}

/// What the work writes to standard error: VTK must not talk.
template <class Work>
std::string talk(Work&& work) {
  std::FILE* file = std::tmpfile();
  std::fflush(stderr);
  const int before = ::dup(STDERR_FILENO);
  ::dup2(::fileno(file), STDERR_FILENO);
  work();
  std::fflush(stderr);
  ::dup2(before, STDERR_FILENO);
  ::close(before);
  std::string text(static_cast<std::size_t>(std::ftell(file)), ' ');
  std::rewind(file);
  const auto count = std::fread(text.data(), 1, text.size(), file);
  std::fclose(file);
  return text.substr(0, count);
}

}  // namespace

TEST_CASE("A frame reads the same from every kind of VTK file") {
  Folder folder;
  const auto kind = GENERATE(Kind::polydata, Kind::unstructured, Kind::legacy_ascii, Kind::legacy_binary);
  const auto path = folder / "frame.any";  // the content says what it is, not the name
  vtk_files::write(vtk_files::three_grains(), path, kind);
  const auto frame = read::read_frame(path);
  REQUIRE(frame.size() == 3);
  CHECK(frame.x == std::vector<double>{0.5, 1.5, 2.5});
  CHECK(frame.y == std::vector<double>{0, 0.25, 1});
  CHECK(frame.radius == std::vector<double>{0.5, 0.4, 0.3});
  CHECK(frame.dimensions == 2);
  CHECK(frame.time == 2.5);
  CHECK(frame.units == "reduced");
  CHECK(frame.period(0) == 30);
  CHECK(frame.gravity == std::array<double, 3>{0.6, -0.8, 0});
  CHECK(frame.is_fixed(0));
  CHECK_FALSE(frame.is_fixed(1));
  const auto* velocity = frame.find("velocity");
  REQUIRE(velocity);
  CHECK(velocity->components == 3);
  CHECK(velocity->at(1, 1) == 4);
  CHECK(frame.find("nothing") == nullptr);
}

TEST_CASE("A third dimension is one that grains use, or that is periodic") {
  Folder folder;
  auto content = vtk_files::three_grains();
  content.points[8] = 0.1;
  vtk_files::write(content, folder / "a.vtp");
  CHECK(read::read_frame(folder / "a.vtp").dimensions == 3);
  content.points[8] = 0;
  content.field["domain"] = {0, 30, 0, 10, 0, 5};
  vtk_files::write(content, folder / "b.vtp");
  CHECK(read::read_frame(folder / "b.vtp").dimensions == 3);
}

TEST_CASE("Other engines' names are understood") {
  Folder folder;
  vtk_files::Content content;
  content.points = {0, 0, 1, 2, 0, 1.5};
  SECTION("LIGGGHTS: radius, v, omega, f") {
    content.scalars = {{"radius", {1, 2}}};
    content.vectors = {{"v", {1, 0, 0, 0, 2, 0}}, {"omega", {0, 0, 1, 0, 0, 1}}, {"f", {0, 0, 0, 0, 0, 9}}};
    vtk_files::write(content, folder / "f", Kind::legacy_ascii);
    const auto frame = read::read_frame(folder / "f");
    CHECK(frame.radius == std::vector<double>{1, 2});
    REQUIRE(frame.find("velocity"));
    CHECK(frame.find("velocity")->at(1, 1) == 2);
    CHECK(frame.find("force")->at(1, 2) == 9);
    CHECK(frame.find("angular_velocity")->name == "omega");
    CHECK_FALSE(frame.time.has_value());
  }
  SECTION("LAMMPS: scalars vx vy vz, diameter") {
    content.scalars = {{"diameter", {1, 2}}, {"vx", {1, 2}}, {"vy", {3, 4}}, {"vz", {5, 6}}};
    vtk_files::write(content, folder / "f", Kind::polydata);
    const auto frame = read::read_frame(folder / "f");
    CHECK(frame.radius == std::vector<double>{0.5, 1});
    REQUIRE(frame.find("velocity"));
    CHECK(frame.find("velocity")->values == std::vector<double>{1, 3, 5, 2, 4, 6});
  }
  SECTION("MercuryDPM: Radius, Velocity") {
    content.scalars = {{"Radius", {1, 2}}};
    content.vectors = {{"Velocity", {1, 0, 0, 0, 2, 0}}};
    vtk_files::write(content, folder / "f", Kind::unstructured);
    CHECK(read::read_frame(folder / "f").find("velocity")->at(0, 0) == 1);
  }
  SECTION("YADE: radii, linVelVec") {
    content.scalars = {{"radii", {1, 2}}};
    content.vectors = {{"linVelVec", {1, 0, 0, 0, 2, 0}}};
    vtk_files::write(content, folder / "f", Kind::unstructured);
    CHECK(read::read_frame(folder / "f").find("velocity")->at(0, 0) == 1);
  }
}

TEST_CASE("Without radii one may be given") {
  Folder folder;
  auto content = vtk_files::three_grains();
  content.scalars.erase("radius");
  vtk_files::write(content, folder / "f.vtp");
  CHECK_THAT(complaint([&] { read::read_frame(folder / "f.vtp"); }),
             StartsWith((folder / "f.vtp").string() + ": no array of radii") && Contains("velocity"));
  CHECK(read::read_frame(folder / "f.vtp", 0.5).radius == std::vector<double>(3, 0.5));
}

TEST_CASE("A wrong file is one line that names it, and VTK is silent") {
  Folder folder;
  const auto path = folder / "f.vtp";
  const auto kind = GENERATE(Kind::polydata, Kind::unstructured, Kind::legacy_ascii, Kind::legacy_binary);
  vtk_files::write(vtk_files::three_grains(), path, kind);
  const auto whole = read_file(path);
  const auto expect_line = [&](const std::string& bytes) {
    std::string line;
    const auto said = talk([&] { line = complaint([&] { read::parse_frame(bytes, "f.vtp"); }); });
    CHECK(said.empty());
    CHECK_THAT(line, StartsWith("f.vtp: "));
    CHECK(line.find('\n') == std::string::npos);
  };
  expect_line("");
  expect_line("hello, I am no VTK file\n");
  expect_line(std::string(1000, '\0'));
  // cut short anywhere but in the blanks and marks of the end
  for (std::size_t part = 1; part < 40; ++part) expect_line(whole.substr(0, part * (whole.size() - 80) / 40));
}

TEST_CASE("Values that are no numbers are refused with the point") {
  Folder folder;
  auto content = vtk_files::three_grains();
  SECTION("position") {
    content.points[4] = std::numeric_limits<double>::quiet_NaN();
    vtk_files::write(content, folder / "f.vtp");
    CHECK_THAT(complaint([&] { read::read_frame(folder / "f.vtp"); }), Contains("point 1: y is not a finite number"));
  }
  SECTION("radius") {
    content.scalars["radius"][2] = GENERATE(0.0, -1.0, std::numeric_limits<double>::infinity());
    vtk_files::write(content, folder / "f.vtp");
    CHECK_THAT(complaint([&] { read::read_frame(folder / "f.vtp"); }), Contains("point 2: radius"));
  }
  SECTION("no points") {
    vtk_files::write({}, folder / "f.vtp");
    CHECK_THAT(complaint([&] { read::read_frame(folder / "f.vtp"); }), Contains("no points"));
  }
  SECTION("another kind of VTK data") {
    vtk_files::write({}, folder / "f.vti", Kind::image);
    CHECK_THAT(complaint([&] { read::read_frame(folder / "f.vti"); }), Contains("ImageData, expected PolyData"));
  }
  SECTION("missing, or a folder") {
    CHECK_THAT(complaint([&] { read::read_frame(folder / "none.vtp"); }), Contains("none.vtp: cannot read"));
    CHECK_THAT(complaint([&] { read::read_frame(folder.path); }), Contains("is a directory"));
  }
}

TEST_CASE("Damage inside does not end the program") {
  Folder folder;
  vtk_files::write(vtk_files::three_grains(), folder / "f.vtp");
  const auto whole = read_file(folder / "f.vtp");
  const auto broken = [&](const std::string& from, const std::string& to) {
    auto bytes = whole;
    const auto at = bytes.find(from);
    REQUIRE(at != std::string::npos);
    bytes.replace(at, from.size(), to);
    return complaint([&] { read::parse_frame(bytes, "f.vtp"); });
  };
  CHECK_THAT(broken("type=\"Float64\"", "type=\"Floss64\""), Contains("unknown type \"Floss64\""));
  CHECK_THAT(broken("NumberOfPoints=\"3\"", "NumberOfPoints=\"3000000000\""), Contains("NumberOfPoints"));
  CHECK_THAT(broken("<PointData", "<Pointdata"), Contains("damaged"));
}

TEST_CASE("A contact network has its forces") {
  Folder folder;
  vtk_files::Content content;
  content.points = {0, 0, 0, 1, 0, 0, 1, 1, 0};
  content.lines = {0, 1, 1, 2};
  content.cells = {{"force", {2, 5}}};
  vtk_files::write(content, folder / "c.vtp");
  const auto contacts = read::read_contacts(folder / "c.vtp");
  REQUIRE(contacts.size() == 2);
  CHECK(contacts[1].from == std::array<double, 3>{1, 0, 0});
  CHECK(contacts[1].to == std::array<double, 3>{1, 1, 0});
  CHECK(contacts[1].force == 5);
  content.cells = {{"nonsense", {2, 5}}};
  vtk_files::write(content, folder / "d.vtp");
  CHECK_THAT(complaint([&] { read::read_contacts(folder / "d.vtp"); }), Contains("no cell array \"force\""));
}
