// Grains that rest on each other: what they weigh, when they fall, and that nothing moves that should not.
#include <catch2/catch.hpp>
#include <numbers>
#include <sstream>

#include "few_grains.hpp"

using namespace chute;
using namespace chute::test;
using contact::SolverKind;

TEST_CASE("in a stack of N each carries those above it") {
  const auto run = []<int D>(std::integral_constant<int, D>) {
    constexpr int N = 10;
    Grains<D> grains;
    for (int k = 0; k < N; ++k) {
      Vec<D> place{};
      place[D - 1] = 0.5 + k;
      add_ball<D>(grains, place);
    }
    auto setup = setup_of<D>(0.3);
    Vec<D> g{};
    g[D - 1] = -1;
    pull<D>(setup, g);
    setup.walls = {floor_at<D>()};
    ContactEngine<D> engine(grains, setup);
    engine.advance_to(100);
    auto contacts = by_partners(engine);
    REQUIRE(contacts.size() == N);
    CHECK(contacts[{0, wall_id(0)}].normal_force == Approx(N).epsilon(1e-8));
    for (int k = 0; k + 1 < N; ++k)
      CHECK(contacts[{k, k + 1}].normal_force == Approx(N - 1 - k).epsilon(1e-8));
    CHECK(engine.record().unconverged == 0);
  };
  run(std::integral_constant<int, 2>{});
  run(std::integral_constant<int, 3>{});
}

TEST_CASE("two smooth supports at 45 degrees bear mg/√2 each") {
  Grains<2> grains;
  const double s = std::sqrt(0.5);
  add_ball<2>(grains, {{0, 2 * s * 0.5}});
  auto setup = setup_of<2>(0);
  pull<2>(setup, {{0, -1}});
  setup.walls = {{{{0, 0}}, {{s, s}}}, {{{0, 0}}, {{-s, s}}}};
  ContactEngine<2> engine(grains, setup);
  engine.advance_to(10);
  const auto contacts = engine.contacts();
  REQUIRE(contacts.size() == 2);
  for (const auto& c : contacts) CHECK(c.normal_force == Approx(s).epsilon(1e-8));
}

namespace {

constexpr double R = 0.5, kappa = 0.5;

/// Two discs on a floor and one on both, whose contacts with them lean by a from the vertical.
ContactEngine<2> pile_of_three(double a, double mu_s, double mu_d, double floor_friction, double h = 0.01) {
  Grains<2> grains;
  add_ball<2>(grains, {{-2 * R * std::sin(a), R}}, {}, true, R, kappa);
  add_ball<2>(grains, {{2 * R * std::sin(a), R}}, {}, true, R, kappa);
  add_ball<2>(grains, {{0, R + 2 * R * std::cos(a)}}, {}, true, R, kappa);
  auto setup = setup_of<2>(mu_d, h);
  setup.static_friction = mu_s;
  pull<2>(setup, {{0, -1}});
  setup.walls = {floor_at<2>()};
  setup.walls[0].surface.friction = floor_friction;
  return ContactEngine<2>(std::move(grains), setup);
}

}  // namespace

TEST_CASE("a pile of three discs stands if μ_s ≥ tan(a/2) between them and a third of it on the floor") {
  for (const double degrees : {31.0, 40.0, 50.0}) {
    const double a = degrees * std::numbers::pi / 180, needed = std::tan(a / 2);
    CAPTURE(degrees);
    auto stands = pile_of_three(a, 1.02 * needed, 0.5 * needed, 1.02 * needed / 3);
    stands.advance_to(300);
    auto contacts = by_partners(stands);
    for (const std::int64_t base : {0, 1}) {
      CHECK(contacts[{base, 2}].normal_force == Approx(0.5).epsilon(1e-8));
      CHECK(std::abs(contacts[{base, 2}].shear_force) == Approx(0.5 * needed).epsilon(1e-8));
      CHECK(contacts[{base, 2}].state == ContactState::stick);
      CHECK(contacts[{base, wall_id(0)}].normal_force == Approx(1.5).epsilon(1e-8));
      CHECK(std::abs(contacts[{base, wall_id(0)}].shear_force) == Approx(0.5 * needed).epsilon(1e-8));
    }
    CHECK(stands.state().position[1][2] == Approx(R + 2 * R * std::cos(a)).margin(1e-9));
    for (const auto& [between, floor] : {std::pair(0.98, 1.02), std::pair(1.02, 0.98)}) {
      auto falls = pile_of_three(a, between * needed, between * needed, floor * needed / 3);
      falls.advance_to(300);
      CAPTURE(between, floor);
      CHECK(falls.state().position[1][2] < R + 2 * R * std::cos(a) - 0.01);
    }
  }
}

