// Problems of frictional contact: what an update of a contact costs, and how many sweeps it takes. Heaps of grains
// that are pressed together for one step, from no impulses at all; with CHUTE_PROBLEM set, that file too:
//
//   CHUTE_PROBLEM=Capsules.hdf5 build/bin/contact_bench --benchmark_repetitions=11
#include <benchmark/benchmark.h>

#include <cstdlib>

#include "../contact_solver/heap.hpp"
#include "engines/contact/problem/problem_file.hpp"

namespace {

using namespace chute;
using namespace chute::contact;

void count(benchmark::State& state, const Convergence& c, std::size_t contacts) {
  if (!c.reached) state.SkipWithError("the tolerance was not reached");
  state.counters["contacts"] = static_cast<double>(contacts);
  state.counters["sweeps"] = static_cast<double>(c.iterations);
  state.counters["updates"] =
      benchmark::Counter(static_cast<double>(c.iterations) * static_cast<double>(contacts),
                         benchmark::Counter::kIsIterationInvariantRate);
}

template <class Scene>
void bodies(benchmark::State& state, Scene scene, int threads) {
  Team team(threads);
  Convergence c;
  for (auto _ : state) {
    BodySystem<std::tuple_size_v<decltype(scene.velocity)>> system(scene.bodies(), scene.contacts(), team);
    c = nsgs(system, {.tolerance = 1e-6, .iterations = 100'000}, team);
  }
  count(state, c, scene.size());
}
void discs(benchmark::State& state) {
  bodies(state, test::heap(static_cast<int>(state.range(0)), static_cast<int>(state.range(0)) / 2, 0.4),
         static_cast<int>(state.range(1)));
}
BENCHMARK(discs)->ArgsProduct({{30, 150}, {1, 2}})->Unit(benchmark::kMillisecond)->UseRealTime();
void spheres(benchmark::State& state) {
  bodies(state, test::heap_of_spheres(static_cast<int>(state.range(0)), 0.4),
         static_cast<int>(state.range(1)));
}
BENCHMARK(spheres)->ArgsProduct({{7, 20}, {1, 2}})->Unit(benchmark::kMillisecond)->UseRealTime();

void file(benchmark::State& state) {
  const char* path = std::getenv("CHUTE_PROBLEM");
  if (!path) return state.SkipWithError("CHUTE_PROBLEM names no file");
  const auto solve = [&]<int D>(const Problem<D>& problem) {
    Team team(1);
    Convergence c;
    for (auto _ : state) {
      AssembledSystem<D> system(problem);
      c = nsgs(system, {.tolerance = 1e-8, .iterations = 100'000}, team);
    }
    count(state, c, problem.size());
  };
  std::visit(solve, read_problem(path));
}
BENCHMARK(file)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
