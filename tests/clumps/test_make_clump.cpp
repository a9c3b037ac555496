#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "clumps/make_clump.hpp"

using namespace chute;
using namespace chute::clumps;

TEST_CASE("one sphere is a round grain, to the last bit, whatever its size and place") {
  const auto flat = make_clump<2>(std::vector<Sphere>{{{{0.3, -2, 0}}, 0.7}});
  const auto solid = make_clump<3>(std::vector<Sphere>{{{{0.3, -2, 5}}, 0.7}});
  CHECK(flat.members.front().radius == 1);
  CHECK(solid.members.front().radius == 1);
  CHECK(norm(solid.members.front().at) == 0);
  CHECK(flat.gyration[0] == 0.4);
  CHECK(solid.gyration[2] == 0.4);
  CHECK(solid.spins_like_a_sphere());
  CHECK(solid.lightest == 1);
  CHECK(flat.reach == 1);
}

TEST_CASE("a sphere that hides another one weighs and turns as it does alone") {
  const auto clump = make_clump<3>(std::vector<Sphere>{{{{1, 0, 0}}, 0.7}, {{{1.1, 0, 0}}, 0.5}});
  CHECK(clump.members[0].radius == Approx(1).epsilon(1e-12));
  for (int k = 0; k < 3; ++k) CHECK(clump.gyration[k] == Approx(0.4).epsilon(1e-12));
}

TEST_CASE("two spheres that just touch: volume 1 + 1, and Steiner's theorem") {
  const std::vector<Sphere> pair{{{{0, 0, 0}}, 0.5}, {{{1, 0, 0}}, 0.5}};
  const auto solid = make_clump<3>(pair);
  const double R = std::cbrt(0.5);  // of each, where both together have the volume of a sphere of radius 1
  CHECK(solid.members[1].radius == Approx(R).epsilon(1e-12));
  CHECK(solid.members[1].at[0] == Approx(R).epsilon(1e-12));
  CHECK(solid.gyration[0] == Approx(0.4 * R * R).epsilon(1e-12));
  CHECK(solid.gyration[1] == Approx(1.4 * R * R).epsilon(1e-12));
  CHECK(solid.gyration[2] == solid.gyration[1]);
  CHECK(solid.reach == Approx(2 * R).epsilon(1e-12));
  CHECK(solid.lightest == Approx(1 / (1 + 1 / 1.4)).epsilon(1e-12));
  const auto flat = make_clump<2>(pair);
  CHECK(flat.gyration[0] == Approx(1.4 * R * R).epsilon(1e-12));
  CHECK(flat.radius == Approx(std::sqrt(2.0) * R).epsilon(1e-12));
  CHECK(flat.lightest == Approx(solid.lightest).epsilon(1e-12));
}

TEST_CASE("members lie along the principal axes about the centre of mass, and the written form comes back") {
  const std::vector<Sphere> spheres{
      {{{0, 0, 0}}, 0.5}, {{{0.6, 0.2, 0}}, 0.4}, {{{0.1, 0.5, 0.3}}, 0.35}, {{{-0.2, 0.2, 0.7}}, 0.3}};
  const auto clump = make_clump<3>(spheres);
  CHECK(!clump.spins_like_a_sphere());
  std::vector<Sphere> again;
  for (const auto& member : clump.members) again.push_back({member.at, member.radius});
  const auto solid = union_of(again);
  CHECK(solid.volume == Approx(4 * std::numbers::pi / 3).epsilon(1e-12));
  const auto inertia = solid.inertia();
  for (int i = 0; i < 3; ++i) {
    CHECK(solid.first[i] == Approx(0).margin(1e-12));
    for (int j = 0; j < 3; ++j)
      CHECK(inertia[static_cast<std::size_t>(i)][j] / solid.volume ==
            Approx(i == j ? clump.gyration[i] : 0).epsilon(1e-11).margin(1e-12));
  }
  const double scale = clump.members[0].radius / 0.5;
  const auto conjugate = [](Vec<4> q) { return Vec<4>{{q[0], -q[1], -q[2], -q[3]}}; };
  for (std::size_t m = 1; m < spheres.size(); ++m) {
    const Vec<3> apart = clump.members[m].at - clump.members[0].at;
    const auto q = quaternion_product(quaternion_product(clump.written, {{0, apart[0], apart[1], apart[2]}}),
                                      conjugate(clump.written));
    for (int k = 0; k < 3; ++k)
      CHECK(q[k + 1] ==
            Approx(scale * (spheres[m].centre[k] - spheres[0].centre[k])).epsilon(1e-11).margin(1e-12));
  }
}

TEST_CASE("a long rod of many spheres comes as exactly as two, and soon") {
  // Spheres a tenth of their radius apart: nearly a cylinder with round ends, π R² L + ball.
  std::vector<Sphere> spheres;
  for (int k = 0; k < 40; ++k) spheres.push_back({{{0.1 * k, 0, 0}}, 1});
  const double length = 3.9, volume = std::numbers::pi * length + 4 * std::numbers::pi / 3;
  // each step's scallop takes π d³/12 of it
  const double scallops = 39 * std::numbers::pi * std::pow(0.1, 3) / 12;
  CHECK(union_of(spheres).volume == Approx(volume - scallops).epsilon(1e-12));
  for (auto& s : spheres) s.centre = {{0, 0, s.centre[0]}};
  CHECK(union_of(spheres).volume == Approx(volume - scallops).epsilon(1e-12));
}
