// Contacts of other programs: one network in every form that is read, and what is said of files that lack something.
#include <catch2/catch.hpp>
#include <fstream>

#include "complaint.hpp"
#include "read/grain_frame.hpp"
#include "read/network.hpp"
#include "read/run_frames.hpp"
#include "vtk_files.hpp"

using namespace chute;
using Catch::Matchers::Contains;
using chute::test::complaint;
using Eigen::Vector3d;
using vtk_files::Folder;

namespace {

/// Three grains in a triangle, with ids that are no places in the file, and forces of 3, 5 and 13 between them.
constexpr const char* grains_dump =
    "ITEM: TIMESTEP\n10\nITEM: NUMBER OF ATOMS\n3\nITEM: BOX BOUNDS ff ff ff\n0 10\n0 10\n0 10\n"
    "ITEM: ATOMS id x y z radius\n7 1 1 1 0.5\n3 2 1 1 0.5\n5 1.5 2 1 0.5\n";
const Vector3d of_7(1, 1, 1), of_3(2, 1, 1), of_5(1.5, 2, 1);

void put(const std::filesystem::path& file, const std::string& text) { std::ofstream(file) << text; }

read::GrainFrame grains_of(const Folder& folder) {
  put(folder / "grains.dump", grains_dump);
  return read::parse_frame(read::read_files(read::find_frames(folder / "grains.dump").at(0)));
}

std::vector<read::ForceLink> network_of(const std::filesystem::path& file,
                                        const read::Meanings& meanings = {},
                                        const read::GrainFrame* grains = nullptr) {
  read::FrameFile frame;
  std::vector<read::FrameFile> frames{frame};
  read::attach_networks(frames, file);
  return read::parse_network(read::network_bytes(frames[0]), meanings, grains);
}

void check(const std::vector<read::ForceLink>& links) {
  REQUIRE(links.size() == 3);
  CHECK((links[0].from == of_7 && links[0].to == of_3 && links[0].force == 3));
  CHECK((links[1].from == of_3 && links[1].to == of_5 && links[1].force == 5));
  CHECK((links[2].from == of_5 && links[2].to == of_7 && links[2].force == 13));
}

}  // namespace

TEST_CASE("a network is the same as lines, as rows with ids, and as rows with places") {
  Folder folder;
  const auto grains = grains_of(folder);
  vtk_files::Content lines;
  lines.points = {1, 1, 1, 2, 1, 1, 1.5, 2, 1};
  lines.lines = {0, 1, 1, 2, 2, 0};
  lines.cells = {{"F", {3, 5, 13}}};
  vtk_files::write(lines, folder / "lines.vtp");
  read::Meanings own;
  own.force = {"F"};
  check(network_of(folder / "lines.vtp", own));
  // a wall is no grain: its contact has no line
  put(folder / "ids.csv", "id1,id2,fn\n7,3,3\n3,5,5\n-1,5,99\n5,7,13\n");
  check(network_of(folder / "ids.csv", {}, &grains));
  put(folder / "own.csv", "p,q,Fx,Fy,Fz,word\n7,3,3,0,0,one\n3,5,0,3,4,two\n5,7,3,-4,12,three\n");
  own.force = {"Fx", "Fy", "Fz"}, own.ends = {"p", "q"};
  check(network_of(folder / "own.csv", own, &grains));
  put(folder / "places.csv", "x1;y1;z1;x2;y2;z2;force\n1;1;1;2;1;1;3\n2;1;1;1,5;2;1;5\n1,5;2;1;1;1;1;13\n");
  check(network_of(folder / "places.csv"));
  put(folder / "local.dump",
      "ITEM: TIMESTEP\n10\nITEM: NUMBER OF ENTRIES\n3\nITEM: BOX BOUNDS ff ff ff\n0 10\n0 10\n0 10\n"
      "ITEM: ENTRIES c_1[1] c_1[2] c_1[3] c_1[4] c_1[5] c_1[6] c_1[10]\n"
      "1 1 1 2 1 1 3\n2 1 1 1.5 2 1 5\n1.5 2 1 1 1 1 13\n");
  own.force = {"c_1[10]"}, own.ends = {"c_1[1]", "c_1[2]", "c_1[3]", "c_1[4]", "c_1[5]", "c_1[6]"};
  check(network_of(folder / "local.dump", own));
  vtk_files::Content points;  // a point per contact
  points.points = {1.5, 1, 1, 1.75, 1.5, 1, 1.25, 1.5, 1};
  points.scalars = {{"i", {7, 3, 5}}, {"j", {3, 5, 7}}, {"normal_force", {3, 5, 13}}};
  vtk_files::write(points, folder / "points.vtp");
  check(network_of(folder / "points.vtp", {}, &grains));
}

