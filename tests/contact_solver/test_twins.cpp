// The fast solver and its slow twin, the matrix and the bodies: one problem, one answer.
#include <catch2/catch.hpp>

#include "common/error.hpp"
#include "heap.hpp"

using namespace chute;
using namespace chute::contact;

namespace {

TEMPLATE_TEST_CASE_SIG("fast and exact agree where the solution is unique", "", ((int D), D), 2, 3) {
  std::mt19937 dice(4);
  const Goal goal{.tolerance = 1e-12, .iterations = 100'000};
  Team team(1);
  int lost = 0, slid = 0, opened = 0, stuck = 0;
  constexpr int problems = 300;
  for (int k = 0; k < problems; ++k) {
    const auto problem =
        test::random_problem<D>(dice, 1 + static_cast<std::size_t>(k) % 12, k % 3 ? 0.3 : 0.0);
    AssembledSystem<D> system(problem);
    REQUIRE(nsgs(system, goal, team).reached);
    const auto fast = system.result();
    try {
      const auto slow = exact(problem, {.tolerance = 1e-10, .iterations = 100'000});
      INFO("problem " << k);
      REQUIRE(slow.convergence.reached);
      REQUIRE(test::largest_difference<D>(fast, slow.r) < 1e-8 * test::reference(problem));
    } catch (const WorkError&) {
      ++lost;
    }
    const auto u = problem.velocities(fast);
    for (std::size_t i = 0; i < problem.size(); ++i)
      (fast[i][0] == 0 ? opened : std::abs(u[i][1]) < 1e-9 ? stuck : slid) += 1;
  }
  INFO("the exact solver gave up on " << lost);
  CHECK(lost <= problems / 100);
  CHECK(opened > 300);
  CHECK(slid > 300);
  CHECK(stuck > 10);  // so little friction, which makes the solution unique, holds few
}

TEST_CASE("fast and exact agree on a pile whose forces are not determined") {
  // Hyperstatic: impulses may differ. Without friction what moves may not (a strictly convex problem in u).
  auto scene = test::heap(5, 4, 0);
  const auto problem = scene.problem();
  const auto slow = exact(problem, {.tolerance = 1e-9, .iterations = 100'000});
  Team team(1);
  AssembledSystem<2> system(problem);
  REQUIRE(nsgs(system, {.tolerance = 1e-12, .iterations = 100'000}, team).reached);
  const auto fast_u = problem.velocities(system.result()), slow_u = problem.velocities(slow.r);
  REQUIRE(test::largest_difference<2>(fast_u, slow_u) < 1e-9);
}

TEMPLATE_TEST_CASE_SIG("bodies and matrix are one problem", "", ((int D), D), 2, 3) {
  auto scene = [] {
    if constexpr (D == 2) return test::heap(9, 6, 0.4);
    if constexpr (D == 3) return test::heap_of_spheres(4, 0.4);
  }();
  const auto problem = scene.problem();
  Team team(1);
  AssembledSystem<D> with_matrix(problem);
  BodySystem<D> with_bodies(scene.bodies(), scene.contacts(), team);
  REQUIRE(with_bodies.reference() == Approx(with_matrix.reference()).epsilon(1e-12));
  // the same sweeps: not only the same end
  const Goal few{.tolerance = 1e-15, .iterations = 8};
  const auto one = nsgs(with_matrix, few, team), other = nsgs(with_bodies, few, team);
  REQUIRE(one.residual == Approx(other.residual).epsilon(1e-9));
  REQUIRE(test::largest_difference<D>(with_matrix.result(), with_bodies.result()) < 1e-13);
  // and what the bodies do then is what the matrix says
  const Goal goal{.tolerance = 1e-12, .iterations = 100'000};
  REQUIRE(nsgs(with_bodies, goal, team).reached);
  const auto r = with_bodies.result();
  REQUIRE(natural_residual<D>(problem, r, test::reference(problem)) < 1e-11);
  with_bodies.hand_back(scene.bodies(), scene.contacts());
  REQUIRE(scene.impulse == r);
  const auto after = scene.problem();  // its q are the velocities now
  REQUIRE(test::largest_difference<D>(after.q, problem.velocities(r)) < 1e-12);
}

TEST_CASE("what the exact solver refuses") {
  std::mt19937 dice(5);
  Problem<2> many;
  for (std::size_t i = 0; i <= most_exact; ++i) {
    many.columns.push_back(static_cast<std::uint32_t>(i));
    many.blocks.push_back({{1, 0, 0, 1}});
    many.row_starts.push_back(i + 1);
    many.q.push_back({{-1, 0}});
    many.friction.push_back(0.5);
  }
  REQUIRE_THROWS_AS(exact(many, {}), InputError);
  // not enough sets of states: told, not hidden
  const auto problem = test::random_problem<2>(dice, 12, 0.3);
  REQUIRE_FALSE(exact(problem, {.tolerance = 1e-8, .iterations = 1}).convergence.reached);
}

TEST_CASE("a warm start is used, and one that is no use does no harm") {
  auto scene = test::heap(12, 8, 0.4);
  const Goal goal{.tolerance = 1e-10, .iterations = 100'000};
  const auto problem = scene.problem();
  Team team(1);
  AssembledSystem<2> cold(problem);
  const auto first = nsgs(cold, {.tolerance = 1e-12, .iterations = 100'000}, team);
  const auto solution = cold.result();
  AssembledSystem<2> warm(problem, solution);
  REQUIRE(nsgs(warm, goal, team).iterations <= 1);
  REQUIRE(first.iterations > 20);
  std::vector<Vec<2>> nonsense(problem.size(), Vec<2>{{-3, 7}});
  AssembledSystem<2> misled(problem, nonsense);
  REQUIRE(nsgs(misled, goal, team).reached);
  // at rest without forces: the warm start's impulses must go
  auto still = problem;
  for (auto& q : still.q) q = {};
  AssembledSystem<2> nothing(still, solution);
  REQUIRE(nsgs(nothing, goal, team).reached);
  REQUIRE(test::largest_difference<2>(nothing.result(), std::vector<Vec<2>>(problem.size())) == 0);
}

}  // namespace
