// What it costs to move a hard grain by chance and to lay one on others. Rates are what to compare: `trials` and `grains` a
// second of one core.
#include <benchmark/benchmark.h>

#include "../monte_carlo/gas.hpp"
#include "../restructuring/deposit.hpp"

namespace {

using namespace chute;
using benchmark::Counter;

/// Sweeps of a gas of side^D grains, after its trial length has adapted and the lattice of its start is forgotten.
template <int D>
void trial_moves(benchmark::State& state, double phi) {
  test::Gas<D> gas(static_cast<int>(state.range(0)), phi);
  monte_carlo::MonteCarloEngine<D> engine(gas.grains, gas.setup);
  engine.advance_to(gas.setup.equilibrate + 100);
  for (auto _ : state) engine.advance_to(engine.step() + 1);
  state.counters["trials"] =
      Counter(static_cast<double>(gas.grains.moving), Counter::kIsIterationInvariantRate);
  state.counters["acceptance"] = engine.acceptance();
}
void moves_2d(benchmark::State& state) { trial_moves<2>(state, 0.5); }
BENCHMARK(moves_2d)->Arg(32)->Arg(100)->Arg(316)->Unit(benchmark::kMillisecond);
void moves_3d(benchmark::State& state) { trial_moves<3>(state, 0.45); }
BENCHMARK(moves_3d)->Arg(10)->Arg(22)->Arg(46)->Unit(benchmark::kMillisecond);

/// Shakes in which all grains are laid anew, after the first, in which they rain from random places.
template <int D>
void placements(benchmark::State& state, double width) {
  const auto count = static_cast<std::size_t>(state.range(0));
  auto engine = test::rained<D>({.grains = count, .width = width, .spread = 0.1});
  engine.advance_to(1);
  for (auto _ : state) engine.advance_to(engine.step() + 1);
  state.counters["grains"] = Counter(static_cast<double>(count), Counter::kIsIterationInvariantRate);
}
void placements_2d(benchmark::State& state) { placements<2>(state, 300); }
BENCHMARK(placements_2d)->Arg(10'000)->Arg(100'000)->Unit(benchmark::kMillisecond);
void placements_3d(benchmark::State& state) { placements<3>(state, 40); }
BENCHMARK(placements_3d)->Arg(10'000)->Arg(100'000)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
