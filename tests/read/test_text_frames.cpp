#include <fmt/format.h>
#include <zlib.h>
#include <zstd.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "common/atomic_file.hpp"
#include "complaint.hpp"
#include "read/byte_stream.hpp"
#include "read/grain_frame.hpp"
#include "read/run_frames.hpp"
#include "read/text_frames.hpp"
#include "vtk_files.hpp"

using namespace chute;
using Catch::Matchers::Contains;
using chute::test::complaint;
using vtk_files::Folder;
namespace fs = std::filesystem;

namespace {

void write_gzip(const fs::path& path, const std::string& text, const char* mode = "wb") {
  gzFile file = gzopen(path.c_str(), mode);
  REQUIRE(gzwrite(file, text.data(), static_cast<unsigned>(text.size())) == static_cast<int>(text.size()));
  REQUIRE(gzclose(file) == Z_OK);
}

std::string zstd(const std::string& text) {
  std::string packed(ZSTD_compressBound(text.size()), '\0');
  packed.resize(ZSTD_compress(packed.data(), packed.size(), text.data(), text.size(), 3));
  return packed;
}

read::GrainFrame only_frame(const fs::path& path) {
  const auto frames = read::find_frames(path);
  REQUIRE(frames.size() == 1);
  return read::parse_frame(read::read_files(frames[0]));
}

/// A box, places in it as fractions, and how often each has gone around.
struct Truth {
  Eigen::Vector3d origin{-1, 2, 0.5};
  Eigen::Matrix3d edges;
  std::vector<Eigen::Vector3d> fractions, turns;

  explicit Truth(bool tilted) {
    std::mt19937 random(7);
    edges << 10, tilted ? 3 : 0, tilted ? -2 : 0, 0, 8, tilted ? 1.5 : 0, 0, 0, 6;
    std::uniform_real_distribution<double> within(0.01, 0.99);
    std::uniform_int_distribution<int> around(-3, 3);
    for (int i = 0; i < 50; ++i) {
      fractions.emplace_back(within(random), within(random), within(random));
      turns.emplace_back(around(random), around(random), 0);  // the third direction has walls
    }
  }
  Eigen::Vector3d place(std::size_t i) const { return origin + edges * fractions[i]; }

  /// As LAMMPS writes it: the bounds are those of the box around the tilted one.
  std::string dump(const std::string& columns, bool images) const {
    Eigen::Vector3d low = Eigen::Vector3d::Constant(INFINITY), high = -low;
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3d at = origin + edges * Eigen::Vector3d(corner & 1, corner >> 1 & 1, corner >> 2);
      low = low.cwiseMin(at), high = high.cwiseMax(at);
    }
    const bool tilted = edges(0, 1) != 0;
    std::string text = "ITEM: TIMESTEP\n100\nITEM: NUMBER OF ATOMS\n50\nITEM: BOX BOUNDS ";
    text += tilted ? "xy xz yz pp pp ff\n" : "pp pp ff\n";
    const double tilts[] = {edges(0, 1), edges(0, 2), edges(1, 2)};
    for (int c = 0; c < 3; ++c)
      text += fmt::format("{:.17g} {:.17g}{}\n", low[c], high[c],
                          tilted ? fmt::format(" {:.17g}", tilts[c]) : "");
    text += "ITEM: ATOMS id type radius " + columns + (images ? " ix iy iz\n" : "\n");
    for (std::size_t i = 0; i < fractions.size(); ++i) {
      const bool scaled = columns[1] == 's', unwrapped = columns.find('u') != std::string::npos;
      Eigen::Vector3d at = fractions[i] + (unwrapped ? turns[i] : Eigen::Vector3d(0, 0, 0));
      if (!scaled) at = origin + edges * at;
      text += fmt::format("{} {} 0.25 {:.17g} {:.17g} {:.17g}", i + 1, i % 2 + 1, at[0], at[1], at[2]);
      text += images ? fmt::format(" {} {} {}\n", turns[i][0], turns[i][1], turns[i][2]) : "\n";
    }
    return text;
  }
};

std::string xyz_frame(double time, double shift) {
  return fmt::format(
      "3\nLattice=\"4 0 0 0 3 0 0 0 2\" Origin=\"-2 0 0\" pbc=\"T F F\" Properties=species:S:1:pos:R:3:velo:R:3:radius:R:1 "
      "Time={} note='two words'\nGlass {} 1 1 0 0 1 0.5\nSteel 1 1 1 0 2 0 0.25\nGlass -1 2 1.5 3 0 0 0.5\n",
      time, shift);
}

}  // namespace

