// Species of grains: how many there are of each, how large and how heavy they are.
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "common/error.hpp"
#include "example.hpp"
#include "scene/world.hpp"

using namespace chute;
using chute::test::example;

namespace materials_tests {

namespace {

scene::Scene parse(const std::vector<std::string>& settings) {
  return scene::parse_scene(example, "scene.toml", settings);
}

/// Mean and standard deviation of many draws.
struct Moments {
  double mean = 0, std = 0, least = 1e9, most = 0;
};
constexpr int draws = 40000;
Moments moments_of(const scene::Diameter& diameter) {
  Moments m;
  double square = 0;
  for (int i = 0; i < draws; ++i) {
    Random random(7, Purpose::sizes, static_cast<std::uint64_t>(i));
    const double d = diameter.draw(random);
    m.mean += d / draws, square += d * d / draws;
    m.least = std::min(m.least, d), m.most = std::max(m.most, d);
  }
  m.std = std::sqrt(square - m.mean * m.mean);
  return m;
}
/// Four standard errors of a mean.
double four(double std) { return 4 * std / std::sqrt(draws); }

scene::Diameter diameter_of(const std::string& text) {
  return *parse({"grains.diameter=" + text, "grains.start.spacing=4"}).grains.diameter;
}

}  // namespace

TEST_CASE("diameters have the moments of their distributions") {
  const auto even = diameter_of("{kind=\"uniform\", from=0.6, to=1.8}");
  const auto m = moments_of(even);
  CHECK(m.mean == Approx(1.2).margin(four(m.std)));
  CHECK(even.average() == Approx(1.2));
  CHECK(m.std == Approx(1.2 / std::sqrt(12)).epsilon(0.02));
  CHECK((m.least >= 0.6 && m.most < 1.8));

  // ln d is gaussian with s² = ln(1 + std²/mean²); cut off at three s the mean is E[d; |z| < 3]/P(|z| < 3).
  const double s = std::sqrt(std::log(1 + 0.3 * 0.3)), mu = -s * s / 2;
  double p = 0, first = 0, second = 0;
  for (double z = -3 + 5e-4; z < 3; z += 1e-3) {
    const double w = std::exp(-z * z / 2), d = std::exp(mu + s * z);
    p += w, first += w * d, second += w * d * d;
  }
  const auto skewed = diameter_of("{kind=\"lognormal\", mean=1.0, std=0.3}");
  const auto l = moments_of(skewed);
  CHECK(skewed.average() == Approx(first / p).epsilon(1e-6));
  CHECK(l.mean == Approx(first / p).margin(four(l.std)));
  CHECK(l.std == Approx(std::sqrt(second / p - first * first / (p * p))).epsilon(0.02));
  CHECK(l.most <= std::exp(mu + 3 * s) * (1 + 1e-12));

  const auto three = diameter_of("{kind=\"table\", sizes=[0.5, 1.0, 2.0], weights=[3, 0, 1]}");
  const auto t = moments_of(three);
  CHECK(three.average() == Approx((3 * 0.5 + 2.0) / 4));
  CHECK(t.mean == Approx(0.875).margin(four(t.std)));
  CHECK(t.std == Approx(1.5 * std::sqrt(3.0) / 4).epsilon(0.02));
}

TEST_CASE("a table of diameters may be a file, and the resolved scene holds what it says") {
  const auto file = std::filesystem::temp_directory_path() / "chute-test-sieve.csv";
  std::ofstream(file) << "# sieved\nweight,diameter\n2,0.8\n1,1.4\n";
  const auto scene =
      parse({"grains.diameter={kind=\"table\", file=\"" + file.string() + "\"}", "grains.start.spacing=2"});
  std::filesystem::remove(file);
  CHECK(scene.grains.diameter->sizes == std::vector<double>{0.8, 1.4});
  CHECK(scene.grains.diameter->average() == Approx(1.0));
  const auto again = scene::parse_scene(to_toml(scene), "resolved.toml");
  CHECK(to_toml(again) == to_toml(scene));
}

TEST_CASE("there are as many grains of each material as its share says, of its size and density, anywhere") {
  const auto scene = parse(
      {"material=[{name=\"small\", share=0.25, density=2, diameter={mean=0.5}}, {name=\"large\", share=0.75, density=1}, "
       "{name=\"wood\", density=0.5}]",
       "bed.material=wood", "grains.diameter.std=0"});
  const auto world = scene::make_world<2>(scene);
  const auto& g = world.grains;
  double mass = 0, small_mass = 0, early = 0;
  std::array<int, 3> count{};
  for (std::size_t i = 0; i < g.moving; ++i) {
    ++count[static_cast<std::size_t>(g.material[i])];
    mass += g.mass[i];
    if (g.material[i] == 0) small_mass += g.mass[i], early += i < g.moving / 2;
    CHECK(g.radius[i] == (g.material[i] == 0 ? 0.25 : 0.5));
  }
  CHECK(count == std::array{75, 225, 0});
  const double unit = std::numbers::pi / 6;
  CHECK(mass == Approx(unit * (75 * 2 * 0.125 + 225)));
  CHECK(small_mass / mass == Approx(75 * 0.25 / (75 * 0.25 + 225)));  // the mass share
  CHECK(std::abs(early - 37.5) < 15);                                 // mixed
  for (std::size_t i = g.moving; i < g.size(); ++i) {
    CHECK(g.material[i] == 2);
    CHECK(g.mass[i] == Approx(unit * 0.5));
  }
  const auto setting = setting_of(scene);
  CHECK(setting.mean_diameter == Approx(0.25 * 0.5 + 0.75));
  CHECK(setting.mean_mass == Approx(unit * (0.25 * 2 * 0.125 + 0.75)));
}

TEST_CASE("a scene with materials and laws by pair reads back the same") {
  const auto scene = parse(
      {"material=[{name=\"a\", share=0.5, diameter={kind=\"lognormal\", mean=1.0, std=0.1}}, {name=\"b\", share=0.5}, {name=\"c\"}]",
       "bed.material=c", "wall=[{point=[0, 50], normal=[0, -1], material=\"b\"}]", "grains.start.spacing=2",
       "contact.between=[{materials=[\"a\",\"b\"], restitution=0.9, normal={stiffness=1e5}, tangential={friction=0.1}}]"});
  const auto text = to_toml(scene);
  INFO(text);
  CHECK(to_toml(scene::parse_scene(text, "resolved.toml")) == text);
}

}  // namespace materials_tests