TEST_CASE("a pile of three discs falls as its five equations say") {
  // Unknown: F_n and F_s = μ_d F_n above, the floor's T, the base's acceleration X outward (it rolls), the top's A down.
  //   A = 1 − 2 (F_n cos a + F_s sin a)        the top
  //   X = F_n sin a − F_s cos a − T            the base, outward
  //   T = F_s + κ X                            its spin, with X = −R dω/dt
  //   A = X tan a                              they stay in touch
  for (const double degrees : {35.0, 50.0}) {
    const double a = degrees * std::numbers::pi / 180, mu = 0.5 * std::tan(a / 2);
    const double k = (std::sin(a) - mu * (1 + std::cos(a))) / (1 + kappa);
    const double F_n = 1 / (k * std::tan(a) + 2 * (std::cos(a) + mu * std::sin(a))), X = F_n * k;
    const double T = mu * F_n + kappa * X;
    constexpr double h = 1e-3;
    for (const double mu_s : {mu, 0.9 * std::tan(a / 2)}) {  // also where it breaks from μ_s
      auto engine = pile_of_three(a, mu_s, mu, 1, h);
      engine.advance_to(1);
      CAPTURE(degrees, mu_s);
      CHECK(engine.state().velocity[0][1] == Approx(X * h).epsilon(1e-8));
      CHECK(engine.state().velocity[1][2] == Approx(-X * std::tan(a) * h).epsilon(1e-8));
      CHECK(engine.state().spin[0][1] == Approx(-X / R * h).epsilon(1e-8));
      auto contacts = by_partners(engine);
      CHECK(contacts[{0, 2}].normal_force == Approx(F_n).epsilon(1e-8));
      CHECK(std::abs(contacts[{0, 2}].shear_force) == Approx(mu * F_n).epsilon(1e-8));
      CHECK(contacts[{0, 2}].state == ContactState::slide);
      CHECK(std::abs(contacts[{0, wall_id(0)}].shear_force) == Approx(T).epsilon(1e-8));
      CHECK(contacts[{0, wall_id(0)}].state == ContactState::stick);
    }
  }
}

namespace {

/// Discs or spheres on a lattice, loosely, in a box with a floor and walls, each a little larger or smaller.
template <int D>
ContactEngine<D> heap(int wide, int layers, ContactSetup<D> setup, double spacing = 1.1) {
  Grains<D> grains;
  const int deep = D == 3 ? wide : 1;
  int id = 0;
  for (int layer = 0; layer < layers; ++layer)
    for (int y = 0; y < deep; ++y)
      for (int x = 0; x < wide; ++x, ++id) {
        Random random(3, Purpose::start, static_cast<std::uint64_t>(id));
        const double radius = 0.5 * (1 - 0.1 * random.uniform());
        Vec<D> place{}, velocity{};
        place[0] = 0.6 + spacing * x, place[D - 1] = 0.6 + spacing * layer;
        if constexpr (D == 3) place[1] = 0.6 + spacing * y;
        for (int k = 0; k < D; ++k) velocity[k] = 0.1 * random.normal();
        add_ball<D>(grains, place, velocity, true, radius);
      }
  Vec<D> g{};
  g[D - 1] = -1;
  pull<D>(setup, g);
  setup.walls = {floor_at<D>()};
  for (int k = 0; k + 1 < D; ++k) {
    Wall<D> low, high;
    low.normal[k] = 1, high.normal[k] = -1, high.point[k] = 0.1 + spacing * wide;
    setup.walls.push_back(low), setup.walls.push_back(high);
  }
  return ContactEngine<D>(std::move(grains), setup);
}

}  // namespace

// With more friction a pile may have several solutions, and they find different ones. In space the states of a pile come back sooner or later, and the exact solver says so; until then they agree.
TEST_CASE("the fast solver and its exact twin move a small pile alike") {
  const auto run = []<int D>(std::integral_constant<int, D>, double mu, std::int64_t steps) {
    auto setup = setup_of<D>(mu, 0.01);
    auto fast = heap<D>(D == 2 ? 4 : 2, D == 2 ? 3 : 2, setup);
    setup.solver = SolverKind::exact;
    setup.tolerance = 1e-7;
    auto exact = heap<D>(D == 2 ? 4 : 2, D == 2 ? 3 : 2, setup);
    fast.advance_to(steps), exact.advance_to(steps);
    CHECK(fast.contacts().size() > (D == 2 ? 15 : 8));
    CHECK(fast.record().unconverged == 0);
    for (std::size_t k = 0; k < D; ++k)
      for (std::size_t i = 0; i < fast.state().moving; ++i) {
        CAPTURE(D, mu, k, i);
        CHECK(fast.state().position[k][i] == Approx(exact.state().position[k][i]).margin(1e-8));
        CHECK(fast.state().velocity[k][i] == Approx(exact.state().velocity[k][i]).margin(1e-8));
      }
  };
  for (const double mu : {0.0, 0.1, 0.2, 0.3}) run(std::integral_constant<int, 2>{}, mu, 300);
  run(std::integral_constant<int, 3>{}, 0, 300);
  for (const double mu : {0.05, 0.2}) run(std::integral_constant<int, 3>{}, mu, 100);
}

