// Walls and beds are hit where they are.
#include <catch2/catch.hpp>

#include "common/error.hpp"
#include "gas.hpp"

using namespace chute;
using namespace chute::test;
using dsmc::Dense;
using dsmc::DsmcEngine;

TEST_CASE("a grain bounces on a floor as exactly as parabolas do, whatever the step") {
  for (const double dt : {0.05, 0.7}) {
    dsmc::DsmcSetup<2> setup;
    setup.domain.length[0] = 20;
    setup.walls = {floor_wall<2>()};
    setup.gravity = {{0, -1}};
    setup.contact = {laws::ConstantRestitution{0.8}, laws::Walton{0, -1}};
    setup.time_step = dt;
    Grains<2> grains;
    grains.add({{1, 2.5}}, 0.5, 1, 0.1, true);
    grains.velocity[0][0] = 0.3;
    DsmcEngine<2> engine(grains, setup);
    const double T = 4.2;
    engine.advance_to(std::llround(T / dt));
    // From rest at height 2 above touching: it lands at t = 2 with speed 2, leaves with 1.6, lands again at 5.2.
    const double t = engine.time() - 2;
    CHECK(engine.state().position[1][0] == Approx(0.5 + 1.6 * t - 0.5 * t * t).epsilon(1e-12));
    CHECK(engine.state().position[0][0] == Approx(1 + 0.3 * engine.time()).epsilon(1e-12));
    CHECK(engine.energy().residual() == Approx(0).margin(1e-12));
  }
}

TEST_CASE("a grain hits a bead where the surfaces meet") {
  dsmc::DsmcSetup<2> setup;
  setup.domain.length[0] = 20;
  setup.contact = {laws::ConstantRestitution{1}, laws::Walton{0, -1}};
  setup.time_step = 0.9;
  Grains<2> grains;
  grains.add({{10.6, 5}}, 0.5, 1, 0.1, true);
  grains.velocity[1][0] = -1;
  grains.add({{10, 0}}, 0.5, 1, 0.1, false);
  DsmcEngine<2> engine(grains, setup);
  engine.collect_impacts(true);
  engine.advance_to(6);
  // At contact the way between the centres is 1 long and 0.6 across: it is 0.8 high; n = (0.6, 0.8), v = −1 e_y is mirrored.
  const double hit = 5 - 0.8, after = engine.time() - hit;
  CHECK(engine.state().position[0][0] == Approx(10.6 + after * 2 * 0.8 * 0.6).epsilon(1e-12));
  CHECK(engine.state().position[1][0] == Approx(0.8 + after * (2 * 0.8 * 0.8 - 1)).epsilon(1e-12));
  const auto impacts = engine.take_impacts();
  REQUIRE(impacts.size() == 1);
  CHECK(impacts[0].time == Approx(hit).epsilon(1e-12));
  CHECK(impacts[0].bead == 1);
  CHECK(impacts[0].v_n == Approx(-0.8));
}

// An elastic gas over a mirror: n ∝ exp(−m g z/T) at the temperature of its start.
TEST_CASE("an elastic gas over a floor is barometric, and as warm everywhere") {
  constexpr double T = 5;
  constexpr std::size_t count = 20000;
  dsmc::DsmcSetup<2> setup;
  setup.domain.length[0] = 20000;
  setup.walls = {floor_wall<2>()};
  setup.gravity = {{0, -1}};
  setup.contact = {laws::ConstantRestitution{1}, laws::Walton{0, -1}};
  setup.time_step = 0.1;
  setup.dense = Dense::none;
  setup.cell = 3;
  Grains<2> grains;
  for (std::size_t i = 0; i < count; ++i) {
    Random random(3, Purpose::start, i);
    grains.add({{20000 * random.uniform(), 0.5 - T * std::log1p(-random.uniform())}}, 0.5, 1, 0.1, true);
    grains.velocity[0].back() = std::sqrt(T) * random.normal(),
    grains.velocity[1].back() = std::sqrt(T) * random.normal();
  }
  DsmcEngine<2> engine(grains, setup);
  std::array<double, 6> number{}, square{};
  constexpr int looks = 20;
  for (int look = 1; look <= looks; ++look) {
    engine.advance_to(200 + 40 * look);
    const auto& g = engine.state();
    for (std::size_t i = 0; i < count; ++i) {
      const auto bin = static_cast<std::size_t>((g.position[1][i] - 0.5) / 3);
      if (bin >= number.size()) continue;
      number[bin] += 1,
          square[bin] += g.velocity[0][i] * g.velocity[0][i] + g.velocity[1][i] * g.velocity[1][i];
    }
  }
  for (std::size_t b = 0; b < number.size(); ++b) {
    const double expected = static_cast<double>(count * looks) * std::exp(-3.0 * static_cast<double>(b) / T) *
                            (1 - std::exp(-3 / T));
    CAPTURE(b);
    CHECK(number[b] == Approx(expected).epsilon(0.03));
    CHECK(square[b] / number[b] / 2 == Approx(T).epsilon(0.03));
  }
  CHECK(engine.energy().residual() == Approx(0).margin(1e-8 * engine.energy().start));
}

