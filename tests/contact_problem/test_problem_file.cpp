// Problems written in each format that is read, read again; and files that are wrong.
#include <fmt/format.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <fstream>
#include <random>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "engines/contact/problem/problem_file.hpp"
#include "engines/contact/solver/assemble.hpp"
#include "engines/contact/solver/nsgs.hpp"
#include "fixtures.hpp"

using namespace chute;
using namespace chute::contact;
namespace fs = std::filesystem;

namespace {

struct Folder {
  fs::path path = fs::temp_directory_path() / fmt::format("contact_problem.{}", ::getpid());
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
  fs::path operator/(const char* name) const { return path / name; }
};

void write(const fs::path& path, const std::string& content) {
  std::ofstream(path, std::ios::binary) << content;
}
std::string slurp(const fs::path& path) { return read_file(path); }

/// A chain of contacts, each of which feels its neighbours: blocks that are neither symmetric nor alike.
template <int D>
Problem<D> chain(std::size_t m) {
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t j = i ? i - 1 : 0; j < std::min(m, i + 2); ++j)
      for (std::size_t k = 0; k < D; ++k)
        for (std::size_t l = 0; l < D; ++l)
          entries.push_back(
              {i * D + k, j * D + l,
               (i == j && k == l ? 2.0 : 0) + 0.1 / static_cast<double>(1 + i + 2 * j + 3 * k + 5 * l)});
  std::vector<Vec<D>> q(m);
  std::vector<double> friction(m);
  for (std::size_t i = 0; i < m; ++i) {
    friction[i] = 0.1 * static_cast<double>(i);
    for (int k = 0; k < D; ++k) q[i][k] = std::sin(1.0 + static_cast<double>(i) * 3 + k);
  }
  return assemble<D>(entries, q, friction);
}

template <int D>
void same(const Problem<D>& read, const Problem<D>& problem) {
  REQUIRE(read.row_starts == problem.row_starts);
  REQUIRE(read.columns == problem.columns);
  REQUIRE(read.blocks == problem.blocks);
  REQUIRE(read.q == problem.q);
  REQUIRE(read.friction == problem.friction);
}

TEMPLATE_TEST_CASE_SIG("every format gives the problem back", "", ((int D), D), 2, 3) {
  const Folder folder;
  const auto problem = chain<D>(5);
  using test::Form, test::Storage;
  for (const auto storage : {Storage::dense, Storage::blocks, Storage::columns, Storage::triplets})
    for (const bool origin : {false, true}) {
      write(folder / "p.dat", test::siconos_text(problem, storage, origin));
      same(std::get<Problem<D>>(read_problem(folder / "p.dat")), problem);
    }
  for (const auto form : {Form::triplets, Form::columns, Form::rows}) {
    test::write_fclib_local(folder / "p.hdf5", problem, form);
    same(std::get<Problem<D>>(read_problem(folder / "p.hdf5")), problem);
  }
}