TEST_CASE("However a dump tells places, they are those in its box") {
  Folder folder;
  const bool tilted = GENERATE(false, true);
  const std::string columns = GENERATE("x y z", "xs ys zs", "xu yu zu", "xsu ysu zsu");
  const bool images = GENERATE(false, true);
  CAPTURE(tilted, columns, images);
  const Truth truth(tilted);
  write_atomically(folder / "dump.txt", truth.dump(columns, images));
  const auto frame = only_frame(folder / "dump.txt");
  REQUIRE(frame.size() == 50);
  for (std::size_t i = 0; i < 50; ++i) CHECK((frame.centre(i) - truth.place(i)).norm() < 1e-13 * 40);
  CHECK(frame.time == 100);
  CHECK(frame.clock == "steps");
  CHECK(frame.radius == std::vector<double>(50, 0.25));
  CHECK_FALSE(frame.own);
  CHECK_FALSE(frame.is_fixed(0));
  REQUIRE(frame.lattice);
  CHECK((frame.lattice->edges - truth.edges).norm() < 1e-12);
  CHECK((frame.lattice->origin - truth.origin).norm() < 1e-12);
  // a period along an axis only where an edge lies along it: of a tilted box, the first
  CHECK(frame.period(0) == Approx(10));
  CHECK(frame.period(1) == Approx(tilted ? 0 : 8));
  CHECK(frame.period(2) == 0);
  const Eigen::Vector3d short_way(0.3, -0.2, 0.1);
  CHECK((frame.shortest(short_way + 2 * truth.edges.col(0) - truth.edges.col(1)) - short_way).norm() < 1e-12);
}

TEST_CASE("A dump's vectors, words, units and planes") {
  Folder folder;
  write_atomically(folder / "d", R"(ITEM: UNITS
si
ITEM: TIME
0.5
ITEM: TIMESTEP
500
ITEM: NUMBER OF ATOMS
2
ITEM: BOX BOUNDS pp ff pp
0 4
0 4
-0.1 0.1
ITEM: ATOMS id type element x y diameter vx vy omegax omegay omegaz quati quatj quatk quatw c_stress[1]
7 1 Si 1 2 0.5 3 4 0 0 9 0.1 0.2 0.3 0.9 -1.5
9 2 O 2 2 1 5 6 0 0 8 0 0 0 1 nan
)");
  const auto frame = only_frame(folder / "d");
  CHECK(frame.dimensions == 2);  // its thickness is the format's
  CHECK(frame.time == 0.5);
  CHECK(frame.clock.empty());
  CHECK(frame.units == "SI");
  CHECK(frame.radius == std::vector<double>{0.25, 0.5});
  CHECK(frame.find("velocity")->values == std::vector<double>{3, 4, 0, 5, 6, 0});
  CHECK(frame.find("angular_velocity")->at(1, 2) == 8);
  CHECK(frame.find("orientation")->values == std::vector<double>{0.9, 0.1, 0.2, 0.3, 1, 0, 0, 0});
  CHECK(frame.find("element")->words == std::vector<std::string>{"Si", "O"});
  CHECK(frame.find("id")->at(1) == 9);
  CHECK(frame.find("c_stress[1]")->at(0) == -1.5);
}

