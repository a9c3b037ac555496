// What a collision of the event-driven engine costs, by the number of grains: gases in a periodic box, in space at
// φ = 0.45 as F. Smallenburg (arXiv:2201.01100) measured, and discs that rain on a bed. `collision` is the number to
// compare, in processor time: it must not grow.
#include <benchmark/benchmark.h>

#include "../event/few_grains.hpp"

namespace {

using namespace chute;

template <int D>
void run(benchmark::State& state, const Grains<D>& grains, const event::EventSetup<D>& setup) {
  event::EventEngine<D> engine(grains, setup);
  while (engine.work().collisions < 20 * static_cast<std::int64_t>(grains.moving))
    engine.advance_to(engine.step() + 1);  // the lattice is forgotten
  const auto before = engine.work().collisions;
  auto until = before;
  for (auto _ : state)
    for (until += 100'000; engine.work().collisions < until;) engine.advance_to(engine.step() + 1);
  const auto done = static_cast<double>(engine.work().collisions - before);
  state.counters["collision"] =
      benchmark::Counter(done, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  const auto each = [&](std::int64_t count) {
    return static_cast<double>(count) / static_cast<double>(engine.work().collisions);
  };
  state.counters["pairs"] = each(engine.work().candidates);
  state.counters["predictions"] = each(engine.work().predictions);
  state.counters["outdated"] = each(engine.work().outdated);
  state.counters["moves"] = each(engine.work().moves);
}

/// Smooth and elastic, as gases are compared.
template <int D>
void gas(benchmark::State& state, double spacing) {
  test::Gas<D> made(state.range(0), spacing);
  made.setup.contact = {laws::ConstantRestitution{1}, {.friction = 0}};
  run(state, made.grains, made.setup);
}
void gas_2d(benchmark::State& state) { gas<2>(state, 1.25); }  // φ = 0.50
BENCHMARK(gas_2d)->Arg(32)->Arg(100)->Arg(316)->Iterations(3)->Unit(benchmark::kMillisecond);
void gas_3d(benchmark::State& state) { gas<3>(state, 1.0517); }  // φ = 0.45
BENCHMARK(gas_3d)->Arg(10)->Arg(16)->Arg(32)->Arg(47)->Iterations(3)->Unit(benchmark::kMillisecond);

void rain(benchmark::State& state) {
  test::Heap made(static_cast<int>(state.range(0)), 10, 0.3);
  made.setup.contact = {laws::ConstantRestitution{0.9}, {.friction = 0.3, .beta = 0.3}};
  made.setup.contact_time = 1e-3;
  run(state, made.grains, made.setup);
}
BENCHMARK(rain)->Arg(10)->Arg(100)->Arg(1000)->Iterations(5)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