namespace {

template <int D>
std::string state_of(const ContactEngine<D>& engine) {
  std::ostringstream out;
  engine.save(out);
  return out.str();
}

}  // namespace

TEST_CASE("the same bytes at any number of threads") {
  auto setup = setup_of<2>(0.4);
  setup.tolerance = 1e-4;
  std::string one;
  for (const int threads : {1, 2, 3}) {
    setup.threads = threads;
    auto engine = heap<2>(40, 40, setup, 1.02);
    engine.advance_to(20);
    if (threads == 1) {
      one = state_of(engine);
      CHECK(engine.touching().size() > contact::few_contacts);  // else it is one thread's work
    } else {
      CHECK(state_of(engine) == one);
    }
  }
}

TEST_CASE("the same bytes resumed or not") {
  auto setup = setup_of<3>(0.4);
  setup.static_friction = 0.6;
  setup.tolerance = 1e-6;
  auto whole = heap<3>(4, 4, setup);
  whole.advance_to(150);
  auto first = heap<3>(4, 4, setup);
  first.advance_to(77);
  std::istringstream half(state_of(first));
  auto second = heap<3>(4, 4, setup);
  second.restore(half);
  CHECK(second.contacts().size() == first.contacts().size());
  second.advance_to(150);
  CHECK(state_of(second) == state_of(whole));
}

namespace {

/// On a rough bed, without rebound: what fell between smooth walls. A disc that lies loose on a smooth floor would roll
/// for ever.
void check_heap(int wide, int layers) {
  const auto lay = [&](double tolerance, std::int64_t iterations) {
    Grains<2> grains;
    for (int layer = 0, id = 0; layer < layers; ++layer)
      for (int x = 0; x < wide; ++x, ++id) {
        Random random(3, Purpose::start, static_cast<std::uint64_t>(id));
        add_ball<2>(grains, {{0.6 + (layer % 2) * 0.5 + 1.02 * x, 1.0 + 0.9 * layer}}, {}, true,
                    0.5 * (1 - 0.1 * random.uniform()));
      }
    for (int k = 0; k < wide + 3; ++k) add_ball<2>(grains, {{1.0 * k, 0}}, {}, false);
    auto setup = setup_of<2>(0.5);
    setup.impacts = contact::Impacts::moreau;
    setup.tolerance = tolerance, setup.iterations = iterations;
    pull<2>(setup, {{0, -1}});
    setup.walls = {{{{0, 0}}, {{1, 0}}}, {{{1.2 + 1.02 * wide, 0}}, {{-1, 0}}}};
    for (auto& wall : setup.walls) wall.surface.friction = 0;
    return ContactEngine<2>(std::move(grains), setup);
  };
  auto falling = lay(1e-4, 200);
  falling.advance_to(2000);
  auto settling = lay(1e-6, 1000), heap = lay(1e-9, 20000);
  const auto go_on = [](ContactEngine<2>& engine, const std::string& bytes, std::int64_t step) {
    std::istringstream state(bytes);
    engine.restore(state);
    engine.advance_to(step);
  };
  go_on(settling, state_of(falling), 4000);
  go_on(heap, state_of(settling), 5000);
  const auto before = heap.state().position;
  heap.advance_to(5200);
  double creep = 0, weight = 0;
  for (std::size_t i = 0; i < heap.state().moving; ++i)
    for (std::size_t k = 0; k < 2; ++k)
      creep =
          std::max(creep, std::abs(heap.state().position[k][i] - before[k][i]) / 2);  // in 2 units of time
  for (const auto& c : heap.contacts())
    if (c.b >= static_cast<std::int64_t>(heap.state().moving)) weight -= c.force[1];
  CAPTURE(creep, heap.record().last_residual, heap.energy().translation);
  CHECK(creep < 1e-6);
  CHECK(weight == Approx(wide * layers).epsilon(1e-6));
  CHECK(heap.record().last_residual <= 1e-9);
  CHECK(heap.contacts().size() > static_cast<std::size_t>(wide * layers * 3 / 2));
}

}  // namespace

TEST_CASE("a heap of discs at rest creeps less than 1e-6 d per unit of time and weighs what it weighs") {
  check_heap(20, 10);
}

// A quarter of a minute: with --long.
TEST_CASE("so does a heap of 1000 discs", "[.exact]") { check_heap(60, 17); }
