#include <catch2/catch.hpp>

#include "core/random.hpp"
#include "measure/fields.hpp"
#include "measure/profiles.hpp"
#include "pile.hpp"

namespace stress_tests {
using namespace chute;
using namespace chute::test;

namespace {
constexpr double length = 10;

/// Integral over the height of one quantity of the fields. Simpson would do better; the points are w/4 apart
/// and the kernel's derivative vanishes at its ends, so that the plain sum is right to a few 1e-4.
template <class Quantity>
double integral(const std::vector<measure::FieldPoint>& fields, const Quantity& quantity) {
  double sum = 0;
  for (const auto& point : fields)
    if (std::isfinite(quantity(point))) sum += quantity(point);
  return sum * (fields[1].h - fields[0].h) * length;
}
}  // namespace

TEST_CASE("in a static column the stress is the weight above, in layers of any height") {
  const Pile pile = column();
  for (const double bin : {0.05, 0.3, 1.0}) {
    measure::Profiles profiles(Pile::frame(), bin, {0, 1});
    profiles.sample(pile.at(0), pile.contacts, pile.contacts);
    for (const auto& layer : profiles.result(0)) {
      double expected = 0;  // the mean over the layer
      const int n = 4000;
      for (int k = 0; k < n; ++k) expected += weight_above(pile, layer.h + bin * ((k + 0.5) / n - 0.5)) / n;
      INFO("bin " << bin << ", h " << layer.h);
      CHECK(layer.contact[3].mean * length == Approx(expected).epsilon(2e-3).margin(2e-3));
      CHECK(layer.contact[0].mean == Approx(0).margin(1e-12));
      CHECK(layer.contact[1].mean == Approx(0).margin(1e-12));
      CHECK(layer.kinetic[3].mean == 0);
    }
  }
}

TEST_CASE("the field of a static column is the weight above, seen through the kernel") {
  const Pile pile = column();
  const double width = 0.4;
  measure::Fields fields(Pile::frame(), width, {0, 1});
  fields.sample(pile.at(0), {}, pile.contacts);
  for (const auto& point : fields.result(0)) {
    double expected = 0;  // ∫ φ(h − z) · (weight above z) dz
    const int n = 4000;
    for (int k = 0; k < n; ++k) {
      const double r = 2 * ((k + 0.5) / n) - 1, phi = 15.0 / 16 * (1 - r * r) * (1 - r * r);
      const double z = point.h - r * width;
      if (z > 0)
        expected += phi * weight_above(pile, z) * 2 / n;  // nothing is carried below the bed's centre
    }
    INFO("h " << point.h);
    CHECK(point.contact[3].mean * length == Approx(expected).epsilon(2e-3).margin(2e-3));
  }
}

TEST_CASE("fields integrate to mass, momentum and kinetic energy") {
  Random random(5, Purpose::start);
  Pile pile;
  double mass = 0, momentum = 0, energy = 0;
  for (int i = 0; i < 200; ++i) {
    const double m = random.uniform(0.5, 1.5), vx = random.normal(), vy = random.normal();
    pile.add(random.uniform(0, length), random.uniform(0, 10), m, vx, vy);
    mass += m, momentum += m * vx, energy += m * (vx * vx + vy * vy);
  }
  for (const double width : {0.5, 1.0, 2.5}) {
    measure::Fields fields(Pile::frame(), width, {0, 1});
    fields.sample(pile.at(0), {}, {});
    const auto result = fields.result(0);
    CHECK(integral(result, [](const auto& p) { return p.density.mean; }) == Approx(mass).epsilon(2e-3));
    CHECK(integral(result, [](const auto& p) { return p.density.mean * p.v[0].mean; }) ==
          Approx(momentum).epsilon(2e-3).margin(0.05));
    // the trace of the kinetic stress is what the mean flow does not carry
    CHECK(integral(result, [](const auto& p) {
            return p.kinetic[0].mean + p.kinetic[3].mean +
                   p.density.mean * (p.v[0].mean * p.v[0].mean + p.v[1].mean * p.v[1].mean);
          }) == Approx(energy).epsilon(2e-3));
  }
}

// A wide kernel and a low bin see the same column of momentum: both integrate to Σ f l.
TEST_CASE(
    "the contact stress of a slanting pair integrates to force times way, with friction and across the "
    "border") {
  Pile pile;
  const double angle = 0.5, R = 0.5;
  const auto a = pile.add(9.8, 1, 1), b = pile.add(9.8 + std::sin(angle) - length, 1 + std::cos(angle), 1);
  const double normal = 3, shear = -0.7;
  pile.touch(a, b, normal, shear);
  // n = (sin, cos) from a to b, s = (n_y, −n_x)
  const double fx = normal * std::sin(angle) + shear * std::cos(angle);
  const double fy = normal * std::cos(angle) - shear * std::sin(angle);
  const double lx = 2 * R * std::sin(angle), ly = 2 * R * std::cos(angle);
  measure::Fields fields(Pile::frame(), 0.5, {0, 1});
  measure::Profiles profiles(Pile::frame(), 0.1, {0, 1});
  fields.sample(pile.at(0), {}, pile.contacts);
  profiles.sample(pile.at(0), pile.contacts, pile.contacts);
  double xx = 0, xy = 0, yy = 0;
  for (const auto& bin : profiles.result(0)) {
    xx += bin.contact[0].mean * 0.1 * length;
    xy += bin.contact[1].mean * 0.1 * length;
    yy += bin.contact[3].mean * 0.1 * length;
  }
  const auto points = fields.result(0);
  CHECK(xx == Approx(fx * lx));
  CHECK(xy == Approx(fx * ly));
  CHECK(yy == Approx(fy * ly));
  CHECK(integral(points, [](const auto& p) { return p.contact[0].mean; }) == Approx(fx * lx).epsilon(2e-3));
  CHECK(integral(points, [](const auto& p) { return p.contact[1].mean; }) == Approx(fx * ly).epsilon(2e-3));
  CHECK(integral(points, [](const auto& p) { return p.contact[3].mean; }) == Approx(fy * ly).epsilon(2e-3));
}

TEST_CASE("level contacts and coordination") {
  Pile pile;
  const auto a = pile.add(1, 1.5, 1), b = pile.add(2, 1.5, 1), c = pile.add(1, 2.5, 1);
  const auto bed = pile.add_fixed(1, 0.5);
  pile.touch(a, b, 4);
  pile.touch(a, c, 1);
  pile.touch(a, bed, 2);
  measure::Profiles profiles(Pile::frame(), 1, {0, 1});
  profiles.sample(pile.at(0), pile.contacts, pile.contacts);
  const auto bins = profiles.result(0);
  REQUIRE(bins.size() == 3 + 1);          // c reaches up to 3
  CHECK(bins[1].coordination.mean == 2);  // a has three contacts, b one
  CHECK(bins[2].coordination.mean == 1);
  CHECK(bins[1].contact[0].mean * length == Approx(4));
  measure::Fields fields(Pile::frame(), 1, {0, 1});
  fields.sample(pile.at(0), {}, std::span(pile.contacts).first(1));
  CHECK(integral(fields.result(0), [](const auto& p) { return p.contact[0].mean; }) ==
        Approx(4).epsilon(2e-3));
}

// The balance of momentum over a smooth, steady field needs no bins: ∂σ_yy/∂h = −ρ g for the column above.
TEST_CASE("the stress falls with height by the density, point by point") {
  const Pile pile = column();
  const double width = 0.8;
  measure::Fields fields(Pile::frame(), width, {0, 1});
  fields.sample(pile.at(0), {}, pile.contacts);
  const auto points = fields.result(0);
  const double dh = points[1].h - points[0].h;
  for (std::size_t p = 1; p + 1 < points.size(); ++p) {
    if (points[p].h < width + dh) continue;  // nearer the bed carries, too
    const double slope = (points[p + 1].contact[3].mean - points[p - 1].contact[3].mean) / (2 * dh);
    const double smoothed =
        (points[p - 1].density.mean + 4 * points[p].density.mean + points[p + 1].density.mean) / 6;
    CHECK(slope == Approx(-smoothed).margin(0.01));
  }
}

}  // namespace stress_tests
