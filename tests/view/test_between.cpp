#include <catch2/catch.hpp>
#include <cmath>

#include "grains.hpp"
#include "view/between.hpp"

using namespace chute;

namespace between_tests {

namespace {

read::GrainFrame frame_of(double x, std::vector<double> quaternion, double id_first = 0) {
  read::GrainFrame frame;
  frame.domain = {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(10, 0, 0)};
  frame.x = {x, 5}, frame.y = {1, 2}, frame.z = {0, 0}, frame.radius = {0.5, 0.5};
  frame.time = 0;
  quaternion.insert(quaternion.end(), {1, 0, 0, 0});
  frame.arrays = {{"id", 1, {id_first, 1 - id_first}},
                  {"orientation", 4, quaternion},
                  {"velocity", 3, {1, 0, 0, 0, 0, 0}}};
  return frame;
}

}  // namespace

TEST_CASE("between two frames grains go the short way through periodic ends and turn evenly") {
  const double half = std::sqrt(0.5);
  const auto a = frame_of(9.8, {1, 0, 0, 0}), b = [&] {
    auto later = frame_of(0.4, {half, 0, 0, half});  // a quarter turn about z
    later.time = 2, later.y[0] = 1.4;
    later.arrays[2].values[0] = 3;
    return later;
  }();
  const auto now = view::between(a, b, 0.5);
  CHECK(now.x[0] == Approx(0.1));  // 9.8 + 0.3, wrapped
  CHECK(now.x[1] == Approx(5));
  CHECK(now.y[0] == Approx(1.2));
  CHECK(*now.time == Approx(1));
  CHECK(now.arrays[2].values[0] == Approx(2));
  const double eighth = std::acos(-1) / 8;  // half of a quarter turn: the half angle of its quaternion
  CHECK(now.arrays[1].at(0, 0) == Approx(std::cos(eighth)));
  CHECK(now.arrays[1].at(0, 3) == Approx(std::sin(eighth)));
  CHECK(view::between(a, b, 0.25).x[0] == Approx(9.95));
}

TEST_CASE("grains are matched by their ids, and where some came or went the earlier frame is shown") {
  const auto a = frame_of(2, {1, 0, 0, 0}, 0);
  auto b = frame_of(6, {1, 0, 0, 0}, 1);  // the other order: id 0 is second, at 5
  const auto now = view::between(a, b, 0.5);
  CHECK(now.x[0] == Approx(3.5));  // from 2 to 5
  CHECK(now.x[1] == Approx(5.5));  // from 5 to 6
  CHECK(now.arrays[0].values == a.arrays[0].values);
  b.arrays[0].values = {7, 8};
  CHECK(view::between(a, b, 0.5).x == a.x);
}

TEST_CASE(
    "between frames the ends of contacts go with their grains, also through periodic ends, and those on walls stay") {
  const auto a = frame_of(9.8, {1, 0, 0, 0});
  auto b = frame_of(0.4, {1, 0, 0, 0});
  b.x[1] = 4.6;
  const auto now = view::between(a, b, 0.5);
  const Eigen::Vector3d first(9.8, 1, 0), second(5, 2, 0), wall(5, 0, 0);
  // grain 0 is also seen at -0.2: a contact through the end
  std::vector<read::ForceLink> links{
      {first, second, 1}, {second, Eigen::Vector3d(-0.2, 1, 0), 2}, {second, wall, 3}};
  view::move_ends(links, a, now);
  CHECK(links[0].from.isApprox(Eigen::Vector3d(10.1, 1, 0)));
  CHECK(links[0].to.isApprox(Eigen::Vector3d(4.8, 2, 0)));
  CHECK(links[1].to.isApprox(Eigen::Vector3d(0.1, 1, 0)));
  CHECK(links[2].to == wall);
  CHECK(links[2].force == 3);
  std::vector<read::ForceLink> elsewhere{
      {Eigen::Vector3d(5.01, 2, 0), wall, 1}};  // in a grain, but not its centre
  view::move_ends(elsewhere, a, now);
  CHECK(elsewhere[0].from == Eigen::Vector3d(5.01, 2, 0));
}

}  // namespace between_tests
