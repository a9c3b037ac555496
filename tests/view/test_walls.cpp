#include <catch2/catch.hpp>
#include <numbers>

#include "view/walls.hpp"

using namespace chute;
using Eigen::Vector3d;

namespace walls_tests {

namespace {

/// A pipe along y of that many staves, as files have it: faces that share corners.
std::vector<read::WallPiece> pipe(int number, int staves, double radius, double length) {
  const auto rim = [&](int k, double y) {
    const double angle = 2 * std::numbers::pi * (k % staves) / staves;
    return Vector3d(radius * std::cos(angle), y, radius * std::sin(angle));
  };
  std::vector<read::WallPiece> faces;
  for (int k = 0; k < staves; ++k)
    faces.push_back({number, {rim(k, 0), rim(k + 1, 0), rim(k + 1, length), rim(k, length)}});
  return faces;
}

view::Survey grains_in(const Vector3d& low, const Vector3d& high) {
  view::Survey survey;
  survey.dimensions = 3;
  survey.bounds = {low, high};
  return survey;
}

}  // namespace

TEST_CASE("A pipe shows its rims and not its staves, a box of walls all its edges") {
  const auto rims = view::edges_of(pipe(0, 24, 2, 5));
  CHECK(rims.size() == 48);
  for (const auto& [a, b] : rims) CHECK(a.y() == b.y());  // none along the pipe
  // Two walls that meet are two things: the edge between them is drawn, once for each.
  const read::WallPiece floor{0, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
  const read::WallPiece side{1, {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}}};
  CHECK(view::edges_of(std::vector{floor, side}).size() == 8);
  const read::WallPiece line{2, {{0, 0, 0}, {1, 0, 0}}};
  CHECK(view::edges_of(std::vector{line}).size() == 1);
}

TEST_CASE("A round wall belongs to what is seen, unless the grains would be lost in it") {
  const auto drum = pipe(0, 24, 2, 5);
  CHECK(view::has_round_wall(drum));
  auto filled = grains_in({-1.5, 0, -2}, {1.5, 5, 0});
  view::include_walls(filled, drum);
  CHECK(filled.bounds.min().isApprox(Vector3d(-2, 0, -2)));
  CHECK(filled.bounds.max().isApprox(Vector3d(2, 5, 2)));
  const Vector3d low(-0.3, 0, -2), high(0.3, 5, -1.8);
  auto empty = grains_in(low, high);
  view::include_walls(empty, drum);
  CHECK(empty.bounds.min() == low);
  CHECK(empty.bounds.max() == high);
}

TEST_CASE("Of a silo all walls are seen, but those that would make the grains small") {
  const std::vector<read::WallPiece> walls{
      {0, {{-1, 0, 0}, {-1, 0, 3}}}, {1, {{1, 0, 0}, {1, 0, 3}}}, {2, {{-1, 0, -3}, {1, 0, -3}}}};
  CHECK_FALSE(view::has_round_wall(walls));
  auto half_full = grains_in({-1, -1, 0}, {1, 1, 1.6});
  view::include_walls(half_full, walls);
  CHECK(half_full.bounds.min() == Vector3d(-1, -1, 0));  // not the floor far below
  CHECK(half_full.bounds.max() == Vector3d(1, 1, 3));
  auto nearly_empty = grains_in({-1, -1, 0}, {1, 1, 0.5});
  view::include_walls(nearly_empty, walls);
  CHECK(nearly_empty.bounds.max() == Vector3d(1, 1, 0.5));
}

TEST_CASE("Four walls around the grains are the outline of a picture, two are not") {
  std::vector<read::WallPiece> walls;
  for (const int side : {0, 1})
    walls.push_back({side, {{2.0 * side, 0, 0}, {2.0 * side, 2, 0}, {2.0 * side, 2, 5}, {2.0 * side, 0, 5}}});
  const auto box = [](const Vector3d& low, const Vector3d& high) { return Eigen::AlignedBox3d(low, high); };
  const auto seen = box({0, 0, 0}, {2, 2, 5.2});
  CHECK_FALSE(view::stand_around(walls, seen));
  for (const int side : {0, 1})
    walls.push_back(
        {2 + side, {{0, 2.0 * side, 0}, {2, 2.0 * side, 0}, {2, 2.0 * side, 5}, {0, 2.0 * side, 5}}});
  CHECK(view::stand_around(walls, seen));
  CHECK_FALSE(view::stand_around(walls, box({0, 0, 0}, {2, 2, 9})));
  CHECK_FALSE(view::stand_around(pipe(0, 24, 2, 5), box({-2, 0, -2}, {2, 5, 2})));
}

TEST_CASE("In the plane a drum is seen as the picture is turned") {
  std::vector<read::WallPiece> drum;
  for (const auto& stave : pipe(0, 24, 2, 0))
    drum.push_back(
        {0,
         {{stave.corners[0].x(), stave.corners[0].z(), 0}, {stave.corners[1].x(), stave.corners[1].z(), 0}}});
  view::Survey survey;
  survey.bounds = {Vector3d(-1, -2, 0), Vector3d(1, 0, 0)};
  survey.turn = 0.3;
  survey.turned = {Eigen::Vector2d(-1, -2), Eigen::Vector2d(1, 0)};
  view::include_walls(survey, drum);
  CHECK(survey.turned.sizes().x() == Approx(4).epsilon(0.02));
  CHECK(survey.turned.sizes().y() == Approx(4).epsilon(0.02));
}

}  // namespace walls_tests
