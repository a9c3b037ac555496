#include "sweep/grid.hpp"

#include <fmt/format.h>

namespace chute::sweep {

scene::Scene Base::scene(const std::vector<std::string>& more) const {
  auto settings = set;
  settings.push_back("sweep=");  // the grid itself is no part of a run
  settings.insert(settings.end(), more.begin(), more.end());
  auto scene = scene::read_scene(file, settings);
  scene.output.frames.reset();
  scene.output.impacts.reset();
  scene.output.contacts = false;
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

Boundaries boundaries_of(const Base& base, const BoundarySpec& spec, std::int64_t seeds, const PointStore& store,
                         const Report& progress, bool quick) {
  std::vector<std::vector<std::string>> launches{{}};
  if (!spec.velocities.empty()) {
    launches.clear();
    for (const double v : spec.velocities) launches.push_back({fmt::format("grains.start.velocity={}", v)});
  }
  // How many points the bisection will need is not known; each one halves what is left of the bar.
  double done = 0;
  const auto phase_at = [&](double value) {
    std::vector<Tally> tallies;
    for (const auto& launch : launches) {
      auto changed = base.with({spec.axis.setting(value)}).with(launch);
      tallies.push_back(tally(starts_of(changed, seeds, store, [&](double) { return progress(done); })));
    }
    done += (1 - done) / 20;
    return phase_of(tallies, spec.alike);
  };
  return find_boundaries(spec.axis.points(quick), spec.tolerance, phase_at);
}

}  // namespace chute::sweep
