// What a collision of the event-driven engine costs, by the number of grains: a gas of discs in a periodic
// box, and discs that rain on a bed. `collision` is the number to compare: it must grow like log N at
// most.
#include <benchmark/benchmark.h>

#include "../event/few_grains.hpp"

namespace {

using namespace chute;

void run(benchmark::State& state, const Grains<2>& grains, const event::EventSetup<2>& setup) {
  event::EventEngine<2> engine(grains, setup);
  engine.advance_to(20);  // the lattice is forgotten
  const auto before = engine.work().collisions;
  auto until = before;
  for (auto _ : state)
    for (until += 100'000; engine.work().collisions < until;) engine.advance_to(engine.step() + 1);
  const auto done = static_cast<double>(engine.work().collisions - before);
  state.counters["collision"] =
      benchmark::Counter(done, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["predictions"] =
      static_cast<double>(engine.work().predictions) / static_cast<double>(engine.work().collisions);
}

void gas(benchmark::State& state) {
  test::Gas<2> made(state.range(0), 1.25);
  made.setup.contact = {laws::ConstantRestitution{1}, {.friction = 0}};
  run(state, made.grains, made.setup);
}
BENCHMARK(gas)->Arg(10)->Arg(32)->Arg(100)->Arg(316)->Iterations(5)->Unit(benchmark::kMillisecond);

void rain(benchmark::State& state) {
  test::Heap made(static_cast<int>(state.range(0)), 10, 0.3);
  made.setup.contact = {laws::ConstantRestitution{0.9}, {.friction = 0.3, .beta = 0.3}};
  made.setup.contact_time = 1e-3;
  run(state, made.grains, made.setup);
}
BENCHMARK(rain)->Arg(10)->Arg(100)->Arg(1000)->Iterations(5)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