TEST_CASE("between walls of one temperature a gas takes it") {
  Gas<3> gas(4000, 0.03, 0.2);
  gas.setup.domain.length[2] = std::numeric_limits<double>::infinity();
  const double side = gas.setup.domain.length[0];
  auto low = floor_wall<3>(), high = floor_wall<3>();
  high.point[2] = side, high.normal[2] = -1;
  low.surface.temperature = high.surface.temperature = 2;
  gas.setup.walls = {low, high};
  gas.setup.time_step = 0.1;
  gas.setup.cell = 3;
  for (double& z : gas.grains.position[2]) z = std::clamp(z, 0.5, side - 0.5);
  DsmcEngine<3> engine(gas.grains, gas.setup);
  engine.advance_to(3000);
  double T = 0;
  for (int k = 1; k <= 40; ++k) engine.advance_to(3000 + 20 * k), T += told(engine, "temperature") / 40;
  CHECK(T == Approx(2).epsilon(0.03));
  for (const double z : engine.state().position[2]) {
    REQUIRE(z >= 0.5 - 1e-9);
    REQUIRE(z <= side - 0.5 + 1e-9);
  }
  CHECK(engine.energy().residual() == Approx(0).margin(1e-8 * engine.energy().wall_work));
}

TEST_CASE("grains that gather to a packing stop the run with a reason") {
  Gas<2> gas(2000, 0.2, 0.01);
  gas.setup.gravity = {{0, -1}};
  gas.setup.walls = {floor_wall<2>()};
  gas.setup.domain.length[1] = std::numeric_limits<double>::infinity();
  for (double& z : gas.grains.position[1]) z += 0.5;
  gas.setup.contact.restitution = laws::ConstantRestitution{0.3};
  gas.setup.time_step = 0.02;
  gas.setup.cell = 2;
  DsmcEngine<2> engine(gas.grains, gas.setup);
  CHECK_THROWS_WITH(engine.advance_to(20000),
                    Catch::Contains("packing fraction") && Catch::Contains("caged"));
}

// Grains that fly over a bed of beads meet each other in the gaps between them, too: the cells reach down to the beads.
TEST_CASE("cells reach down to the bed, and their volume is what centres can be in") {
  dsmc::DsmcSetup<2> setup;
  setup.domain.length[0] = 20;
  setup.contact = {laws::ConstantRestitution{1}, laws::Walton{0, -1}};
  setup.cell = 2;
  Grains<2> grains;
  grains.add({{5, 9}}, 0.5, 1, 0.1, true);
  for (int b = 0; b < 20; ++b) grains.add({{b + 0.5, 0}}, 0.5, 1, 0.1, false);
  DsmcEngine<2> engine(grains, setup);
  const auto& cells = engine.cells();
  CHECK(cells.cell_of({{5, 0.9}}) != dsmc::GasCells<2>::outside);
  CHECK(cells.cell_of({{5, -0.5}}) == dsmc::GasCells<2>::outside);
  CHECK(cells.volume(cells.cell_of({{5, 9}})) == Approx(4));
  // Over touching beads of one diameter, centres are above y = √(1 − s²), |s| ≤ ½ from the nearest bead: the mean of that is
  // (√3/4 + π/6)/1 = 0.9566, so of a cell from 0 to 2 over two beads 2 × (2 − 0.9566) is left.
  CHECK(cells.volume(cells.cell_of({{5, 1}})) == Approx(2 * (2 - 0.9566)).epsilon(0.05));
}

// So many cells overflowed their number, or took all memory.
TEST_CASE("cells that are far finer than grains are many are refused") {
  for (const double cell : {1e-30, 1e-3}) {
    Gas<2> gas(100, 0.1);
    gas.setup.cell = cell;
    CHECK_THROWS_WITH((DsmcEngine<2>(gas.grains, gas.setup)),
                      Catch::Contains("engine.cell") && Catch::Contains("cells"));
  }
}
