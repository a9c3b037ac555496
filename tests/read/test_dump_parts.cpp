// Dumps of one file a process: put together where LAMMPS's own name for them is given, never drawn in part.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <set>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "complaint.hpp"
#include "read/dump_parts.hpp"
#include "read/grain_frame.hpp"
#include "vtk_files.hpp"

using namespace chute;
using namespace chute::read;
using Catch::Matchers::Contains;
using chute::test::complaint;
using vtk_files::Folder;
namespace fs = std::filesystem;

namespace {

/// What one process writes at one time: grains begin to end of ten, each at x = id + step.
std::string part(int step, int begin, int end, const std::string& columns = "id element radius x y z",
                 double box = 20) {
  std::string text = fmt::format(
      "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS pp pp ff\n0 {}\n0 20\n0 20\nITEM: ATOMS {}\n",
      step, end - begin, box, columns);
  for (int id = begin; id < end; ++id)
    text += fmt::format("{} {} 0.5 {} 1 1\n", id, id % 3 == 0 ? "sand" : "steel", id + step);
  return text;
}

void write_three(const Folder& folder, const std::vector<int>& steps, const std::string& format = "dump.{}") {
  // grains wander from process to process, and one of them may have none
  std::string texts[3];
  for (const int step : steps) {
    texts[0] += part(step, 0, 4 - step), texts[1] += part(step, 4 - step, 10), texts[2] += part(step, 10, 10);
  }
  for (int k = 0; k < 3; ++k) write_atomically(folder / fmt::format(fmt::runtime(format), k), texts[k]);
}

std::string said(const fs::path& source) {
  return complaint([&] { find_frames(source); });
}

}  // namespace

TEST_CASE("Parts of a dump are one frame a time, with every grain once") {
  Folder folder;
  const std::string name = GENERATE("dump.{}", "flow_{}.lammpstrj", "a+b [1] {}");
  write_three(folder, {0, 1, 2}, name);
  const auto frames = find_frames(folder / fmt::format(fmt::runtime(name), "%"));
  REQUIRE(frames.size() == 3);
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK(frames[k].time == double(k));
    const auto frame = parse_frame(read_files(frames[k]));
    REQUIRE(frame.size() == 10);
    const auto *id = frame.find("id"), *element = frame.find("element");
    REQUIRE((id && element));
    std::set<double> ids;
    for (std::size_t i = 0; i < 10; ++i) {
      const double own = id->values[i];
      CHECK(frame.centre(i)[0] == own + double(k));
      CHECK(element->words.at(static_cast<std::size_t>(element->values[i])) ==
            (int(own) % 3 == 0 ? "sand" : "steel"));
      ids.insert(own);
    }
    CHECK(ids.size() == 10);
  }
}

TEST_CASE("A file a process and a time: both marks together") {
  Folder folder;
  for (const int step : {0, 3}) {
    write_atomically(folder / fmt::format("d.{}.0.txt", step), part(step, 0, 5));
    write_atomically(folder / fmt::format("d.{}.1.txt", step), part(step, 5, 10));
  }
  const auto frames = find_frames(folder / "d.*.%.txt");
  REQUIRE(frames.size() == 2);
  CHECK(frames[1].time == 3.0);
  CHECK_THAT(said(folder / ""), Contains("d.*.%.txt'"));
  write_three(folder, {0, 3});  // beside other files they are parts, too
  CHECK_THAT(said(folder / ""), Contains(".%"));
  CHECK(parse_frame(read_files(frames[1])).size() == 10);
}

TEST_CASE("Files that look like parts are not drawn one for all") {
  Folder folder;
  write_three(folder, {0, 1});
  for (const auto& source : {folder / "", folder / "dump.*"})
    CHECK_THAT(said(source), Contains("files with the same times") && Contains("dump.%'"));
  CHECK(find_frames(folder / "dump.1").size() == 2);  // one that is named is one
}

TEST_CASE("Parts that do not fit are told") {
  Folder folder;
  write_three(folder, {0, 1});
  fs::remove(folder / "dump.1");
  CHECK_THAT(said(folder / "dump.%"), Contains("part 1 is missing"));
  write_atomically(folder / "dump.1", part(1, 3, 10));  // nothing at 0, but at 1
  CHECK_THAT(said(folder / "dump.%"), Contains("part 1 has no whole frame of time 0"));
  write_atomically(folder / "dump.1", part(0, 4, 10));  // the last is still on its way
  const auto frames = find_frames(folder / "dump.%");
  CHECK(frames.size() == 1);
  CHECK_THAT(frames[0].piece->cut_after, Contains("part 1 has no whole frame of time 1"));
  write_atomically(folder / "dump.1", "3\n\n1 0 0 0\n1 0 0 0\n1 0 0 0\n");
  CHECK_THAT(said(folder / "dump.%"), Contains("dump.1: no dump"));
  CHECK_THAT(said(folder / "other.%"), Contains("none with the number of a process"));
  CHECK_THAT(said(folder / "%.%"), Contains("one % stands for"));

  const auto read = [&](const std::string& second) {
    write_atomically(folder / "two.0", part(0, 0, 4)), write_atomically(folder / "two.1", second);
    return complaint([&] { parse_frame(read_files(find_frames(folder / "two.%")[0])); });
  };
  CHECK_THAT(read(part(0, 3, 10)), Contains("grain 3 is in this frame twice"));
  CHECK_THAT(read(part(0, 4, 10, "id element radius x z y")),
             Contains("two.1: its columns id element radius x z y"));
  CHECK_THAT(read(part(0, 4, 10, "id element radius x y z", 21)), Contains("its box is not that of"));
}

TEST_CASE("A restart's later file replaces, and is no part") {
  Folder folder;
  write_atomically(folder / "run.0", part(0, 0, 10) + part(1, 0, 10));
  write_atomically(folder / "run.1", part(1, 0, 10) + part(2, 0, 10));
  CHECK(find_frames(folder / "run.*").size() == 3);
}
