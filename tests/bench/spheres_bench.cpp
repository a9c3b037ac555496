// Spheres that run down a plane of glued spheres, with a spring between their surfaces that remembers
// (scenes/chute-3d.toml): what a step costs, by the number of spheres. The flow of 1000 is followed for some time until
// it is dense; larger ones are copies of it side by side, ids in no order, as they are after a long time.
// `grain_steps/s` counts processor time.
//   spheres_bench --benchmark_filter='spheres/8000/.*'
//   spheres_bench --lammps DIR       writes the settled flows as data files for LAMMPS (table.py)
#include <benchmark/benchmark.h>
#include <fmt/os.h>

#include <map>
#include <string_view>

#include "core/random.hpp"
#include "engines/soft/soft_engine.hpp"
#include "engines/soft/soft_method.hpp"
#include "scene/world.hpp"

namespace {

using namespace chute;

constexpr double settling = 15;  // units of time
constexpr std::int64_t in_tile = 1000;

struct Flow {
  Grains<3> grains;
  soft::SoftSetup<3> setup;
};

/// As the method makes it.
Flow start() {
  const auto scene = scene::read_scene(CHUTE_SOURCE_DIR "/scenes/chute-3d.toml", {});
  auto world = scene::make_world<3>(scene);
  const auto setting = scene::setting_of(scene);
  Flow flow{std::move(world.grains), soft::SoftSetup<3>{world.surroundings()}};
  flow.setup.laws = scene.contact.laws(setting.reference());
  flow.setup.time_step = scene.engine->step(setting);
  flow.setup.skins = soft::usual_skins<3>(setting.mean_diameter);
  return flow;
}

const Grains<3>& settled() {
  static const Grains<3> grains = [] {
    auto flow = start();
    soft::SoftEngine<3> engine(std::move(flow.grains), flow.setup);
    engine.advance_to(std::llround(settling / engine.time_step()));
    return engine.state();
  }();
  return grains;
}

/// `count` tiles, as square as can be.
Flow flow_of(std::int64_t count) {
  Flow flow = start();
  const auto& tile = settled();
  auto& length = flow.setup.domain.length;
  std::int64_t along = 1;
  while (2 * along * along <= count) along *= 2;
  const std::int64_t across = count / along;
  struct Copy {
    std::size_t grain;
    Vec<3> shift;
  };
  std::vector<Copy> moving, bed;
  for (std::int64_t a = 0; a < along; ++a)
    for (std::int64_t b = 0; b < across; ++b)
      for (std::size_t i = 0; i < tile.size(); ++i)
        (i < tile.moving ? moving : bed)
            .push_back({i, {{static_cast<double>(a) * length[0], static_cast<double>(b) * length[1], 0}}});
  Random random(1, Purpose::start);
  for (std::size_t k = moving.size(); k-- > 1;)
    std::swap(moving[k], moving[static_cast<std::size_t>(random.uniform() * static_cast<double>(k + 1))]);
  Grains<3> all;
  all.reserve(moving.size() + bed.size());
  for (const auto* part : {&moving, &bed})
    for (const auto& [i, shift] : *part) {
      all.add(tile.place(i) + shift, tile.radius[i], tile.mass[i], tile.inertia[i], i < tile.moving);
      for (std::size_t k = 0; k < 3; ++k)
        all.velocity[k].back() = tile.velocity[k][i], all.spin[k].back() = tile.spin[k][i];
    }
  length[0] *= static_cast<double>(along), length[1] *= static_cast<double>(across);
  flow.grains = std::move(all);
  return flow;
}

void spheres(benchmark::State& state, std::int64_t tiles, Isa isa, int threads, soft::Scheme scheme) {
  auto flow = flow_of(tiles);
  flow.setup.isa = isa, flow.setup.threads = threads, flow.setup.scheme = scheme;
  soft::SoftEngine<3> engine(std::move(flow.grains), flow.setup);
  const std::int64_t slice = std::max<std::int64_t>(20, 500'000 / (tiles * in_tile));
  engine.advance_to(2 * slice);  // the first lists
  const auto lists = engine.neighbours().near_builds();
  for (auto _ : state) engine.advance_to(engine.step() + slice);
  const auto done = static_cast<double>(state.iterations() * slice);
  state.counters["grain_steps/s"] =
      benchmark::Counter(done * static_cast<double>(tiles * in_tile), benchmark::Counter::kIsRate);
  state.counters["contacts/grain"] =
      static_cast<double>(engine.contacts().size()) / static_cast<double>(tiles * in_tile);
  state.counters["steps/list"] =
      done / static_cast<double>(std::max<std::int64_t>(1, engine.neighbours().near_builds() - lists));
}

void write_lammps(const std::string& folder) {
  for (const std::int64_t tiles : {8, 64}) {
    const auto flow = flow_of(tiles);
    const auto& g = flow.grains;
    const auto& length = flow.setup.domain.length;
    auto out = fmt::output_file(fmt::format("{}/spheres-{}.data", folder, tiles * in_tile));
    out.print(
        "settled flow of spheres\n\n{} atoms\n2 atom types\n0 {} xlo xhi\n0 {} ylo yhi\n-2 200 zlo zhi\n\n",
        g.size(), length[0], length[1]);
    out.print("Atoms # sphere\n\n");
    for (std::size_t i = 0; i < g.size(); ++i) {
      const double d = 2 * g.radius[i], volume = 4.18879020478639 * g.radius[i] * g.radius[i] * g.radius[i];
      out.print("{} {} {} {} {} {} {}\n", i + 1, i < g.moving ? 2 : 1, d, g.mass[i] / volume,
                g.position[0][i], g.position[1][i], g.position[2][i]);
    }
    out.print("\nVelocities\n\n");
    for (std::size_t i = 0; i < g.size(); ++i)
      out.print("{} {} {} {} {} {} {}\n", i + 1, g.velocity[0][i], g.velocity[1][i], g.velocity[2][i],
                g.spin[0][i], g.spin[1][i], g.spin[2][i]);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 3 && std::string_view(argv[1]) == "--lammps") {
    write_lammps(argv[2]);
    return 0;
  }
  const std::pair<const char*, Isa> sets[] = {
      {"baseline", Isa::baseline}, {"avx2", Isa::avx2}, {"avx512", Isa::avx512}};
  for (const std::int64_t tiles : {3, 8, 64, 1000})
    for (const auto& [name, isa] : sets)
      for (const int threads : {1, 2}) {
        if (isa > best_isa() || (threads > 1 && isa < best_isa())) continue;
        const auto title = fmt::format("spheres/{}/{}/threads:{}", tiles * in_tile, name, threads);
        auto* bench =
            benchmark::RegisterBenchmark(title.c_str(), spheres, tiles, isa, threads, soft::Scheme::gear5);
        bench->Unit(benchmark::kMillisecond);
        if (threads > 1) bench->UseRealTime();
      }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
}
