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

TEST_CASE("grains are matched by their ids; those that go go on, those that come are not there yet") {
  const auto a = frame_of(2, {1, 0, 0, 0}, 0);
  auto b = frame_of(6, {1, 0, 0, 0}, 1);  // the other order: id 0 is second, at 5
  const auto now = view::between(a, b, 0.5);
  CHECK(now.x[0] == Approx(3.5));  // from 2 to 5
  CHECK(now.x[1] == Approx(5.5));  // from 5 to 6
  CHECK(now.arrays[0].values == a.arrays[0].values);
  // id 0 goes, with its velocity of 1 along x; id 7 comes
  b.arrays[0].values = {1, 7};
  b.time = 3;
  const auto open = view::between(a, b, 0.5);
  CHECK(open.size() == 2);
  CHECK(open.x[0] == Approx(2 + 1 * 1.5));
  CHECK(open.x[1] == Approx(5.5));
  b.arrays[0].name = "weight";  // as many, and nothing that tells them apart
  CHECK(view::between(a, b, 0.5).x[0] == Approx(4));
  b.x.push_back(1), b.y.push_back(1), b.z.push_back(0), b.radius.push_back(1);
  CHECK(view::between(a, b, 0.5).x == a.x);
}

TEST_CASE("between frames the ends of contacts go with their grains, also through periodic ends") {
  const auto a = frame_of(9.8, {1, 0, 0, 0});
  auto b = frame_of(0.4, {1, 0, 0, 0});
  b.x[1] = 4.6;
  const auto now = view::between(a, b, 0.5);
  const Eigen::Vector3d first(9.8, 1, 0), second(5, 2, 0), wall(5, 0, 0);
  // grain 0 is also seen at -0.2: a contact through the end
  const auto links =
      view::between({a,
                     {{first, second, 1},
                      {second, Eigen::Vector3d(-0.2, 1, 0), 2},
                      {second, wall, 3},
                      {Eigen::Vector3d(5.01, 2, 0), wall, 4}}},  // in a grain, but not its centre
                    {b, {}}, now, 0.5);
  REQUIRE(links.size() == 4);
  CHECK(links[0].from.isApprox(Eigen::Vector3d(10.1, 1, 0)));
  CHECK(links[0].to.isApprox(Eigen::Vector3d(4.8, 2, 0)));
  CHECK(links[1].from.isApprox(Eigen::Vector3d(0.1, 1, 0)));
  CHECK(links[2].to == wall);
  CHECK(links[3].from == Eigen::Vector3d(5.01, 2, 0));
  for (std::size_t k = 0; k < 4; ++k)  // all of them are on their way out
    CHECK(links[k].force == Approx(0.5 * static_cast<double>(k + 1)));
}

TEST_CASE(
    "Forces of contacts that stay change evenly, those that come and go grow from nothing and fade to it") {
  auto a = frame_of(2, {1, 0, 0, 0}), b = frame_of(3, {1, 0, 0, 0});
  for (auto* frame : {&a, &b}) {
    frame->x.push_back(7), frame->y.push_back(3), frame->z.push_back(0), frame->radius.push_back(0.5);
    frame->arrays[0].values.push_back(2);
    frame->arrays.resize(1);
  }
  const std::vector<std::size_t> other_order{2, 0, 1};
  const auto c = b;
  for (std::size_t i = 0; i < 3; ++i) {
    b.x[i] = c.x[other_order[i]], b.y[i] = c.y[other_order[i]];
    b.arrays[0].values[i] = c.arrays[0].values[other_order[i]];
  }
  const auto at = [](const read::GrainFrame& frame, double id) {
    for (std::size_t i = 0; i < frame.size(); ++i)
      if (frame.arrays[0].values[i] == id) return frame.centre(i);
    return Eigen::Vector3d(0, 0, 0);
  };
  const double part = 0.25;
  const auto now = view::between(a, b, part);
  const view::Network earlier{a,
                              {{at(a, 0), at(a, 1), 8},                      // stays
                               {at(a, 1), at(a, 2), 4},                      // goes
                               {at(a, 0), Eigen::Vector3d(2, 0.5, 0), 1},    // on a wall below, stays
                               {at(a, 0), Eigen::Vector3d(1.5, 1, 0), 2}}};  // on one beside it, goes
  const view::Network later{b,
                            {{at(b, 2), at(b, 0), 16},  // comes
                             {at(b, 1), at(b, 0), 4},   // the first one, named the other way round
                             {at(b, 0), Eigen::Vector3d(3, 0.5, 0), 5}}};
  const auto links = view::between(earlier, later, now, part);
  REQUIRE(links.size() == 5);
  const auto force = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    for (const auto& link : links)
      if ((link.from.isApprox(from) && link.to.isApprox(to)) ||
          (link.from.isApprox(to) && link.to.isApprox(from)))
        return link.force;
    return -1.0;
  };
  CHECK(at(now, 0).isApprox(Eigen::Vector3d(2.25, 1, 0)));
  CHECK(force(at(now, 0), at(now, 1)) == Approx(0.75 * 8 + 0.25 * 4));
  CHECK(force(at(now, 1), at(now, 2)) == Approx(0.75 * 4));
  CHECK(force(at(now, 0), at(now, 2)) == Approx(0.25 * 16));
  CHECK(force(at(now, 0), {2.25, 0.5, 0}) == Approx(0.75 * 1 + 0.25 * 5));
  CHECK(force(at(now, 0), {1.5, 1, 0}) == Approx(0.75 * 2));
  // at the ends of the time it is the frames' own networks
  CHECK(view::between(earlier, later, view::between(a, b, 1), 1).size() == 5);
  double sum = 0;
  for (const auto& link : view::between(earlier, later, view::between(a, b, 1), 1)) sum += link.force;
  CHECK(sum == Approx(16 + 4 + 5));
}

TEST_CASE("A contact with a grain that is not there yet waits for it") {
  const auto a = frame_of(2, {1, 0, 0, 0});
  auto b = a;
  b.arrays[0].values = {0, 9};
  const auto now = view::between(a, b, 0.5);
  CHECK(view::between({a, {}}, {b, {{b.centre(0), b.centre(1), 1}}}, now, 0.5).empty());
}

}  // namespace between_tests