template <int D>
std::vector<Vec<D>> solved(const fs::path& path) {
  const auto problem = std::get<Problem<D>>(read_problem(path));
  AssembledSystem<D> system(problem);
  Team team(1);
  REQUIRE(nsgs(system, {.tolerance = 1e-13, .iterations = 10'000}, team).reached);
  return system.result();
}

TEST_CASE("bodies, directions and forces: two discs one on the other on an incline") {
  // v = (x, y, spin) of each; the columns of H: normal and tangent of the floor's contact, then of theirs
  const Folder folder;
  const double m = 2, g = 9.81, angle = 0.2, radius = 0.5, inertia = m * radius * radius / 2;
  test::Global global{.dimensions = 2,
                      .m = {},
                      .h = {{0, 1, 0, -1},
                            {1, 0, -1, 0},
                            {0, radius, 0, radius},
                            {0, 0, 0, 1},
                            {0, 0, 1, 0},
                            {0, 0, 0, radius}},
                      .f = {m * g * std::sin(angle), -m * g * std::cos(angle), 0, m * g * std::sin(angle),
                            -m * g * std::cos(angle), 0},
                      .w = {0, 0, 0, 0},
                      .mu = {0.5, 0.5}};
  for (std::size_t k = 0; k < 6; ++k) {
    global.m.emplace_back(6, 0.0);
    global.m[k][k] = k % 3 == 2 ? inertia : m;
  }
  for (const auto form : {test::Form::triplets, test::Form::columns, test::Form::rows}) {
    test::write_fclib_global(folder / "g.hdf5", global, form);
    const auto r = solved<2>(folder / "g.hdf5");
    CHECK(r[0][0] == Approx(2 * m * g * std::cos(angle)));
    CHECK(r[1][0] == Approx(m * g * std::cos(angle)));
    // Both discs accelerate; the floor's shear S and theirs T follow from no slip at both contacts:
    // (g s + (S − T)/m) + (S + T)R²/I = 0 and (g s + T/m) − (g s + (S − T)/m) + (S + T)R²/I + T R²/I = 0
    const double a = 1 / m + radius * radius / inertia, b = -1 / m + radius * radius / inertia;
    const double c = 2 / m + 2 * radius * radius / inertia, push = g * std::sin(angle), det = a * c - b * b;
    CHECK(r[0][1] == Approx(-push * c / det));
    CHECK(r[1][1] == Approx(push * b / det));
  }
  // w is a velocity that the walls add
  global.w = {1, 0, 0, 0};
  global.f.assign(6, 0);
  test::write_fclib_global(folder / "g.hdf5", global, test::Form::rows);
  const auto r = solved<2>(folder / "g.hdf5");
  CHECK(r[0][0] == 0);
  // an M that no body has
  global.m[0][0] = -1;
  test::write_fclib_global(folder / "g.hdf5", global, test::Form::rows);
  REQUIRE_THROWS_WITH(read_problem(folder / "g.hdf5"),
                      Catch::Contains("/M: must be symmetric and positive definite"));
}

TEST_CASE("a text that ends early is told at every length") {
  const Folder folder;
  using test::Storage;
  for (const auto storage : {Storage::dense, Storage::blocks, Storage::columns, Storage::triplets}) {
    const auto text = test::siconos_text(chain<3>(2), storage);
    // up to the last number, which nothing tells from a shorter one
    const auto last = text.find_last_not_of(" \n");
    const auto begin = text.find_last_of(' ', last);
    for (std::size_t length = 0; length <= begin; ++length) {
      write(folder / "t.dat", text.substr(0, length));
      INFO(text.substr(0, length));
      REQUIRE_THROWS_AS(read_problem(folder / "t.dat"), InputError);
    }
  }
}

TEST_CASE("wrong texts get one line that names the place") {
  const Folder folder;
  const auto path = folder / "w.dat";
  const auto refuse = [&](const std::string& text, const std::string& what) {
    write(path, text);
    INFO(text);
    try {
      read_problem(path);
      FAIL("read");
    } catch (const InputError& error) {
      const std::string line = error.what();
      CAPTURE(line);
      CHECK(line.starts_with(path.string() + ":"));
      CHECK(line.find('\n') == line.npos);
      CHECK_THAT(line, Catch::Contains(what));
    }
  };
  const std::string good = "2\n1\n0\n2\n2\n2 2\n1 0\n0 1\n-1 0\n0.5\n";
  write(path, good);
  REQUIRE_NOTHROW(read_problem(path));
  refuse("", "the file ends where the dimension should be");
  refuse("what is this", ":1: the dimension must be a whole number");
  refuse("4\n1\n0\n", ":1: the dimension");
  refuse("1\n1\n0\n", ":1: the dimension must be 2 or 3");
  refuse("2\n0\n0\n0\n0\n", ":2: the number of contacts must be at least 1");
  refuse("2\n-1\n0\n2\n2\n", ":2: the number of contacts");
  refuse("2\n1\n3\n2\n2\n", ":3: the storage");
  refuse("2\n1\n0\n3\n2\n", ":4: the number of W's rows must be 2, not 3");
  refuse("2\n1\n0\n2\n2\n2 2\n1 0\n0 nan\n-1 0\n0.5\n", ":8: an element of W must be a finite number");
  refuse("2\n1\n0\n2\n2\n2 2\n1 0\n0 1\n-1 inf\n0.5\n", ":9: q must be a finite number");
  refuse("2\n1\n0\n2\n2\n2 2\n1 0\n0 1\n-1 1e999\n0.5\n", ":9: q must be a finite number");
  refuse("2\n1\n0\n2\n2\n2 2\n1 0\n0 1\n-1 0\n-0.5\n", "contact 0: the coefficient of friction");
  refuse("2\n1\n0\n2\n2\n2 2\n1 0\n0 0\n-1 0\n0.5\n",
         "contact 0: its own block of W must be positive definite");
  refuse("2\n1\n0\n2\n2\n2 2\n0 1\n1 0\n-1 0\n0.5\n",
         "contact 0: its own block of W must be positive definite");
  refuse(good + "1 2", "the file should end here");
  refuse(good + "0.5", "what follows the coefficients of friction");
  // sizes that no memory holds
  refuse("3\n99999999999999999999\n0\n", ":2: the number of contacts");
  refuse("3\n90000000\n0\n270000000\n270000000\n", ":2: the number of contacts");
  const std::string padding(4000, '\n');
  refuse("3\n1000\n0\n3000\n3000\n3000 3000\n" + padding, "the file is too short for its matrix");
  refuse("2\n1\n1\n2\n2\n1000000000\n1\n1\n2\n2\n2\n",
         "the number of blocks must be a whole number from 0 to");
  refuse("2\n1\n2\n2\n2\nCSparse\n2-by-2, nzmax: 9 nnz: 1000000000, 1-norm: 1\n",
         "nnz must be a whole number from 0 to");
  refuse("2\n1\n2\n2\n2\nCSparse\n3-by-3, nzmax: 9 nnz: 1, 1-norm: 1\n", "\"2-by-2,\" must stand here");
  refuse("2\n1\n2\n2\n2\nCSparse\ntriplet: 2-by-2, nzmax: 1 nnz: 1\n 2 0 : 1\n",
         "a row of W must be a whole number");
  refuse("2\n1\n1\n2\n2\n1\n1\n1\n2\n2\n2\n1\n1 1\n0\n", "the rows of blocks must start at 0");
}

TEST_CASE("HDF5 files that are wrong") {
  const Folder folder;
  const auto path = folder / "w.hdf5";
  const auto refuse = [&](const std::string& what) {
    try {
      read_problem(path);
      FAIL("read");
    } catch (const InputError& error) {
      const std::string line = error.what();
      CAPTURE(line);
      CHECK(line.starts_with(path.string() + ":"));
      CHECK(line.find('\n') == line.npos);
      CHECK_THAT(line, Catch::Contains(what));
    }
  };
  auto problem = chain<3>(3);
  const auto rewrite = [&] { test::write_fclib_local(path, problem, test::Form::columns); };
  rewrite();
  const auto good = slurp(path);
  for (std::size_t length = 8; length < good.size(); length += 97) {
    write(path, good.substr(0, length));
    refuse("");
  }
  problem.q[1][2] = std::nan("");
  rewrite();
  refuse("/fclib_local/vectors/q: has a number that is not finite");
  problem = chain<3>(3);
  problem.friction.pop_back();
  rewrite();
  refuse("2 contacts in 3 dimensions need 6 columns, not 9");
  problem = chain<3>(3);
  problem.q.emplace_back();
  problem.row_starts.push_back(problem.row_starts.back());
  problem.friction.push_back(0);
  rewrite();  // W with an empty row and column: the last contact has no block of its own
  refuse("contact 3: its own block of W must be positive definite");
  test::write_fclib_global(
      path, {.dimensions = 3, .m = {{1}}, .h = {{1, 0, 0}}, .f = {1, 2}, .w = {0, 0, 0}, .mu = {1}},
      test::Form::rows);
  refuse("/fclib_global/vectors/f: must have 1 numbers, not 2");
}

TEST_CASE("bytes changed at random never do more than an error") {
  const Folder folder;
  std::mt19937 dice(6);
  const auto path = folder / "f.hdf5";
  test::write_fclib_local(path, chain<3>(3), test::Form::columns);
  const auto good = slurp(path);
  const auto text = test::siconos_text(chain<2>(3), test::Storage::blocks);
  int refused = 0;
  for (int k = 0; k < 600; ++k) {
    auto bad = k % 2 ? good : text;
    for (int n = 1 + k % 5; n > 0; --n) bad[dice() % bad.size()] = static_cast<char>(dice());
    write(path, bad);
    try {
      read_problem(path);
    } catch (const InputError&) {
      ++refused;
    }
  }
  REQUIRE(refused > 50);
}

}  // namespace
