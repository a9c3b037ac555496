// Rough planes of glued beads, and the division of a plane that they are measured with.
#include <fmt/format.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "beds/planes.hpp"

using namespace chute;
using namespace chute::beds;

namespace {

std::unique_ptr<Bed> bed_of(std::string_view word) {
  for (const auto& kind : list())
    if (kind.word == word) return kind.make();
  throw std::logic_error("no such bed");
}
/// A tenth of the thesis's plane, for tests.
std::unique_ptr<Bed> small_plane(std::string_view word) {
  auto bed = bed_of(word);
  auto& plane = dynamic_cast<Plane&>(*bed);
  plane.count = 408, plane.size = {{35.575, 13.756}};
  return bed;
}
constexpr std::array recipes{"plane", "plane-random", "plane-spread", "plane-lattice"};

}  // namespace

TEST_CASE("cells of a square lattice are squares, and its vertices lie between four places") {
  Sheet sheet{6, 4, {}};
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 4; ++j) sheet.place.push_back({i + 0.25, j + 0.25});
  const auto t = tessellate(sheet);
  for (const double area : t.cell_area) CHECK(area == Approx(1).epsilon(1e-6));
  for (const auto& v : t.vertices) CHECK(v.distance == Approx(std::sqrt(0.5)).epsilon(1e-6));
}

TEST_CASE(
    "cells fill the plane, and a plane has twice as many vertices and three times as many edges as places") {
  const auto bed = small_plane("plane-lattice");
  const auto sheet = dynamic_cast<const Plane&>(*bed).sheet({3, 1});
  const auto t = tessellate(sheet);
  double area = 0;
  for (const double a : t.cell_area) area += a;
  CHECK(area == Approx(sheet.length * sheet.width).epsilon(1e-6));
  CHECK(t.vertices.size() == 2 * sheet.place.size());  // Euler, on a torus
  CHECK(t.edges.size() == 3 * sheet.place.size());
  // and every vertex is as far from its beads as from no nearer one
  for (std::size_t k = 0; k < t.vertices.size(); k += 50) {
    double nearest = 1e9;
    for (const auto& p : sheet.place) {
      const auto way = sheet.way(p, t.vertices[k].place);
      nearest = std::min(nearest, std::hypot(way[0], way[1]));
    }
    CHECK(t.vertices[k].distance == Approx(nearest).epsilon(1e-5));
  }
}

TEST_CASE(
    "every recipe lays the beads that were asked for, without holes that hold another, with little overlap") {
  for (const auto* recipe : recipes) {
    const auto bed = small_plane(recipe);
    const auto sheet = dynamic_cast<const Plane&>(*bed).sheet({3, 1});
    const auto shape = shape_of(sheet, 0.5);
    CAPTURE(recipe, shape.widest_hole, shape.overlapping, shape.deep_holes, shape.hexatic);
    CHECK(shape.beads == 408);
    CHECK(shape.coverage == Approx(408 * std::numbers::pi / 4 / (35.575 * 13.756)));
    CHECK(shape.overlapping < 1e-3);
    if (std::string_view(recipe) == "plane-lattice") continue;
    CHECK(shape.widest_hole <= 2);
    CHECK(shape.hexatic < 0.35);  // of rolled-in rows on so narrow a plane; the lattice with noise has 0.7
    if (std::string_view(recipe) == "plane") CHECK(shape.widest_hole < 1.7701);  // as its key `hole` says
    if (std::string_view(recipe) == "plane-random") CHECK(shape.deep_holes < 0.03);
    for (const auto& p : sheet.place)
      CHECK((p[0] >= 0 && p[0] < sheet.length && p[1] >= 0 && p[1] < sheet.width));
  }
}

TEST_CASE("a plane is the same for the same seed, and another for another") {
  for (const auto* recipe : recipes) {
    const auto bed = small_plane(recipe), again = small_plane(recipe);
    // A different plane in between: what is remembered must not be taken for another.
    const auto first = dynamic_cast<const Plane&>(*bed).sheet({3, 1}).place;
    const auto other = dynamic_cast<const Plane&>(*again).sheet({3, 2}).place;
    CHECK(dynamic_cast<const Plane&>(*again).sheet({3, 1}).place == first);
    CHECK(other != first);
  }
}

TEST_CASE("planes that cannot be are refused") {
  auto bed = small_plane("plane");
  CHECK(bed->misfit({2, 1})->key == "bed.kind");
  CHECK_FALSE(bed->misfit({3, 1}));
  dynamic_cast<Plane&>(*bed).count = 600;
  CHECK(bed->misfit({3, 1})->key == "bed.count");
}

TEST_CASE("beads of a plane lie where a file says, in its own unit of length, whatever their size") {
  const auto file = std::filesystem::temp_directory_path() / fmt::format("chute-plane-{}.csv", ::getpid());
  const auto written = [&](const std::string& rows) {
    std::ofstream(file) << "x,y\n" << rows;
    PlaneFromFile bed;
    bed.diameter = 0.4, bed.file = file.string(), bed.size = std::vector<double>{4, 3};
    return bed;
  };
  // Four on a square lattice with a gap, and one that is given beyond the period.
  const auto bed = written("0.5,0.75\n2.5,0.75\n0.5,2.25\n6.5,2.25\n");
  CHECK_FALSE(bed.misfit({3, 1}));
  const auto ground = bed.lay({3, 1});
  REQUIRE(ground.beads.size() == 4);
  CHECK(ground.beads[3].along == Approx(2.5));
  CHECK(ground.beads[3].across == Approx(2.25));
  CHECK(ground.beads[0].radius == Approx(0.2));
  CHECK((*ground.length == 4 && *ground.width == 3));
  CHECK(ground.widest_spacing == Approx(2 * std::hypot(1, 0.75)));
  CHECK(written("0.5,0.75\n2.5,0.75\n").misfit({3, 2})->message.find("has 2 beads") != std::string::npos);
  CHECK(bed.misfit({2, 1})->key == "bed.kind");
  std::filesystem::remove(file);
  CHECK(bed.misfit({3, 1})->message.find("no such file") != std::string::npos);
}
