#include <catch2/catch.hpp>

#include "common/atomic_file.hpp"
#include "complaint.hpp"
#include "read/run_frames.hpp"
#include "vtk_files.hpp"

using namespace chute;
using Catch::Matchers::Contains;
using vtk_files::Folder;

namespace {

std::vector<std::string> names(const std::vector<read::FrameFile>& frames) {
  std::vector<std::string> result;
  for (const auto& frame : frames) result.push_back(frame.path.filename().string());
  return result;
}

std::string refusal(const std::filesystem::path& path) {
  return chute::test::complaint([&] { read::find_frames(path); });
}

void touch(const std::filesystem::path& path) {
  std::filesystem::create_directories(path.parent_path());
  write_atomically(path, "");
}

}  // namespace

TEST_CASE("A run's time index") {
  Folder folder;
  touch(folder / "frames/000000.vtp");
  touch(folder / "frames/000001.vtp");
  touch(folder / "contacts/000001.vtp");
  write_atomically(folder / "frames.pvd", R"(<?xml version="1.0"?>
<VTKFile type="Collection" version="0.1"><Collection>
  <DataSet timestep="0.5" group="" part="0" file="frames/000001.vtp"/>
  <DataSet timestep="0" file="frames/000000.vtp"/>
</Collection></VTKFile>)");
  const auto frames = read::find_frames(folder.path);
  REQUIRE(names(frames) == std::vector<std::string>{"000000.vtp", "000001.vtp"});
  CHECK(frames[1].time == 0.5);
  CHECK(frames[0].path == folder / "frames/000000.vtp");
  CHECK(frames[0].contacts.empty());
  CHECK(frames[1].contacts == folder / "contacts/000001.vtp");
  CHECK(read::read_pvd(folder / "frames.pvd").size() == 2);
}

TEST_CASE("A wrong time index is one line") {
  Folder folder;
  const auto pvd = folder / "frames.pvd";
  const auto expect = [&](const char* text, const char* what) {
    write_atomically(pvd, text);
    CHECK_THAT(refusal(pvd), Contains(pvd.string()) && Contains(what) && !Contains("\n"));
  };
  expect("<VTKFile><Collection><DataSet", ":1: not a time index");
  expect("nonsense", ":1: not a time index");
  expect("<VTKFile></VTKFile>", "no element Collection");
  expect("<Collection><DataSet timestep='x' file='a.vtp'/></Collection>", "timestep \"x\" is not a number");
  expect("<Collection><DataSet timestep='1'/></Collection>", "without a file");
  expect("<Collection></Collection>", "no frames");
}

TEST_CASE("A run without frames says how to get them") {
  Folder folder;
  touch(folder / "scene.toml");
  touch(folder / "impacts.vtp");  // grains hit here, but these are no grains
  CHECK_THAT(refusal(folder.path), Contains("the run kept no frames"));
}

TEST_CASE("Files of other engines, in natural order") {
  Folder folder;
  for (const char* name :
       {"dump10.vtk", "dump9.vtk", "dump100.vtk", "dump9_boundingBox.vtk", "notes.txt", "other1.vtu"})
    touch(folder / name);
  CHECK(names(read::find_frames(folder / "dump*.vtk")) ==
        std::vector<std::string>{"dump9.vtk", "dump10.vtk", "dump100.vtk"});
  CHECK(names(read::find_frames(folder.path)) ==
        std::vector<std::string>{"dump9.vtk", "dump10.vtk", "dump100.vtk", "other1.vtu"});
  CHECK(names(read::find_frames(folder / "dump9.vtk")) == std::vector<std::string>{"dump9.vtk"});
  CHECK_THAT(refusal(folder / "none*.vtk"), Contains("no frames"));
  CHECK_THAT(refusal(folder / "none"), Contains("no such file"));
}

TEST_CASE("Parts of one time are one frame; what is named again replaces the earlier") {
  Folder folder;
  write_atomically(folder / "a.pvd", R"(<?xml version="1.0"?><VTKFile type="Collection"><Collection>
  <DataSet timestep=" 0.0" part="0" file="left0.vtp"/><DataSet timestep="0.0" part="1" file="right0.vtp"/>
  <DataSet timestep="+1.0E-01" file="old.vtp"/><DataSet timestep="0.1" file="new.vtp"/>
  <DataSet timestep="0.1" file="new.vtp"/></Collection></VTKFile>)");
  const auto frames = read::find_frames(folder / "a.pvd");
  REQUIRE(names(frames) == std::vector<std::string>{"left0.vtp", "new.vtp"});
  CHECK(frames[0].more == std::vector{folder / "right0.vtp"});
  CHECK(frames[1].more.empty());
  CHECK(frames[1].time == 0.1);
}

TEST_CASE("An index of a series in JSON") {
  Folder folder;
  const auto index = folder / "grains.vtk.series";
  write_atomically(
      index,
      R"({"file-series-version":"1.0","files":[{"name":"b.vtk","time":2},{"name":"a.vtk","time":1e-1}]})");
  const auto frames = read::find_frames(index);
  REQUIRE(names(frames) == std::vector<std::string>{"a.vtk", "b.vtk"});
  CHECK(frames[0].time == 0.1);
  for (const char* wrong : {"", "{}", "[1]", R"({"files":[{"name":"a"}]})", R"({"files":[{"time":0}]})"}) {
    write_atomically(index, wrong);
    CHECK_THAT(refusal(index), Contains("grains.vtk.series: not a time index"));
  }
}
