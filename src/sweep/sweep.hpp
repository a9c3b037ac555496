#pragma once
#include <array>
#include <filesystem>
#include <string>

#include "sweep/grid.hpp"

namespace chute::sweep {

struct SweepOptions {
  std::filesystem::path directory;
  int jobs = 1;               ///< points side by side; results do not depend on it
  int shard = 1, shards = 1;  ///< does only every `shards`-th piece of the work, from the `shard`-th on
  bool resume =
      false;  ///< go on in a folder that holds a part of the same sweep, or of one whose [sweep] was smaller
  bool keep_runs =
      false;  ///< every place and seed is a run directory in runs/, with all outputs of the scene
  std::string command_line{};  ///< for the run.json of runs that are kept
  Report progress;
};

/// Does the sweep that a scene file describes in [sweep], or a shard of it. Leaves in the folder
/// `sweep.toml`, the finished points, and once all are there: `sweep.csv` (a row per place of the grid) and
/// `starts.csv` (a row per start), or `boundaries.csv`. Tells whether all are there. InputError if the folder
/// holds something else, or the same sweep without `resume` (shards share their folder).
bool run_sweep(const Base& base, const SweepOptions& options);

/// How far the sweep in a folder is.
struct SweepState {
  std::string title;
  SweepSpec spec;
  std::size_t points = 0, found = 0;    ///< that it has, without boundaries, and that are there of this build
  std::size_t files = 0;                ///< finished points in the folder, of any grid and build
  bool table = false;                   ///< are its tables there?
  std::array<std::size_t, 5> starts{};  ///< by verdict
};
/// InputError if the folder holds no sweep.
SweepState sweep_state(const std::filesystem::path& directory);

/// The setting that puts more values on the axes of a sweep, each `KEY=VALUE,VALUE`; a key without an axis becomes one.
/// InputError if one is not of that form.
std::string with_more_values(const Base& base, const std::vector<std::string>& more);

}  // namespace chute::sweep
