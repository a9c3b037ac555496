#include <catch2/catch.hpp>

#include "core/random.hpp"
#include "engines/event/cells.hpp"

using namespace chute;
using namespace chute::event;

namespace {

/// Follows one grain's flight through the grid until `end`, and checks after each change of cell, and between
/// them, that it is where the grid thinks it is.
void follow(const Flight<2>& flight, const Domain<2>& domain, double end) {
  std::vector<Flight<2>> flights{flight};
  for (const double x : {0.0, 9.9})
    for (const double y : {0.0, 9.9}) {
      Flight<2> corner;
      corner.place = {{x, y}};
      flights.push_back(corner);
    }
  Cells<2> cells;
  cells.build(flights, domain, 0.99, 0);
  std::array<double, 2> width{10.0 / 10, 9.9 / 9};
  if (!domain.periodic(0)) width[0] = 9.9 / 9;
  std::array<int, 2> count{domain.periodic(0) ? 10 : 9, 9};
  double now = 0;
  std::array<int, 2> where{};  // cells counted on through the periods
  for (int k = 0; k < 2; ++k)
    where[static_cast<std::size_t>(k)] =
        static_cast<int>(std::floor(flight.place[k] / width[static_cast<std::size_t>(k)]));
  int changes = 0;
  for (; changes < 2000; ++changes) {
    const auto next = cells.crossing(0, flights[0], now);
    const double until = std::min(next.time, end);
    REQUIRE(next.time >= now);
    for (const double t : {now + 0.01 * (until - now), now + 0.5 * (until - now), now + 0.99 * (until - now)})
      for (int k = 0; k < 2; ++k) {
        const auto axis = static_cast<std::size_t>(k);
        const double x = flight.place_at(t)[k];
        const bool open = !domain.periodic(k);
        const double low = where[axis] * width[axis], high = low + width[axis];
        if (!(open && where[axis] == 0)) CHECK(x >= low - 1e-9);
        if (!(open && where[axis] == count[axis] - 1)) CHECK(x <= high + 1e-9);
      }
    if (next.time >= end) break;
    now = next.time;
    cells.cross(0, next);
    where[static_cast<std::size_t>(next.axis)] += next.step;
  }
  CHECK(changes < 2000);
}

}  // namespace

TEST_CASE("a flight's changes of cell are those of its parabola") {
  Random random(1, Purpose::start);
  for (int n = 0; n < 2000; ++n) {
    Flight<2> flight;
    flight.place = {{random.uniform(0, 9.9), random.uniform(0, 9.9)}};
    flight.velocity = {{random.uniform(-5, 5), random.uniform(-5, 5)}};
    if (n % 3) flight.gravity = {{random.uniform(-1, 1), random.uniform(-1, 0)}};
    Domain<2> domain;
    if (n % 2) domain.length[0] = 10;
    follow(flight, domain, 10);
  }
}

TEST_CASE("a flight that turns right at a wall does not change cells without end") {
  // 9 cells of width 1.1 in y; apex exactly at a wall, as exactly as rounding lets it, and a hair off it
  for (int cell = 1; cell < 9; ++cell)
    for (const double off : {-1e-15, -1e-16, 0.0, 1e-16, 1e-15})
      for (const double up : {0.3, 1.4, 1e-8}) {
        Flight<2> flight;
        flight.gravity = {{0, -1}};
        flight.velocity = {{0, up}};
        flight.place = {{3, 9.9 / 9 * cell - up * up / 2 + off}};
        Domain<2> domain;
        domain.length[0] = 10;
        follow(flight, domain, 10);
      }
}
