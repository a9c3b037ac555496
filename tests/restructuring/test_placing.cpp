// One grain laid on a few others whose answer is known.
#include <catch2/catch.hpp>

#include "deposit.hpp"
#include "engines/restructuring/placing.hpp"

using namespace chute;
using namespace chute::restructuring;

namespace {

template <int D>
std::optional<Rest<D>> laid_on(const std::vector<Vec<D>>& places, const Vec<D>& lateral, double floor) {
  Grains<D> grains;
  for (const auto& place : places) test::add_sphere<D>(grains, place, 0.5, true);
  Columns<D> columns(grains, {});
  for (std::size_t i = 0; i < places.size(); ++i) columns.lay({places[i], 0.5, static_cast<std::int32_t>(i)});
  Random random(1, Purpose::engine);
  return Placer<D>(columns, Bounds{floor}).place(lateral, 0.5, random);
}
constexpr double none = -std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("a disc on two discs lies between them") {
  const auto rest = laid_on<2>({{{0, 0}}, {{1.2, 0}}}, {{0.1, 99}}, none);
  REQUIRE(rest);
  CHECK(rest->place[0] == Approx(0.6));
  CHECK(rest->place[1] == Approx(0.8));
  CHECK(rest->count == 2);
}

TEST_CASE("a disc that finds nobody beside it falls off the equator onto the floor") {
  const auto rest = laid_on<2>({{{0, 3}}}, {{0.1, 99}}, 0);
  REQUIRE(rest);
  CHECK(rest->on_floor);
  CHECK(rest->place[0] == Approx(1));
  CHECK(rest->place[1] == 0.5);
  CHECK(!laid_on<2>({{{0, 3}}}, {{0.1, 99}}, none));
}

TEST_CASE("exactly on top a disc goes to one side, and both sides occur") {
  int right = 0;
  Grains<2> grains;
  test::add_sphere<2>(grains, {}, 0.5, true);
  Columns<2> columns(grains, {});
  columns.lay({{}, 0.5, 0});
  for (std::uint64_t k = 0; k < 100; ++k) {
    Random random(1, Purpose::engine, k);
    const auto rest = Placer<2>(columns, Bounds{-0.5}).place({}, 0.5, random);
    REQUIRE(rest);
    CHECK(std::abs(rest->place[0]) == Approx(1));
    right += rest->place[0] > 0;
  }
  CHECK(right > 25);
  CHECK(right < 75);
}

TEST_CASE("a sphere on three spheres completes the tetrahedron, wherever it fell") {
  const double high = std::sqrt(0.75);
  for (const Vec<3> from :
       {Vec<3>{{0.1, 0.05, 9}}, Vec<3>{{0.9, 0.1, 9}}, Vec<3>{{0.5, 0.3, 9}}, Vec<3>{{0.55, high, 9}}}) {
    const auto rest = laid_on<3>({{{0, 0, 0}}, {{1, 0, 0}}, {{0.5, high, 0}}}, from, none);
    if (from[1] == high && !rest) continue;  // fell to the outside
    REQUIRE(rest);
    CHECK(rest->place[0] == Approx(0.5));
    CHECK(rest->place[1] == Approx(high / 3));
    CHECK(rest->place[2] == Approx(std::sqrt(2.0 / 3)));
    CHECK(rest->count == 3);
  }
}

TEST_CASE("a sphere on two rolls in their valley until it falls off the end") {
  const auto rest = laid_on<3>({{{0, 0, 2}}, {{0.8, 0, 2}}}, {{0.3, 0.1, 9}}, 0);
  REQUIRE(rest);
  CHECK(rest->on_floor);
  CHECK(rest->place[0] ==
        Approx(0.4));  // steepest descent leads into the valley, and along it to the level of both
  CHECK(rest->place[1] == Approx(std::sqrt(1 - 0.16)));
}
