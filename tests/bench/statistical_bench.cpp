// What the statistical methods cost: a site update of the lattice gas, a toppling of the rice pile, and a grain's step and a
// collision of DSMC in space. Rates are what to compare.
#include <benchmark/benchmark.h>

#include "../dsmc/gas.hpp"
#include "engines/automaton/lattice_gas.hpp"
#include "engines/automaton/pile.hpp"

namespace {

using namespace chute;
using benchmark::Counter;

void lattice_gas(benchmark::State& state) {
  automaton::LatticeGasSetup setup;
  setup.lattice = {1024, 1024, true, false};
  setup.rule = {0.1, 0.2, automaton::SiteRule::towards({{1, 0}})};
  setup.threads = static_cast<int>(state.range(0));
  automaton::LatticeGas gas(setup);
  std::int64_t t = 0;
  for (; t < 20; ++t) gas.update(t);
  for (auto _ : state) gas.update(t++);
  state.counters["sites"] = Counter(1024.0 * 1024.0, Counter::kIsIterationInvariantRate);
}
BENCHMARK(lattice_gas)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

void rice_pile(benchmark::State& state) {
  automaton::PileSetup setup;
  setup.length = state.range(0);
  automaton::Pile pile(setup);
  std::int64_t t = 0;
  for (; t < 2 * setup.length * setup.length; ++t) pile.update(t), pile.take_avalanches();
  const auto before = pile.topplings();
  for (auto _ : state) pile.update(t++), pile.take_avalanches();
  state.counters["topplings"] = Counter(static_cast<double>(pile.topplings() - before), Counter::kIsRate);
}
BENCHMARK(rice_pile)->Arg(64)->Arg(256);

/// One collision of a grain in five steps: φ = 0.05 with a step of 0.2 of the time between collisions.
void gas_in_space(benchmark::State& state) {
  const auto count = static_cast<std::size_t>(state.range(0));
  test::Gas<3> gas(count, 0.05);
  gas.setup.contact.restitution = laws::ConstantRestitution{1};
  gas.setup.time_step =
      0.2 / dsmc::collision_rate<3>(0.05 * 6 / std::numbers::pi, 1, dsmc::chi<3>(0.05), 1, 1);
  gas.setup.cell = 5.9;  // some 20 grains
  gas.setup.threads = static_cast<int>(state.range(1));
  dsmc::DsmcEngine<3> engine(std::move(gas.grains), gas.setup);
  engine.advance_to(3);
  const auto before = engine.collisions();
  for (auto _ : state) engine.advance_to(engine.step() + 1);
  state.counters["moves"] = Counter(static_cast<double>(count), Counter::kIsIterationInvariantRate);
  state.counters["collisions"] = Counter(static_cast<double>(engine.collisions() - before), Counter::kIsRate);
}
BENCHMARK(gas_in_space)
    ->Args({10'000, 1})
    ->Args({100'000, 1})
    ->Args({100'000, 2})
    ->Args({1'000'000, 1})
    ->Args({1'000'000, 2})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
