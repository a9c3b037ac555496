// What bottom-to-top restructuring must come to: rests that are exact, and published packing fractions.
#include <catch2/catch.hpp>
#include <sstream>

#include "core/estimate.hpp"
#include "deposit.hpp"
#include "search/pairs.hpp"

using namespace chute;
using namespace chute::test;
using restructuring::Rain;

namespace {

/// Deepest overlap of any two grains, looked for through a search of its own.
template <int D>
double deepest_overlap(const World<D>& surroundings, const Grains<D>& grains) {
  search::PairNames pairs;
  search::CellGrid<D>().find(grains, surroundings.domain, 1e-6, pairs);
  double deepest = 0;
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const auto i = static_cast<std::size_t>(pairs.i[p]), j = static_cast<std::size_t>(pairs.j[p]);
    const auto way = surroundings.domain.way(grains.place(i), grains.place(j));
    deepest = std::max(deepest, grains.radius[i] + grains.radius[j] - norm(way));
  }
  return deepest;
}

/// Is the origin between these lateral ways: in 2D on both sides, in 3D inside the triangle?
template <int D>
bool between(const std::vector<Vec<D>>& ways) {
  constexpr double slack = 1e-9;
  if constexpr (D == 2) {
    return ways[0][0] * ways[1][0] <= slack;
  } else {
    const auto side = [](const Vec<3>& a, const Vec<3>& b) { return a[0] * b[1] - a[1] * b[0]; };
    const double ab = side(ways[0], ways[1]), bc = side(ways[1], ways[2]), ca = side(ways[2], ways[0]);
    return (ab >= -slack && bc >= -slack && ca >= -slack) || (ab <= slack && bc <= slack && ca <= slack);
  }
}

template <int D>
void check_rests(const Deposit& deposit) {
  const auto world = box<D>(deposit.width);
  auto engine = rained<D>(deposit);
  engine.advance_to(2);
  const auto& grains = engine.state();
  CHECK(deepest_overlap<D>(world, grains) < 1e-9);
  std::size_t unstable = 0, wrong = 0;
  for (std::size_t i = 0; i < grains.moving; ++i) {
    bool on_floor = false;
    std::vector<Vec<D>> ways;
    for (const auto support : engine.supports(i)) {
      if (is_wall(support)) {
        on_floor = true;
        CHECK(grains.position[D - 1][i] == grains.radius[i]);
        continue;
      }
      const auto j = static_cast<std::size_t>(support);
      ways.push_back(world.domain.way(grains.place(i), grains.place(j)));
      REQUIRE(std::abs(norm(ways.back()) - grains.radius[i] - grains.radius[j]) < 1e-9);
    }
    if (on_floor) continue;
    if (ways.size() != static_cast<std::size_t>(D))
      ++wrong;
    else if (!between<D>(ways))
      ++unstable;
  }
  CHECK(wrong == 0);
  CHECK(unstable == 0);
}

}  // namespace

TEST_CASE("every grain above the floor rests on D others that lie on all sides of it, without overlap") {
  check_rests<2>({.grains = 2000, .width = 30, .spread = 0});
  check_rests<2>({.grains = 2000, .width = 30, .spread = 0.3});
  check_rests<3>({.grains = 2000, .width = 10, .spread = 0});
  check_rests<3>({.grains = 2000, .width = 10, .spread = 0.3, .jolt = 0.2});
}

TEST_CASE("coordination is 2D up to the floor's share, and the packing fractions are the published ones") {
  std::vector<double> plane, space;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    auto discs = rained<2>({.grains = 6000, .width = 60, .seed = seed});
    discs.advance_to(1);
    plane.push_back(told(discs, "packing_fraction"));
    CHECK(told(discs, "coordination") == Approx(4).margin(4 * 60.0 / 6000));
    auto spheres = rained<3>({.grains = 8000, .width = 15, .seed = seed});
    spheres.advance_to(1);
    space.push_back(told(spheres, "packing_fraction"));
    CHECK(told(spheres, "coordination") == Approx(6).margin(6 * 225.0 / 8000));
  }
  const auto in_plane = estimate_of(plane), in_space = estimate_of(space);
  CAPTURE(in_plane.mean, *in_plane.error, in_space.mean, *in_space.error);
  CHECK(in_plane.mean == Approx(0.82).margin(0.01));
  CHECK(in_space.mean == Approx(0.582).margin(0.004));  // Visscher & Bolsterli 0.582, Jullien & Meakin 0.581
}

TEST_CASE("without jolts shakes end in a packing that a further shake leaves where it is") {
  auto engine = rained<2>({.grains = 400, .width = 20, .spread = 0.2});
  engine.advance_to(100);
  const auto before = engine.state().position;
  engine.advance_to(101);
  double farthest = 0;
  for (std::size_t k = 0; k < 2; ++k)
    for (std::size_t i = 0; i < engine.state().moving; ++i)
      farthest = std::max(farthest, std::abs(engine.state().position[k][i] - before[k][i]));
  CHECK(farthest < 1e-7);
}