TEST_CASE("parts of a network are one, and lines that a part repeats count once") {
  Folder folder;
  const auto grains = grains_of(folder);
  vtk_files::Content first, second, none;
  first.points = none.points = {1, 1, 1, 2, 1, 1, 1.5, 2, 1};
  first.lines = {0, 1, 1, 2};
  // only what both parts have is a strength: not the array that is the more usual one
  first.cells = {{"normal_force", {70, 80}}, {"force", {3, 5}}};
  second.points = {2, 1, 1, 1.5, 2, 1, 1, 1, 1};
  second.lines = {0, 1, 1, 2};
  second.cells = {{"force", {5, 13}}, {"vtkGhostType", {1, 0}}};
  vtk_files::write(first, folder / "a.vtp");
  vtk_files::write(none, folder / "b.vtp");
  vtk_files::write(second, folder / "c.vtu", vtk_files::Kind::unstructured);
  put(folder / "all.vtm",
      "<VTKFile type=\"vtkMultiBlockDataSet\"><vtkMultiBlockDataSet><DataSet index=\"0\" file=\"a.vtp\"/>"
      "<DataSet index=\"1\" file=\"b.vtp\"/><DataSet index=\"2\" file=\"c.vtu\"/></vtkMultiBlockDataSet></VTKFile>");
  check(network_of(folder / "all.vtm"));
  read::Meanings own;
  own.force = {"normal_force"};
  CHECK_THAT(complaint([&] { network_of(folder / "all.vtm", own); }), Contains("--force: no array"));
  const auto entries = [&](int part, const std::string& columns, const std::vector<std::string>& rows) {
    std::string text = "ITEM: TIMESTEP\n10\nITEM: NUMBER OF ENTRIES\n" + std::to_string(rows.size()) +
                       "\nITEM: ENTRIES " + columns + "\n";
    for (const auto& row : rows) text += row + "\n";
    put(folder / ("local." + std::to_string(part)), text);
  };
  entries(0, "id1 id2 fn", {"7 3 3", "3 5 5"});
  entries(1, "id1 id2 fn", {});
  entries(2, "fn id2 id1", {"13 7 5"});
  check(network_of(folder / "local.%", {}, &grains));
}

TEST_CASE("what a file of contacts lacks is told, with what is there") {
  Folder folder;
  const auto grains = grains_of(folder);
  put(folder / "a.csv", "a,b,push\n7,3,3\n");
  CHECK_THAT(complaint([&] { network_of(folder / "a.csv", {}, &grains); }),
             Contains("--force names one; there are: a, b, push"));
  read::Meanings wrong;
  wrong.force = {"pusch"};
  CHECK_THAT(complaint([&] { network_of(folder / "a.csv", wrong, &grains); }),
             Contains("--force: no array \"pusch\""));
  put(folder / "b.csv", "one,two,force\n7,3,3\n");
  CHECK_THAT(complaint([&] { network_of(folder / "b.csv", {}, &grains); }), Contains("--ends names them"));
  put(folder / "c.csv", "a,b,force\n7,3,nan\n");
  CHECK_THAT(complaint([&] { network_of(folder / "c.csv", {}, &grains); }),
             Contains("contact 0: a value is not"));
  put(folder / "none.csv", "a,b,force\n");
  CHECK(network_of(folder / "none.csv", {}, &grains).empty());
  put(folder / "local.dump",
      "ITEM: TIMESTEP\n10\nITEM: NUMBER OF ENTRIES\n1\nITEM: BOX BOUNDS ff ff ff\n0 1\n0 1\n0 1\nITEM: ENTRIES a b\n1 2\n");
  CHECK_THAT(
      complaint([&] { read::parse_frame(read::read_files(read::find_frames(folder / "local.dump").at(0))); }),
      Contains("--contacts FILE draws contacts"));
}

TEST_CASE("networks go to the frames of their times, or one to each") {
  Folder folder;
  std::string dumps;
  for (const int step : {10, 20, 30}) {
    std::string one = grains_dump;
    dumps += one.replace(one.find("10\n"), 3, std::to_string(step) + "\n");
  }
  put(folder / "grains.dump", dumps);
  auto frames = read::find_frames(folder / "grains.dump");
  REQUIRE(frames.size() == 3);
  const auto entries = [](int step, int count) {
    std::string text = "ITEM: TIMESTEP\n" + std::to_string(step) + "\nITEM: NUMBER OF ENTRIES\n" +
                       std::to_string(count) + "\nITEM: ENTRIES id1 id2 fn\n";
    for (int k = 0; k < count; ++k) text += "7 3 1\n";
    return text;
  };
  put(folder / "local.dump", entries(20, 2) + entries(30, 3));
  read::attach_networks(frames, folder / "local.dump");
  CHECK(frames[0].contacts.empty());
  const auto grains = read::parse_frame(read::read_files(frames[1]));
  CHECK(read::parse_network(read::network_bytes(frames[1]), {}, &grains).size() == 2);
  CHECK(read::parse_network(read::network_bytes(frames[2]), {}, &grains).size() == 3);
  put(folder / "late.dump", entries(50, 1));
  CHECK_THAT(complaint([&] { read::attach_networks(frames, folder / "late.dump"); }),
             Contains("no contacts have the time of a frame"));
  put(folder / "c9.csv", "a,b,force\n");
  put(folder / "c10.csv", "a,b,force\n");
  CHECK_THAT(complaint([&] { read::attach_networks(frames, folder / "c*.csv"); }),
             Contains("2 files of contacts for 3 frames"));
  put(folder / "c11.csv", "a,b,force\n");
  read::attach_networks(frames, folder / "c*.csv");
  CHECK(frames[0].contacts.filename() == "c9.csv");
  CHECK(frames[2].contacts.filename() == "c11.csv");
}
