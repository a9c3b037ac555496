// The order of sweeps, threads, and how many sweeps it takes.
#include <catch2/catch.hpp>
#include <set>

#include "heap.hpp"

using namespace chute;
using namespace chute::contact;

namespace {

TEST_CASE("contacts of one colour share no body") {
  auto scene = test::heap(150, 40, 0.4);
  REQUIRE(scene.size() > few_contacts);
  const auto order = coloured_by_bodies(scene.a, scene.b, scene.inverse_mass.size());
  REQUIRE_FALSE(order.serial_rest);
  REQUIRE(order.ends.size() <= 11);  // a disc has six neighbours: greedy needs at most 2·6 − 1
  std::set<std::uint32_t> all(order.contacts.begin(), order.contacts.end());
  REQUIRE(all.size() == scene.size());
  std::size_t begin = 0;
  for (const auto end : order.ends) {
    std::set<int> bodies;
    for (auto k = begin; k < end; ++k)
      for (const int body : {scene.a[order.contacts[k]], scene.b[order.contacts[k]]})
        if (body >= 0) REQUIRE(bodies.insert(body).second);
    begin = end;
  }
  // the same by the matrix: contacts that feel each other
  const auto problem = test::heap(12, 8, 0.4).problem();
  const auto by_rows = coloured_by_rows(problem.row_starts, problem.columns);
  const auto place = by_rows.places();
  std::vector<std::size_t> colour(problem.size());
  begin = 0;
  for (std::size_t c = 0; c < by_rows.ends.size(); begin = by_rows.ends[c++])
    for (auto k = begin; k < by_rows.ends[c]; ++k) colour[by_rows.contacts[k]] = c;
  for (std::size_t i = 0; i < problem.size(); ++i) {
    REQUIRE(by_rows.contacts[place[i]] == i);
    for (auto k = problem.row_starts[i]; k < problem.row_starts[i + 1]; ++k)
      if (problem.columns[k] != i) REQUIRE(colour[problem.columns[k]] != colour[i]);
  }
}

TEST_CASE("a body with more contacts than there are colours leaves the rest to one thread") {
  std::vector<std::int32_t> a, b;
  for (int k = 1; k <= 200; ++k) a.push_back(k), b.push_back(0);
  const auto order = coloured_by_bodies(a, b, 201);
  REQUIRE(order.serial_rest);
  REQUIRE(order.ends.size() == 64);
  REQUIRE(order.ends[62] == 63);
  REQUIRE(order.ends[63] == 200);
}

template <int D>
std::vector<double> bytes(test::Scene<D> scene, int threads) {
  const auto c = scene.solve({.tolerance = 1e-9, .iterations = 200}, threads);
  std::vector<double> all{c.residual, static_cast<double>(c.iterations)};
  for (const auto& r : scene.impulse) all.insert(all.end(), r.c.begin(), r.c.end());
  for (const auto& v : scene.velocity) all.insert(all.end(), v.begin(), v.end());
  for (const auto& w : scene.spin) all.insert(all.end(), w.begin(), w.end());
  return all;
}

TEST_CASE("the same bytes with any number of threads") {
  const auto discs = test::heap(150, 40, 0.4);
  const auto spheres = test::heap_of_spheres(13, 0.4);
  REQUIRE(discs.size() > few_contacts);
  REQUIRE(spheres.size() > few_contacts);
  const auto flat = bytes(discs, 1), solid = bytes(spheres, 1);
  for (const int threads : {2, 3, 5}) {
    REQUIRE(bytes(discs, threads) == flat);
    REQUIRE(bytes(spheres, threads) == solid);
  }
}

/// Sweeps without any acceleration, counted by the residual of the matrix.
long plain_sweeps(const Problem<2>& problem, double tolerance) {
  AssembledSystem<2> system(problem);
  const auto& order = system.order();
  for (long sweeps = 1;; ++sweeps) {
    for (std::size_t k = 0; k < order.size(); ++k)
      system.set(k, system.contact(k).solve(system.without(k), system.impulses()[k]));
    if (natural_residual<2>(problem, system.result(), test::reference(problem)) <= tolerance) return sweeps;
  }
}

TEST_CASE("acceleration saves most of the sweeps where Gauss-Seidel is slow") {
  // a stack, numbered from the top: its weight needs many sweeps to get down
  test::Scene<2> stack;
  const int count = 60;
  for (int k = 0; k < count; ++k) stack.body(1, 0.125, {{0, -0.01}});
  for (int k = count - 1; k >= 0; --k) stack.touch(k, k - 1, {{0, 1}}, 0.5);
  const auto problem = stack.problem();
  const double tolerance = 1e-8;
  const long plain = plain_sweeps(problem, tolerance);
  Team team(1);
  AssembledSystem<2> system(problem);
  const auto fast = nsgs(system, {.tolerance = tolerance, .iterations = plain}, team);
  INFO(fast.iterations << " sweeps, " << plain << " without acceleration");
  REQUIRE(fast.reached);
  REQUIRE(plain > 1000);
  REQUIRE(fast.iterations < plain / 5);
}

TEST_CASE("impulses that drift before a contact gives way are overtaken") {
  // A disc between two walls that close in and lean outwards by little more than friction holds: in each sweep the
  // impulses grow by the same amount, until they are large enough to push the disc out.
  test::Scene<2> wedge;
  wedge.body(1, 0.125, {{0, -0.01}});
  const double lean = 0.1, mu = 0.99 * std::tan(lean);
  wedge.touch(0, -1, {{std::cos(lean), std::sin(lean)}}, mu);
  wedge.touch(0, -1, {{-std::cos(lean), std::sin(lean)}}, mu);
  for (auto& o : wedge.offset) o = {{-1e-3, 0}};
  const long plain = plain_sweeps(wedge.problem(), 1e-10);
  const auto c = wedge.solve({.tolerance = 1e-10, .iterations = plain});
  INFO(c.iterations << " sweeps, " << plain << " without acceleration");
  REQUIRE(c.reached);
  REQUIRE(plain > 1000);
  REQUIRE(c.iterations < plain / 5);
  // out it goes: v_y sin(lean) = 1e-3
  REQUIRE(wedge.velocity[1][0] == Approx(1e-3 / std::sin(lean)).epsilon(1e-6));
}

TEST_CASE("what does not converge says so") {
  auto scene = test::heap(20, 10, 0.4);
  const auto c = scene.solve({.tolerance = 1e-14, .iterations = 7});
  REQUIRE_FALSE(c.reached);
  REQUIRE(c.residual > 1e-14);
  REQUIRE(c.iterations >= 7);
  REQUIRE(c.iterations < 7 + 5);
  test::Scene<2> nothing;
  REQUIRE(nothing.solve({}).reached);
}

}  // namespace
