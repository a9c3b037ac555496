#include <catch2/catch.hpp>
#include <set>

#include "complaint.hpp"
#include "read/contact_rows.hpp"
#include "read/grain_frame.hpp"
#include "read/network.hpp"
#include "read/run_frames.hpp"
#include "read/surroundings.hpp"
#include "vtk_files.hpp"

using namespace chute;
using Catch::Matchers::Contains;
using Eigen::Vector3d;
using vtk_files::Folder;
using vtk_files::Kind;

TEST_CASE("Walls are polygons in space and lines in the plane, each with its wall's number") {
  Folder folder;
  vtk_files::Content content;
  content.points = {0, 0, 0, 4, 0, 0, 4, 0, 2, 0, 0, 2, 0, 3, 0};
  content.polygons = {{0, 1, 2, 3}, {0, 3, 4}};
  content.cells = {{"wall", {0, 1}}, {"velocity", {0, 0, 0, 1, 0, 0}}};
  const auto kind = GENERATE(Kind::polydata, Kind::legacy_ascii, Kind::legacy_binary);
  vtk_files::write(content, folder / "walls.vtp", kind);
  const auto walls = read::read_walls(folder / "walls.vtp");
  REQUIRE(walls.size() == 2);
  CHECK(walls[0].corners.size() == 4);
  CHECK(walls[0].corners[2] == Vector3d(4, 0, 2));
  CHECK((walls[1].wall == 1 && walls[1].corners.size() == 3));
  content.polygons.clear(), content.lines = {0, 1, 1, 2};
  vtk_files::write(content, folder / "flat.vtp", kind);
  CHECK(read::read_walls(folder / "flat.vtp")[1].corners ==
        std::vector{Vector3d(4, 0, 0), Vector3d(4, 0, 2)});
}

TEST_CASE("Impacts come sorted by time") {
  Folder folder;
  vtk_files::Content content;
  content.points = {0, 1, 0, 2, 1, 0};
  content.scalars = {{"time", {3, 2}}, {"bead", {7, 8}}};
  vtk_files::write(content, folder / "impacts.vtp");
  const auto impacts = read::read_impacts(folder / "impacts.vtp");
  REQUIRE(impacts.size() == 2);
  CHECK((impacts[0].bead == 8 && impacts[0].time == 2 && impacts[0].place == Vector3d(2, 1, 0)));
  content.scalars.erase("bead");
  vtk_files::write(content, folder / "no.vtp");
  CHECK_THROWS_WITH(read::read_impacts(folder / "no.vtp"), Contains("\"bead\""));
  content.points.clear(), content.scalars.clear();
  vtk_files::write(content, folder / "none.vtp");
  CHECK(read::read_impacts(folder / "none.vtp").empty());
}

TEST_CASE("Chains are as strong as normal forces, where a file has forces of both kinds") {
  Folder folder;
  vtk_files::Content content;
  content.points = {0, 0, 0, 1, 0, 0, 1, 1, 0};
  content.lines = {0, 1, 1, 2};
  content.cells = {{"force", {3, 4, 0, 0, 0, 2}}};
  vtk_files::write(content, folder / "a.vtp");
  CHECK(read::read_network(folder / "a.vtp")[0].force == 5);
  content.cells["normal_force"] = {-4, 1};
  vtk_files::write(content, folder / "b.vtp");
  CHECK(read::read_network(folder / "b.vtp")[0].force == 4);
}

TEST_CASE("Contacts are read with all that a run tells of them, and nonsense is refused") {
  Folder folder;
  vtk_files::Content content;
  content.points = {0, 0, 0, 1, 0, 0, 1, 0, 0, 1, -1, 0};
  content.lines = {0, 1, 2, 3};
  content.cells = {{"a", {0, 1}},
                   {"b", {1, -1}},
                   {"overlap", {0.1, 0.2}},
                   {"normal_force", {5, 6}},
                   {"shear_force", {-1, 2}},
                   {"state", {1, 2}},
                   {"point", {0.5, 0, 0, 1, -1, 0}},
                   {"normal", {1, 0, 0, 0, -1, 0}},
                   {"branch", {1, 0, 0, 0, -1, 0}},
                   {"force", {5, -1, 0, 2, -6, 0}}};
  const auto write = [&] { vtk_files::write(content, folder / "c.vtp"); };
  write();
  const auto rows = read::read_contact_rows(folder / "c.vtp");
  REQUIRE(rows.size() == 2);
  CHECK((rows[0].a == 0 && rows[0].b == 1 && rows[1].a == 1 && rows[1].b == -1));
  CHECK(rows[1].force == std::array<double, 3>{2, -6, 0});
  CHECK(rows[0].branch == std::array<double, 3>{1, 0, 0});
  CHECK((rows[1].overlap == 0.2 && rows[1].normal_force == 6 && rows[0].shear_force == -1 &&
         rows[1].state == 2));
  const auto refused = [&](const char* array, std::vector<double> values) {
    auto whole = content.cells[array];
    content.cells[array] = std::move(values);
    write();
    const auto said = test::complaint([&] { read::read_contact_rows(folder / "c.vtp"); });
    content.cells[array] = std::move(whole);
    return said;
  };
  CHECK_THAT(refused("a", {-1, 0}), Contains("contact 0: a is no grain"));
  CHECK_THAT(refused("b", {1, 1e300}), Contains("contact 1: b is no whole number"));
  CHECK_THAT(refused("branch", {NAN, 0, 0, 0, 1, 0}),
             Contains("contact 0: place, normal, branch or overlap"));
  content.cells.erase("branch");
  write();
  CHECK_THAT(test::complaint([&] { read::read_contact_rows(folder / "c.vtp"); }),
             Contains("no cell array \"branch\""));
}

TEST_CASE("Only wanted arrays are unpacked, under any of their names; all are named") {
  Folder folder;
  auto content = vtk_files::three_grains();
  content.vectors["v"] = content.vectors["velocity"];
  content.vectors.erase("velocity");
  const auto kind = GENERATE(Kind::polydata, Kind::unstructured, Kind::legacy_ascii);
  vtk_files::write(content, folder / "f", kind);
  const auto frame = read::read_frame(folder / "f", {}, {"velocity"});
  REQUIRE(frame.find("velocity"));
  CHECK(frame.find("velocity")->at(1, 1) == 4);
  CHECK(frame.find("angle") == nullptr);
  CHECK(frame.radius[1] == 0.4);
  CHECK(frame.is_fixed(0));
  CHECK(std::set<std::string>(frame.names.begin(), frame.names.end()) ==
        std::set<std::string>{"radius", "type", "id", "angle", "v"});
  content.vectors.clear(), content.scalars["vx"] = content.scalars["vy"] = {1, 2, 3};
  vtk_files::write(content, folder / "g", kind);
  CHECK(read::read_frame(folder / "g", {}, {"velocity"}).find("velocity")->at(2, 1) == 3);
}

TEST_CASE("Files beside the frames are those of the run") {
  Folder folder;
  std::filesystem::create_directories(folder / "frames");
  vtk_files::write(vtk_files::three_grains(), folder / "frames/0.vtp");
  vtk_files::write(vtk_files::three_grains(), folder / "walls.vtp");
  CHECK(read::find_beside({folder / "frames/0.vtp", {}, {}}, "walls.vtp") == folder / "walls.vtp");
  CHECK(read::find_beside({folder / "frames/0.vtp", {}, {}}, "impacts.vtp").empty());
  CHECK(read::find_beside({folder / "walls.vtp", {}, {}}, "walls.vtp").empty());
}