TEST_CASE("on a row of touching discs the perfect triangular lattice grows") {
  constexpr int columns = 12, rows = 8;
  auto world = box<2>(columns);
  world.walls.clear();
  for (int i = 0; i < columns * rows; ++i) add_sphere<2>(world.grains, {}, 0.5, true);
  for (int i = 0; i < columns; ++i) add_sphere<2>(world.grains, {{i + 0.5, 0}}, 0.5, false);
  auto engine = engine_of(world, {.grains = columns * rows, .seed = 3});
  engine.advance_to(1);
  std::map<long, int> rows_found;
  for (std::size_t i = 0; i < engine.state().moving; ++i) {
    const auto place = engine.state().place(i);
    const double row = place[1] / std::sqrt(0.75);
    REQUIRE(row == Approx(std::round(row)).margin(1e-9));
    const double along = place[0] - (std::lround(row) % 2 == 0 ? 0.5 : 0);
    REQUIRE(along == Approx(std::round(along)).margin(1e-9));
    ++rows_found[std::lround(row)];
  }
  CHECK(rows_found[1] == columns);
  CHECK(deepest_overlap<2>(world, engine.state()) < 1e-9);
}

// Jullien, Meakin & Pavlovitch 1992 find a threshold at a ratio of diameters of about 2.8.
TEST_CASE("in space a large sphere rises for a size ratio of 4, and does not for 2.5") {
  const auto climb = [](double ratio) {
    auto engine = rained<3>({.grains = 1500, .width = 9, .intruder = ratio, .seed = 5});
    engine.advance_to(20);
    const double early = told(engine, "tracer");
    engine.advance_to(80);
    return told(engine, "tracer") - early;
  };
  CHECK(climb(4) > 0.5);
  CHECK(std::abs(climb(2.5)) < 0.1);
}

TEST_CASE("a run that is saved and goes on comes to the same bytes") {
  const Deposit deposit{.grains = 300, .width = 8, .spread = 0.2, .jolt = 0.1};
  auto whole = rained<3>(deposit), first = rained<3>(deposit), second = rained<3>(deposit);
  whole.advance_to(4);
  first.advance_to(2);
  std::stringstream file;
  first.save(file);
  second.restore(file);
  second.advance_to(4);
  CHECK(second.state().position == whole.state().position);
  CHECK(second.contacts().size() == whole.contacts().size());
}

namespace {

/// Spheres laid, and then shaken as Mehta and Barker do: means over the shakes from the third on.
struct Shaken {
  double fraction, loosened, coordination;
};
Shaken shaken(restructuring::Stabilise how, double expand, std::int64_t sweeps) {
  auto world = box<3>(6);
  for (int i = 0; i < 700; ++i) add_sphere<3>(world.grains, {}, 0.5, true);
  restructuring::RestructuringSetup<3> setup{world.surroundings()};
  setup.rain = Rain::line, setup.stabilise = how;
  setup.loosening = restructuring::Loosening{expand, 1, sweeps, 0.1};
  restructuring::RestructuringEngine<3> engine(world.grains, setup);
  engine.advance_to(2);
  Shaken mean{};
  constexpr int shakes = 4;
  for (int k = 0; k < shakes; ++k) {
    engine.advance_to(3 + k);
    mean.fraction += told(engine, "packing_fraction") / shakes;
    mean.loosened += told(engine, "loosened_fraction") / shakes;
    mean.coordination += told(engine, "coordination") / shakes;
  }
  CHECK(deepest_overlap<3>(world, engine.state()) < 1e-8);
  return mean;
}

}  // namespace

// Mehta & Barker 1991: the packing fraction falls with the expansion, because grains that are laid among others which have not
// settled yet can form arches. Laid one by one on those that lie already they cannot.
TEST_CASE("shaken packings are looser the farther they are expanded, if grains settle together") {
  using restructuring::Stabilise;
  const auto a_little = shaken(Stabilise::cooperative, 0.05, 1500),
             much = shaken(Stabilise::cooperative, 1, 1500);
  CHECK(much.fraction < a_little.fraction - 0.005);
  CHECK(much.loosened < a_little.loosened - 0.01);
  const auto one_by_one = shaken(Stabilise::sequential, 1, 1500);
  CHECK(one_by_one.fraction == Approx(0.585).margin(0.01));
  CHECK(one_by_one.fraction > much.fraction + 0.01);
  CHECK(one_by_one.coordination == Approx(6).margin(6 * 36.0 / 700));
  CHECK(much.coordination < one_by_one.coordination);  // arches: one carries for two
}

TEST_CASE("the moves between expansion and laying end at the density that is asked for") {
  const auto soon = shaken(restructuring::Stabilise::sequential, 0.2, 0);
  CHECK(soon.loosened == Approx(0.585 / 1.2).margin(0.01));
}
