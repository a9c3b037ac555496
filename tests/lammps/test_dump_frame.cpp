#include <catch2/catch.hpp>

#include "common/error.hpp"
#include "engines/lammps/dump_frame.hpp"
#include "folder.hpp"

using namespace chute;
using Catch::Matchers::Contains;

TEST_CASE("A dump of LAMMPS's is read as it wrote it, and a part of one is refused") {
  test::Folder folder;
  const std::string whole =
      "ITEM: TIMESTEP\n42\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS pp ss pp\n-5 5\n0 1e+01\n-1 1\n"
      "ITEM: ATOMS id x f_w[1] \n1 -0.48999999999999999 0 \n2 1.5e-3 1 \n";
  const auto read = [&](const std::string& text) {
    test::write(folder / "a", text);
    return lammps::read_dump_frame(folder / "a");
  };
  const auto frame = read(whole);
  CHECK(frame.step == 42);
  CHECK(frame.names == std::vector<std::string>{"id", "x", "f_w[1]"});
  REQUIRE(frame.rows() == 2);
  CHECK(frame.at(0, 1) == -0.49);
  CHECK(frame.at(1, 1) == 1.5e-3);
  const auto none = read(
      "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ENTRIES\n0\nITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\nITEM: ENTRIES c_a[1] c_a[2] \n");
  CHECK(none.rows() == 0);
  for (std::size_t length = 1; length + 2 < whole.size(); ++length) {
    const auto cut = whole.substr(0, length);
    const bool told =
        test::message<InputError>([&] { read(cut); }).find("no whole frame of a dump") != std::string::npos;
    // a number that is cut short is a number; the last row has three columns all the same
    if (!told) CHECK(length > whole.size() - 4);
  }
  CHECK_THROWS_WITH(read(whole + "3 0 0\n"), Contains("more rows"));
  CHECK_THROWS_WITH(
      read("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1000000000000000\nITEM: ATOMS id x\n1 2\n"),
      Contains("cut short"));
}

TEST_CASE("The dumps of a folder are found by their steps") {
  test::Folder folder;
  for (const char* name :
       {"grains.000000000100", "grains.000000000000", "grains.5", "contacts.7", "grains.x", "grains.1.tmp"})
    test::write(folder / name, "");
  CHECK(lammps::steps_in(folder.path(), "grains") == std::vector<std::int64_t>{0, 5, 100});
  CHECK(lammps::steps_in(folder / "nowhere", "grains").empty());
}
