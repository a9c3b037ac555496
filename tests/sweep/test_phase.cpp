#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "sweep/phase.hpp"

using namespace chute;
using namespace chute::sweep;
using measure::Verdict;

namespace {

measure::Flow flow(Verdict verdict, double v_x) {
  return {verdict, 1, {v_x, 0.01}, {2 * v_x, {}}, {v_x * v_x, {}}};
}

Tally launch(std::size_t stopped, std::size_t steady, std::size_t runaway, double v_x) {
  std::vector<measure::Flow> flows;
  flows.insert(flows.end(), stopped, flow(Verdict::stopped, 0));
  flows.insert(flows.end(), steady, flow(Verdict::steady, v_x));
  flows.insert(flows.end(), runaway, flow(Verdict::runaway, 10 * v_x));
  return tally(flows);
}

}  // namespace

TEST_CASE("a tally counts verdicts, and averages over the steady starts") {
  const std::vector flows{flow(Verdict::steady, 1), flow(Verdict::steady, 3), flow(Verdict::stopped, 0),
                          flow(Verdict::accelerating, 50), flow(Verdict::unsettled, 2)};
  const auto t = tally(flows);
  CHECK(t.starts == 5);
  CHECK(t.count(Verdict::steady) == 2);
  CHECK(t.count(Verdict::stopped) == 1);
  CHECK(t.v_x.mean == 2);
  CHECK(*t.v_x.error == Approx(1.0));  // √(2/1/2)
  CHECK(t.omega.mean == 4);
  CHECK(t.median.mean == Approx(2.5));                          // of 1, 2, 3, 50
  CHECK(*t.median.error == Approx(1.2533 * 1.4826 * 1.0 / 2));  // deviations 0.5, 0.5, 1.5, 47.5

  const auto one = tally(std::vector{flow(Verdict::steady, 1)});
  CHECK(*one.v_x.error == 0.01);  // its own
  const auto none = tally(std::vector{flow(Verdict::stopped, 0)});
  CHECK(std::isnan(none.v_x.mean));
  CHECK(std::isnan(none.median.mean));
  CHECK(none.together == 0);
}

TEST_CASE("phases follow from several starts at several launch velocities") {
  constexpr double alike = 0.05;
  CHECK(phase_of(std::vector{launch(5, 5, 0, 1)}, alike) == Phase::A);  // half is enough
  CHECK(phase_of(std::vector{launch(4, 6, 0, 1)}, alike) == Phase::B);
  CHECK(phase_of(std::vector{launch(0, 4, 6, 1)}, alike) == Phase::C);
  CHECK(phase_of(std::vector{launch(0, 10, 0, 1), launch(0, 10, 0, 1.04)}, alike) == Phase::B);
  CHECK(phase_of(std::vector{launch(0, 10, 0, 1), launch(0, 10, 0, 1.06)}, alike) == Phase::C);
  CHECK(phase_of(std::vector{launch(0, 10, 0, 1), launch(0, 4, 6, 1)}, alike) == Phase::C);
  CHECK(phase_of(std::vector{launch(0, 10, 0, 1), launch(10, 0, 0, 1)}, alike) == Phase::A);
}

TEST_CASE("bisection finds both boundaries to the tolerance, and looks no farther than it must") {
  std::map<double, int> looked;
  const auto phase_at = [&](double x) {
    ++looked[x];
    return x < 0.123 ? Phase::A : x < 0.456 ? Phase::B : Phase::C;
  };
  const std::vector values{0.0, 0.25, 0.5, 0.75, 1.0};
  const auto found = find_boundaries(values, 1e-3, Wanted::both, phase_at);
  CHECK(std::abs(found.AB->mean - 0.123) <= *found.AB->error);
  CHECK(std::abs(found.BC->mean - 0.456) <= *found.BC->error);
  CHECK(*found.BC->error <= 0.5e-3);
  CHECK(looked.count(0.75) == 0);
  CHECK(looked.size() == 3 + 8 + 8);  // 0.25 / 2^8 < 1e-3

  looked.clear();
  const auto only = find_boundaries(values, 1e-3, Wanted::AB, phase_at);
  CHECK(only.AB->mean == found.AB->mean);
  CHECK(!only.BC);
  CHECK(looked.count(0.5) == 0);
}

TEST_CASE("boundaries that the range does not hold are not made up") {
  const std::vector values{0.0, 0.5, 1.0};
  const auto always = [](Phase phase) { return [phase](double) { return phase; }; };
  for (const auto phase : {Phase::A, Phase::B, Phase::C}) {
    const auto found = find_boundaries(values, 0.01, Wanted::both, always(phase));
    CHECK(!found.AB);
    CHECK(!found.BC);
  }
  // no B between: both boundaries are the same place
  const auto direct =
      find_boundaries(values, 0.01, Wanted::both, [](double x) { return x < 0.3 ? Phase::A : Phase::C; });
  CHECK(direct.AB->mean == Approx(0.3).margin(0.005));
  CHECK(direct.BC->mean == direct.AB->mean);
}
