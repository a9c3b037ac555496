#include <catch2/catch.hpp>
#include <cmath>

#include "measure/fields.hpp"
#include "measure/profiles.hpp"

namespace profiles_tests {
using namespace chute;

namespace {

constexpr double pi = 3.14159265358979323846;

Frame line(double length) { return {.dimensions = 2, .footprint = length, .bead_spacing = 1}; }

/// Discs given one by one.
struct Discs {
  std::vector<double> x, y, vx, vy, spin, radius, mass;
  void add(double height, double R, double v_x = 0, double v_y = 0, double omega = 0) {
    x.push_back(0), y.push_back(height), vx.push_back(v_x), vy.push_back(v_y), spin.push_back(omega);
    radius.push_back(R), mass.push_back(1);
  }
  GrainsView at(double time) const {
    GrainsView view;
    view.time = time;
    view.moving = y.size();
    view.position = {x, y, std::span<const double>{}};
    view.velocity = {vx, vy, std::span<const double>{}};
    view.spin[0] = spin;
    view.radius = radius;
    view.mass = mass;
    return view;
  }
};

}  // namespace

TEST_CASE("a layer holds the grains whose centres lie in it") {
  Discs discs;
  discs.add(0.3, 0.5, 1, 0.5, -2);
  discs.add(0.9, 0.5, 3, -0.5, -4);
  discs.add(2.5, 0.25, 7, 0, 1);
  measure::Profiles profiles(line(10), 1, {0, 100});
  for (int t = 0; t <= 100; ++t) profiles.sample(discs.at(t), {}, {});
  const auto bins = profiles.result(0);
  REQUIRE(bins.size() == 3);
  CHECK(bins[0].h == 0.5);
  CHECK(bins[0].grains == Approx(2));
  CHECK(bins[0].eta.mean == Approx(2 * pi * 0.25 / 10));
  CHECK(bins[0].v[0].mean == Approx(2));
  CHECK(bins[0].v[1].mean == Approx(0).margin(1e-12));
  CHECK(bins[0].sigma[0].mean == Approx(1));
  CHECK(bins[0].sigma[1].mean == Approx(0.5));
  CHECK(bins[0].omega.mean == Approx(3));  // rolling downhill is positive
  CHECK(bins[1].grains == 0);
  CHECK(bins[2].grains == Approx(1));
  CHECK(bins[2].v[0].mean == Approx(7));
  CHECK(bins[2].sigma[0].mean == Approx(0).margin(1e-7));
  for (const auto& bin : {bins[0], bins[2]}) {
    REQUIRE(bin.eta.error);
    CHECK(*bin.eta.error == Approx(0).margin(1e-12));  // nothing changed in time
  }
}

TEST_CASE("exact area fractions cut discs at the layers' edges and lose nothing") {
  Discs discs;
  discs.add(3, 0.8);     // half below 3, half above
  discs.add(5.5, 0.25);  // inside a layer
  discs.add(7.2, 1.7);   // over four layers
  measure::Profiles profiles(line(2), 1, {0, 10});
  profiles.sample(discs.at(5), {}, {});
  const auto bins = profiles.result(0);
  CHECK(bins[2].eta_exact.mean * 2 == Approx(pi * 0.64 / 2));
  CHECK(bins[3].eta_exact.mean * 2 == Approx(pi * 0.64 / 2));
  CHECK(bins[4].eta_exact.mean == 0);
  double area = 0;
  for (const auto& bin : bins) area += bin.eta_exact.mean * 2;
  CHECK(area == Approx(pi * (0.64 + 0.0625 + 1.7 * 1.7)));
  // a segment of the big disc by Simpson's rule: the part between heights 6 and 7
  double segment = 0;
  const int n = 2000;
  for (int i = 0; i <= n; ++i) {
    const double y = 6 + 1.0 * i / n - 7.2;
    segment += (i == 0 || i == n ? 1 : i % 2 ? 4 : 2) * 2 * std::sqrt(1.7 * 1.7 - y * y) / (3.0 * n);
  }
  CHECK(bins[6].eta_exact.mean * 2 == Approx(segment));
}

TEST_CASE("a disc partly below the bed's centres counts only above them") {
  Discs discs;
  discs.add(0.2, 0.5);
  discs.add(-3, 0.5);  // wholly below
  measure::Profiles profiles(line(1), 1, {0, 10});
  profiles.sample(discs.at(1), {}, {});
  const auto bins = profiles.result(0);
  REQUIRE(bins.size() == 1);
  const double below =
      0.25 * std::acos(0.4) - 0.2 * std::sqrt(0.25 - 0.04);  // circular segment under height 0
  CHECK(bins[0].eta_exact.mean == Approx(pi * 0.25 - below));
  CHECK(bins[0].grains == 1);
}

TEST_CASE("errors are standard errors over ten blocks of time") {
  measure::Profiles profiles(line(1), 1, {0, 10});
  double mean = 0, squares = 0;
  for (int block = 0; block < 10; ++block) {
    const double v = block * block;  // one value per block; within a block samples are the same
    mean += v / 10;
    squares += v * v / 10;
    Discs discs;
    discs.add(0.5, 0.1, v);
    for (double t : {0.1, 0.5, 0.9}) profiles.sample(discs.at(block + t), {}, {});
  }
  const auto bins = profiles.result(0);
  CHECK(bins[0].v[0].mean == Approx(mean));
  REQUIRE(bins[0].v[0].error);
  CHECK(*bins[0].v[0].error == Approx(std::sqrt((squares - mean * mean) / 9)));
}

TEST_CASE("a single block has no error, and no sample no profile") {
  measure::Profiles profiles(line(1), 1, {0, 10});
  CHECK(profiles.result(0).empty());
  Discs discs;
  discs.add(0.5, 0.1, 1);
  profiles.sample(discs.at(3), {}, {});
  REQUIRE(profiles.result(0).size() == 1);
  CHECK_FALSE(profiles.result(0)[0].v[0].error);
}

TEST_CASE("an empty layer has no mean velocity") {
  Discs discs;
  discs.add(0.5, 0.1, 1);
  discs.add(2.5, 0.1, 1);
  measure::Profiles profiles(line(1), 1, {0, 10});
  for (double t : {1.0, 8.0}) profiles.sample(discs.at(t), {}, {});
  const auto bins = profiles.result(0);
  CHECK(bins[1].eta.mean == 0);  // known to be 0
  CHECK(std::isnan(bins[1].v[0].mean));
  CHECK_FALSE(bins[1].v[0].error);
}

TEST_CASE("an average from the very end of a run is that one sample") {
  Discs discs;
  discs.add(0.5, 0.1, 4);
  measure::Profiles profiles(line(1), 1, {10, 10});
  profiles.sample(discs.at(10), {}, {});
  REQUIRE(profiles.result(0).size() == 1);
  CHECK(profiles.result(0)[0].v[0].mean == 4);
}

TEST_CASE("one grain thrown far up takes no memory, and is told of") {
  Discs discs;
  discs.add(0.5, 0.1, 1);
  discs.add(1e12, 0.1, 1);
  measure::Profiles profiles(line(1), 1e-3, {0, 10});
  profiles.sample(discs.at(5), {}, {});
  CHECK(profiles.result(0).size() <= measure::most_layers);
  CHECK(profiles.beyond() == 1);
  measure::Fields fields(line(1), 1e-3, {0, 10});
  fields.sample(discs.at(5), {}, {});
  CHECK(fields.result(0).size() <= measure::most_layers);
  CHECK(fields.beyond() == 1);
}

TEST_CASE("in space layers hold volumes: a sphere over two layers, and its three components") {
  const std::vector<double> x{1}, z{1}, v_x{2}, v_y{-3}, v_z{0.5}, spin{7}, radius{0.4}, mass{1};
  GrainsView view;
  view.dimensions = 3;
  view.time = 5, view.moving = 1;
  view.position = {x, x, z}, view.velocity = {v_x, v_y, v_z}, view.spin = {x, spin, x};
  view.radius = radius, view.mass = mass;
  measure::Profiles profiles({.dimensions = 3, .footprint = 6, .bead_spacing = 1}, 1, {0, 10});
  profiles.sample(view, {}, {});
  const auto bins = profiles.result(0);
  REQUIRE(bins.size() == 2);
  const double volume = 4.0 / 3 * pi * 0.064;
  CHECK(bins[0].eta_exact.mean * 6 == Approx(volume / 2));
  CHECK(bins[1].eta_exact.mean * 6 == Approx(volume / 2));
  CHECK(bins[1].eta.mean * 6 == Approx(volume));
  CHECK(bins[1].v[1].mean == -3);
  CHECK(bins[1].v[2].mean == 0.5);
  CHECK(bins[1].omega.mean == 7);
}

}  // namespace profiles_tests
