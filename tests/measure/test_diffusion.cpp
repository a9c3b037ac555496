// What is told of single grains on a bed: how they spread, and when they have come to rest.
#include <catch2/catch.hpp>

#include "core/random.hpp"
#include "measure/diffusion.hpp"
#include "measure/standstill.hpp"

namespace diffusion_tests {
using namespace chute;
using namespace chute::measure;

// A walk of independent gaussian steps of variance 2 D dt about a drift has the mean squares 2 D t at every t.
TEST_CASE("diffusion of a random walk about a drift is that of its steps") {
  constexpr double dt = 0.01, drift = 0.08, D_x = 2e-5, D_y = 8e-5, duration = 200;
  constexpr int grains = 8;
  Diffusion diffusion(dt, 3, {0, duration, 10});
  for (std::size_t i = 0; i < grains; ++i) {
    Random random(1, Purpose::engine, i);
    std::array<double, 2> place{};
    for (int k = 0; k * dt <= duration; ++k) {
      diffusion.add(i, k * dt, place);
      place[0] += drift * dt + std::sqrt(2 * D_x * dt) * random.normal();
      place[1] += std::sqrt(2 * D_y * dt) * random.normal();
    }
  }
  const auto result = diffusion.result();
  CHECK(result.drift.mean == Approx(drift).margin(5 * std::sqrt(2 * D_x / (duration * grains))));
  for (const auto& [k, D] : {std::pair<std::size_t, double>{0, D_x}, {1, D_y}}) {
    REQUIRE(result.D[k].error);
    CHECK(result.D[k].mean == Approx(D).margin(4 * *result.D[k].error));
    CHECK(*result.D[k].error < 0.25 * D);
    CHECK(result.rows.front().square[k].mean == Approx(2 * D * dt).epsilon(0.05));
  }
}

// A velocity that is forgotten in τ: <x²>/2t = D (1 − (1 − exp(−t/τ)) τ/t), which comes to 3/4 of D at 3.9 τ.
TEST_CASE("a walk that goes straight for a while is diffusive from four of these times on") {
  constexpr double dt = 0.01, tau = 0.1, duration = 400, D = 1;
  constexpr int grains = 20;
  Diffusion diffusion(dt, 2, {0, duration, 10});
  for (std::size_t i = 0; i < grains; ++i) {
    Random random(1, Purpose::engine, i);
    std::array<double, 2> place{}, v{};
    const double kept = std::exp(-dt / tau), kick = std::sqrt(D / tau * (1 - kept * kept));
    for (double& speed : v) speed = std::sqrt(D / tau) * random.normal();
    for (int k = 0; k * dt <= duration; ++k) {
      diffusion.add(i, k * dt, place);
      for (std::size_t c = 0; c < 2; ++c) {
        const double before = v[c];
        v[c] = kept * v[c] + kick * random.normal();
        place[c] += (before + v[c]) / 2 * dt;
      }
    }
  }
  const auto result = diffusion.result();
  for (const std::size_t c : {0, 1}) {
    CHECK(result.D[c].mean == Approx(D).margin(4 * *result.D[c].error));
    CHECK(result.diffusive_from[c] > 3 * tau);
    CHECK(result.diffusive_from[c] < 5 * tau);
  }
}

TEST_CASE("a grain that stays at its bead has stopped, and what it did shortly before does not count") {
  constexpr double spacing = 1e-3, gravity = 9.81, dt = 0.02, speed = 0.05, stops = 4;
  Standstill rest(spacing, gravity);
  Pending<double> pending;
  double counted = 0, latest = 0;
  for (int k = 0; k * dt < 10; ++k) {
    const double t = k * dt;
    const std::vector<double> x{speed * std::min(t, stops), speed * t}, y(2);
    const std::vector<int> wraps(2);
    GrainsView view;
    view.dimensions = 3, view.time = t, view.moving = 2;
    view.position = {x, y, y};
    view.wraps = {wraps, wraps, wraps};
    rest.note(view);
    for (std::size_t i = 0; i < 2; ++i) pending.add(i, t, t);
    pending.release(t, rest, [&](std::size_t i, double time, double) {
      if (i == 0) ++counted, latest = time;
    });
  }
  CHECK(rest.stopped(0));
  CHECK_FALSE(rest.stopped(1));
  CHECK(rest.since(0) == Approx(stops).margin(spacing / speed + dt));
  CHECK(rest.way(0) == Approx(speed * stops).margin(2 * spacing));
  CHECK(latest < stops - 1.4);
  CHECK(counted > 100);
}

TEST_CASE("thinned samples are evenly taken from all that came") {
  Thinned<double> kept(100);
  for (int k = 0; k < 1000; ++k) kept.add(k);
  CHECK(kept.seen() == 1000);
  REQUIRE(kept.kept().size() > 50);
  REQUIRE(kept.kept().size() <= 100);
  const double step = kept.kept()[1] - kept.kept()[0];
  for (std::size_t k = 1; k < kept.kept().size(); ++k) CHECK(kept.kept()[k] - kept.kept()[k - 1] == step);
}

}  // namespace diffusion_tests