TEST_CASE("Frames of one file, packed or not, come one by one and in any order") {
  Folder folder;
  std::string text;
  std::vector<std::string> single;
  for (int i = 0; i < 40; ++i) {
    single.push_back(fmt::format(
        "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS ff ff ff\n0 1\n0 1\n0 1\n"
        "ITEM: ATOMS id x y z radius\n",
        10 * i, 1000 + i));
    for (int k = 0; k < 1000 + i; ++k) single.back() += fmt::format("{} {} {} 1 0.5\n", k, k + 0.25 * i, i);
    text += single.back();
  }
  write_atomically(folder / "a.dump", text);
  write_gzip(folder / "b.dump.gz", text.substr(0, 100'000));
  write_gzip(folder / "b.dump.gz", text.substr(100'000), "ab");  // members one after the other are one file
  write_atomically(folder / "c.any", zstd(text.substr(0, 50'000)) + zstd(text.substr(50'000)));
  for (const char* name : {"a.dump", "b.dump.gz", "c.any"}) {
    CAPTURE(name);
    const auto frames = read::find_frames(folder / name);
    REQUIRE(frames.size() == 40);
    for (std::size_t k = 0; k < 80; ++k) {
      const std::size_t i = k < 40 ? k : 7 * k % 40;
      REQUIRE(read::read_files(frames[i])[0].bytes == single[i]);
      REQUIRE(frames[i].time == 10.0 * static_cast<double>(i));
    }
    const auto frame = read::parse_frame(read::read_files(frames[39]));
    CHECK(frame.size() == 1039);
    CHECK(frame.x[2] == 2 + 0.25 * 39);
  }
}

TEST_CASE("Frames of several files: in order of their times, a restart's later ones replace") {
  Folder folder;
  const auto dump = [](double step, double x) {
    return fmt::format(
        "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS ff ff ff\n0 1\n0 1\n0 1\n"
        "ITEM: ATOMS x y z radius\n{} 0 0 1\n",
        step, x);
  };
  write_atomically(folder / "run1.lammpstrj", dump(0, 1) + dump(100, 2) + dump(200, 3));
  write_gzip(folder / "run2.lammpstrj.gz", dump(100, 4) + dump(200, 5) + dump(300, 6));
  write_atomically(folder / "log.lammps", "LAMMPS (2 Aug 2023)\n");
  for (const auto& source : {folder.path, folder / "run*"}) {
    std::vector<double> x;
    for (const auto& frame : read::find_frames(source))
      x.push_back(read::parse_frame(read::read_files(frame)).x[0]);
    CHECK(x == std::vector<double>{1, 4, 5, 6});
  }
  fs::create_directory(folder / "single");
  for (int i : {9, 10, 11}) write_atomically(folder / fmt::format("single/dump.{}", i), dump(i, i));
  const auto frames = read::find_frames(folder / "single");
  REQUIRE(frames.size() == 3);
  CHECK(frames[1].path.filename() == "dump.10");
}

TEST_CASE("A dump that is being written: its last frame is left out, and that is said") {
  Folder folder;
  const Truth truth(false);
  const auto frame = truth.dump("x y z", false);
  for (const std::size_t cut : {frame.size() - 30, frame.size() / 2, std::size_t{20}}) {
    write_atomically(folder / "d", frame + frame.substr(0, cut));
    const auto pieces = read::find_pieces(folder / "d");
    REQUIRE(pieces.size() == 1);
    CHECK(pieces[0].size == frame.size());
    CHECK_THAT(pieces[0].cut_after, Contains("d:") && Contains("cut short"));
    write_atomically(folder / "d", frame.substr(0, cut));
    CHECK_THAT(complaint([&] { read::find_pieces(folder / "d"); }), Contains("cut short") && !Contains("\n"));
  }
}

TEST_CASE("Wrong dumps are one line with the line's number") {
  Folder folder;
  const auto expect = [&](const std::string& text, const char* what) {
    write_atomically(folder / "d", text);
    CHECK_THAT(complaint([&] { only_frame(folder / "d"); }),
               Contains("d:") && Contains(what) && !Contains("\n"));
  };
  const std::string head = "ITEM: TIMESTEP\n5\nITEM: NUMBER OF ATOMS\n",
                    box = "ITEM: BOX BOUNDS ff ff ff\n0 1\n0 1\n0 1\n";
  expect(head + "2000000000000\n" + box + "ITEM: ATOMS x y z radius\n0 0 0 1\n",
         ":11: cut short: 1 of 2000000000000 rows");
  expect(head + "-2\n" + box + "ITEM: ATOMS x y z radius\n", ":4: the number of atoms is not a whole number");
  expect(head + "1\n" + box + "ITEM: ATOMS x y radius\n1 2 x\n", ":10: radius is \"x\"");
  expect(head + "2\n" + box + "ITEM: ATOMS x y z radius\n1 2 3 1\n1 2 3.5678\n", "3 values, expected 4");
  expect(head + "1\n" + box + "ITEM: ATOMS id radius\n1 1\n", "no columns of places");
  expect(head + "1\nITEM: BOX BOUNDS xy xz yz pp pp pp\n0 1\n0 1\n0 1\nITEM: ATOMS x y z radius\n1 2 3 1\n",
         ":6: an edge of the box, expected 3 numbers");
  expect(head + "1\nITEM: ATOMS xs ys zs radius\n0 0 0 1\n", "no box");
  expect("ITEM: TIMESTEP\n5\nITEM: NUMBER OF GRIDS\n1\n", "no part of a dump of atoms");
  write_atomically(folder / "d", head + "1\n" + box + "ITEM: ATOMS x y z c_1\n1 2 3 4\n");
  CHECK_THAT(complaint([&] { only_frame(folder / "d"); }), Contains("no array of radii") && Contains("c_1"));
}

TEST_CASE("XYZ files: the extended kind with its box and properties, and the plain one") {
  Folder folder;
  write_atomically(folder / "a.xyz", xyz_frame(0, 0) + xyz_frame(0.5, 0.25) + "\n" + xyz_frame(1, 0.5));
  const auto frames = read::find_frames(folder / "a.xyz");
  REQUIRE(frames.size() == 3);
  CHECK(frames[1].time == 0.5);
  const auto frame = read::parse_frame(read::read_files(frames[1]));
  CHECK(frame.x == std::vector<double>{0.25, 1, -1});
  CHECK(frame.radius == std::vector<double>{0.5, 0.25, 0.5});
  CHECK(frame.find("velocity")->at(1, 1) == 2);
  CHECK(frame.find("species")->words == std::vector<std::string>{"Glass", "Steel"});
  CHECK(frame.find("species")->values == std::vector<double>{0, 1, 0});
  CHECK(frame.period(0) == 4);
  CHECK(frame.domain.min().x() == -2);
  CHECK(frame.period(1) == 0);
  CHECK_FALSE(frame.own);

  write_atomically(folder / "b", "2\nwater, any comment\nO 0 0 0.1\nH 1 0 0\n");
  CHECK_THAT(complaint([&] { only_frame(folder / "b"); }),
             Contains("no array of radii or diameters (arrays: species"));
  const auto plain = read::parse_frame(read::read_files(read::find_frames(folder / "b")[0]), 0.3);
  CHECK(plain.z == std::vector<double>{0.1, 0});
  CHECK(plain.radius[1] == 0.3);

  const auto expect = [&](const std::string& text, const char* what) {
    write_atomically(folder / "c", text);
    CHECK_THAT(complaint([&] { only_frame(folder / "c"); }),
               Contains("c:") && Contains(what) && !Contains("\n"));
  };
  expect("1\nProperties=species:S:1:pos:R:4\nA 0 0 0 1\n", ":2: Properties: no place");
  expect("1\nProperties=species:X:1:pos:R:3\nA 0 0 0\n", ":2: Properties: species is of type \"X\"");
  expect("1\nProperties=pos:R:3:radius:R:99999999\n0 0 0 1\n", "99999999 columns, expected 1 to 100");
  expect("1\nLattice=\"1 2 3\" Properties=pos:R:3:radius:R:1\n0 0 0 1\n",
         ":2: Lattice: expected nine numbers");
  expect("99999999999\nProperties=pos:R:3:radius:R:1\n0 0 0 1\n", "cut short: 1 of 99999999999 rows");
}

TEST_CASE("Damaged dumps and packed files are a line or a frame, whatever is wrong") {
  Folder folder;
  const auto text = Truth(true).dump("xs ys zs", true);
  write_gzip(folder / "g", text);
  const std::string originals[] = {text, read_file(folder / "g"), zstd(text), xyz_frame(1, 2)};
  std::mt19937 random(3);
  std::size_t refused = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    auto bytes = originals[trial % 4];
    const auto at = [&] { return std::uniform_int_distribution<std::size_t>(0, bytes.size() - 1)(random); };
    if (trial % 3 == 0) bytes.resize(at());
    for (int k = 0; k < 1 + trial % 5 && !bytes.empty(); ++k)
      bytes[at()] = static_cast<char>(std::uniform_int_distribution<int>(0, 255)(random));
    write_atomically(folder / "d", bytes, Flush::later);
    try {
      for (const auto& frame : read::find_frames(folder / "d")) read::parse_frame(read::read_files(frame));
    } catch (const InputError& error) {
      ++refused;
      REQUIRE(std::string(error.what()).find('\n') == std::string::npos);
    }
  }
  CHECK(refused > 500);
}
