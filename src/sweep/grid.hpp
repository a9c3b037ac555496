#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "sweep/phase.hpp"
#include "sweep/point_store.hpp"
#include "sweep/sweep_spec.hpp"

namespace chute::sweep {

/// A scene file and what is changed in it: key=value. The file is read once: it may change while a sweep goes on.
struct Base {
  std::filesystem::path file;
  std::vector<std::string> set;
  std::string text;
  bool outputs = false;  ///< of runs that are kept; else all but the series are left out

  /// InputError if the file cannot be read.
  explicit Base(std::filesystem::path scene_file, std::vector<std::string> settings = {});
  /// Of a file that is read already.
  Base(std::filesystem::path scene_file, std::vector<std::string> settings, std::string content)
      : file(std::move(scene_file)), set(std::move(settings)), text(std::move(content)) {}

  /// With further changes on top.
  scene::Scene scene(const std::vector<std::string>& more) const;
  Base with(const std::vector<std::string>& more) const;
};

/// One place of the grid.
struct Place {
  std::vector<double> values;  ///< one per axis
  std::vector<std::string> set;
};
/// All combinations of the axes' values, the last axis fastest.
std::vector<Place> grid(const std::vector<Axis>& axes);

/// The starts of all seeds 1 … `seeds` of a scene, joined.
std::vector<measure::Flow> starts_of(const Base& base, std::int64_t seeds, const PointStore& store,
                                     const Report& progress);

/// What comes of a scene launched at each of several velocities (or, if there are none, as it says).
std::vector<Tally> launches_of(const Base& base, std::span<const double> velocities, std::int64_t seeds,
                               const PointStore& store, const Report& progress);

/// Phase boundaries of a scene along the parameter of `spec`.
Boundaries boundaries_of(const Base& base, const BoundarySpec& spec, Wanted wanted, std::int64_t seeds,
                         const PointStore& store, const Report& progress);

}  // namespace chute::sweep
