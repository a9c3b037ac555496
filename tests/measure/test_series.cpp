#include <catch2/catch.hpp>

#include "measure/series.hpp"

namespace series_tests {
using namespace chute;

namespace {

/// An engine that stands still with given grains.
class Still final : public Engine {
 public:
  GrainsView view;
  std::vector<Contact> touching;
  EnergyAccount account;
  std::int64_t step() const override { return 30; }
  double time_step() const override { return 0.1; }
  GrainsView grains() const override { return view; }
  EnergyAccount energy() const override { return account; }
  std::vector<Contact> contacts() const override { return touching; }
  void save(std::ostream&) const override {}
  void restore(std::istream&) override {}

 private:
  void advance(std::int64_t) override {}
};

}  // namespace

TEST_CASE("a row of the series is a mean over the moving grains") {
  const std::vector<double> x{1, 2, 50}, y{1, 1, 0}, vx{2, 6, 0}, vy{-1, 2, 0}, spin{-3, -5, 0},
      radius{1, 1, 1};
  const std::vector<int> wraps{0, 2};
  Still engine;
  engine.view.moving = 2;  // the third is the bed
  engine.view.position = {x, y, std::span<const double>{}};
  engine.view.velocity = {vx, vy, std::span<const double>{}};
  engine.view.spin[0] = spin;
  engine.view.radius = radius;
  engine.view.wraps = {wraps, wraps, std::span<const int>{}};
  engine.view.period[0] = 10;
  engine.touching.resize(4);
  engine.account.translation = 7;
  const auto row = measure::observe_series(engine, {.dimensions = 2});
  CHECK(row.time == Approx(3));
  CHECK(row.x == (1 + 22) / 2.0);
  CHECK(row.v[0] == 4);
  CHECK(row.v[1] == 0.5);
  CHECK(row.omega == 4);  // positive when rolling downhill
  CHECK(row.contacts == 4);
  CHECK(row.energy.translation == 7);
}

TEST_CASE("in 3D z is up and spins about y roll downhill") {
  const std::vector<double> x{1, 2}, vx{2, 6}, vy{9, 9}, vz{-1, 2}, w0{8, 8}, w1{3, 5}, radius{1, 1};
  const std::vector<int> wraps{0, 0};
  Still engine;
  engine.view.dimensions = 3;
  engine.view.moving = 2;
  engine.view.position = {x, x, x};
  engine.view.velocity = {vx, vy, vz};
  engine.view.spin = {w0, w1, w0};
  engine.view.radius = radius;
  engine.view.wraps = {wraps, wraps, wraps};
  const auto row = measure::observe_series(engine, {.dimensions = 3});
  CHECK(row.v == std::array{4.0, 9.0, 0.5});
  CHECK(row.omega == 4);
}

}  // namespace series_tests
