// Speed of the dense flow of thesis 5.2 (scenes/chute-2d.toml) and larger copies of it, one thread, after
// five units of time in which it settles. `grain_steps/s` is the number to compare; memory is what the
// process grew by.
//   chute_bench --benchmark_filter='flow/300/.*'
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <fstream>
#include <map>
#include <sstream>

#include "run/engine_factory.hpp"
#include "scene/start.hpp"
#include "soft/soft_engine.hpp"

namespace {

using namespace chute;

constexpr double settling = 5;

scene::Scene flow(std::int64_t grains) {
  return scene::read_scene(
      CHUTE_SOURCE_DIR "/scenes/chute-2d.toml",
      {"grains.count=" + std::to_string(grains), "bed.count=" + std::to_string(grains / 10)});
}

/// As run::make_engine, with a choice of the instruction set.
soft::SoftEngine<2> engine_of(const scene::Scene& scene, Isa isa) {
  auto start = scene::make_start(scene);
  const double theta = scene.incline.theta(), g = scene.incline.gravity;
  soft::SoftSetup<2> setup;
  setup.domain = start.domain;
  setup.gravity = {{g * std::sin(theta), -g * std::cos(theta)}};
  setup.laws = scene.contact.laws(scene.reference_pair());
  setup.time_step = run::time_step(scene);
  setup.skins = soft::usual_skins<2>(scene.mean_diameter());
  setup.isa = isa;
  return {std::move(start.grains), setup};
}

/// The settled flow, made once for each size: it is the same bytes with every instruction set.
const std::string& settled(std::int64_t grains) {
  static std::map<std::int64_t, std::string> states;
  auto& state = states[grains];
  if (state.empty()) {
    auto engine = engine_of(flow(grains), best_isa());
    engine.advance_to(std::llround(settling / engine.time_step()));
    std::ostringstream out;
    engine.save(out);
    state = out.str();
  }
  return state;
}

void steps(benchmark::State& state, std::int64_t grains, Isa isa) {
  auto engine = engine_of(flow(grains), isa);
  std::istringstream in(settled(grains));
  engine.restore(in);
  const std::int64_t slice = std::max<std::int64_t>(1, 300'000 / grains);
  const auto lists = engine.neighbours().near_builds();
  for (auto _ : state) engine.advance_to(engine.step() + slice);
  const auto done = static_cast<double>(state.iterations() * slice);
  state.counters["grain_steps/s"] =
      benchmark::Counter(done * static_cast<double>(grains), benchmark::Counter::kIsRate);
  state.counters["contacts/grain"] =
      static_cast<double>(engine.contacts().size()) / static_cast<double>(grains);
  const auto made = std::max<std::int64_t>(1, engine.neighbours().near_builds() - lists);
  state.counters["steps/list"] = done / static_cast<double>(made);
}

double resident_bytes() {
  std::ifstream in("/proc/self/statm");
  double total = 0, resident = 0;
  in >> total >> resident;
  return resident * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

void memory(benchmark::State& state, std::int64_t grains) {
  for (auto _ : state) {
    const auto scene = flow(grains);
    const double before = resident_bytes();
    auto engine = engine_of(scene, best_isa());
    engine.advance_to(200);
    state.counters["bytes/grain"] = (resident_bytes() - before) / static_cast<double>(grains);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::pair<const char*, Isa> sets[] = {
      {"baseline", Isa::baseline}, {"avx2", Isa::avx2}, {"avx512", Isa::avx512}};
  // memory first: what other benchmarks have freed would hide growth
  benchmark::RegisterBenchmark("memory/100000", memory, 100'000)
      ->Iterations(1)
      ->Unit(benchmark::kMillisecond);
  for (const std::int64_t grains : {300, 3000, 30'000})
    for (const auto& [name, isa] : sets)
      if (isa <= best_isa())
        benchmark::RegisterBenchmark(("flow/" + std::to_string(grains) + "/" + name).c_str(), steps, grains,
                                     isa)
            ->Unit(benchmark::kMillisecond);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
}
