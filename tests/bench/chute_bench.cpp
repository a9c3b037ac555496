// Speed of the dense flow of thesis 5.2 (scenes/chute-2d.toml) and larger copies of it, after five units of
// time in which it settles; beyond 3000 discs, copies of that settled flow side by side, with ids in no
// order, as they are after a long time. `grain_steps/s` is the number to compare, of processor time, with several
// threads of the wall clock; memory is what the process grew by.
//   chute_bench --benchmark_filter='flow/300/.*'
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <fstream>
#include <map>

#include "core/random.hpp"
#include "engines/soft/soft_engine.hpp"
#include "engines/soft/soft_method.hpp"
#include "scene/world.hpp"

namespace {

using namespace chute;

constexpr double settling = 5;

scene::Scene flow(std::int64_t grains) {
  return scene::read_scene(
      CHUTE_SOURCE_DIR "/scenes/chute-2d.toml",
      {"grains.count=" + std::to_string(grains), "bed.count=" + std::to_string(grains / 10)});
}

/// As the method makes it, with a choice of the instruction set.
soft::SoftSetup<2> setup_of(const scene::Scene& scene, const Surroundings<2>& around, Isa isa) {
  const auto setting = scene::setting_of(scene);
  soft::SoftSetup<2> setup{around};
  setup.laws = scene.contact.laws(setting.reference());
  setup.time_step = scene.engine->step(setting);
  setup.skins = soft::usual_skins<2>(setting.mean_diameter);
  setup.isa = isa;
  return setup;
}
soft::SoftEngine<2> engine_of(const scene::Scene& scene, Isa isa) {
  auto world = scene::make_world<2>(scene);
  return {std::move(world.grains), setup_of(scene, world.surroundings(), isa)};
}

/// The settled flow, made once for each size: it is the same bytes with every instruction set.
const Grains<2>& settled(std::int64_t grains) {
  static std::map<std::int64_t, Grains<2>> states;
  if (!states.contains(grains)) {
    auto engine = engine_of(flow(grains), best_isa());
    engine.advance_to(std::llround(settling / engine.time_step()));
    states.emplace(grains, engine.state());
  }
  return states.at(grains);
}

/// Copies of a settled flow side by side, the moving grains in random order.
Grains<2> copies(const Grains<2>& tile, double length, std::int64_t count) {
  std::vector<std::pair<std::size_t, double>> which;
  for (std::int64_t k = 0; k < count; ++k)
    for (std::size_t i = 0; i < tile.moving; ++i) which.emplace_back(i, static_cast<double>(k) * length);
  if (count > 1) {
    Random random(1, Purpose::start);
    for (std::size_t k = which.size(); k-- > 1;)
      std::swap(which[k], which[static_cast<std::size_t>(random.uniform() * static_cast<double>(k + 1))]);
  }
  for (std::int64_t k = 0; k < count; ++k)
    for (std::size_t i = tile.moving; i < tile.size(); ++i)
      which.emplace_back(i, static_cast<double>(k) * length);
  Grains<2> all;
  for (const auto& [i, shift] : which) {
    all.add(tile.place(i) + Vec<2>{{shift, 0}}, tile.radius[i], tile.mass[i], tile.inertia[i],
            i < tile.moving);
    for (int k = 0; k < 2; ++k) all.velocity[k].back() = tile.velocity[k][i];
    all.spin[0].back() = tile.spin[0][i];
  }
  return all;
}

void steps(benchmark::State& state, std::int64_t grains, Isa isa, int threads) {
  const auto tile = std::min<std::int64_t>(grains, 3000), count = grains / tile;
  const auto scene = flow(tile);
  Surroundings<2> around = scene::make_world<2>(scene);
  const double length = around.domain.length[0];
  around.domain.length[0] *= static_cast<double>(count);
  auto setup = setup_of(scene, around, isa);
  setup.threads = threads;
  soft::SoftEngine<2> engine(copies(settled(tile), length, count), setup);
  const std::int64_t slice = std::max<std::int64_t>(1024, 300'000 / grains);
  engine.advance_to(slice);  // the first lists
  const auto lists = engine.neighbours().near_builds(), tiled = engine.tiled_steps();
  for (auto _ : state) engine.advance_to(engine.step() + slice);
  const auto done = static_cast<double>(state.iterations() * slice);
  state.counters["grain_steps/s"] =
      benchmark::Counter(done * static_cast<double>(grains), benchmark::Counter::kIsRate);
  state.counters["contacts/grain"] =
      static_cast<double>(engine.contacts().size()) / static_cast<double>(grains);
  state.counters["tiled"] = static_cast<double>(engine.tiled_steps() - tiled) / done;
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
  for (const std::int64_t grains : {300, 3000, 30'000, 300'000})
    for (const auto& [name, isa] : sets)
      for (const int threads : {1, 2}) {
        if (isa > best_isa() || (threads > 1 && (isa < best_isa() || grains == 300))) continue;
        const auto title =
            "flow/" + std::to_string(grains) + "/" + name + "/threads:" + std::to_string(threads);
        auto* flow = benchmark::RegisterBenchmark(title.c_str(), steps, grains, isa, threads);
        flow->Unit(benchmark::kMillisecond);
        if (threads > 1) flow->UseRealTime();
      }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
}
