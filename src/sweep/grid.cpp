#include "sweep/grid.hpp"

#include <fmt/format.h>

#include "common/atomic_file.hpp"

namespace chute::sweep {

Base::Base(std::filesystem::path scene_file, std::vector<std::string> settings)
    : file(std::move(scene_file)), set(std::move(settings)), text(read_file(file)) {}

scene::Scene Base::scene(const std::vector<std::string>& more) const {
  auto settings = set;
  settings.emplace_back("sweep=");  // the grid itself is no part of a run
  settings.insert(settings.end(), more.begin(), more.end());
  auto scene = scene::parse_scene(text, file.string(), settings);
  if (!outputs) scene.drop_outputs();
  return scene;
}

Base Base::with(const std::vector<std::string>& more) const {
  Base changed = *this;
  changed.set.insert(changed.set.end(), more.begin(), more.end());
  return changed;
}

std::vector<Place> grid(const std::vector<Axis>& axes) {
  std::vector<Place> places(1);
  for (const auto& axis : axes) {
    std::vector<Place> finer;
    for (const auto& place : places)
      for (const double value : axis.points()) {
        finer.push_back(place);
        finer.back().values.push_back(value);
        finer.back().set.push_back(axis.setting(value));
      }
    places = std::move(finer);
  }
  return places;
}

std::vector<measure::Flow> starts_of(const Base& base, std::int64_t seeds, const PointStore& store,
                                     const Report& progress) {
  std::vector<measure::Flow> starts;
  for (std::int64_t seed = 1; seed <= seeds; ++seed) {
    const auto report = [&](double part) {
      return progress((static_cast<double>(seed - 1) + part) / static_cast<double>(seeds));
    };
    const auto outcome = store.get(base.scene({fmt::format("seed={}", seed)}), report);
    starts.insert(starts.end(), outcome.starts.begin(), outcome.starts.end());
  }
  return starts;
}

std::vector<Tally> launches_of(const Base& base, std::span<const double> velocities, std::int64_t seeds,
                               const PointStore& store, const Report& progress) {
  if (velocities.empty()) return {tally(starts_of(base, seeds, store, progress))};
  std::vector<Tally> tallies;
  for (const double v : velocities) {
    const auto launched = base.with({fmt::format("grains.start.velocity={}", v)});
    tallies.push_back(tally(starts_of(launched, seeds, store, [&](double part) {
      return progress((static_cast<double>(tallies.size()) + part) / static_cast<double>(velocities.size()));
    })));
  }
  return tallies;
}

Boundaries boundaries_of(const Base& base, const BoundarySpec& spec, Wanted wanted, std::int64_t seeds,
                         const PointStore& store, const Report& progress) {
  // How many points the bisection will need is not known: each one takes a part of what is left of the bar.
  double done = 0;
  const auto phase_at = [&](double value) {
    const auto tallies = launches_of(base.with({spec.axis.setting(value)}), spec.velocities, seeds, store,
                                     [&](double) { return progress(done); });
    done += (1 - done) / 20;
    return phase_of(tallies, spec.alike);
  };
  return find_boundaries(spec.axis.points(), spec.tolerance, wanted, phase_at);
}

}  // namespace chute::sweep
