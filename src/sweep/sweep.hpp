#pragma once
#include <filesystem>
#include <string>

#include "sweep/grid.hpp"

namespace chute::sweep {

struct SweepOptions {
  std::filesystem::path directory;
  int jobs = 1;               ///< points side by side; results do not depend on it
  int shard = 1, shards = 1;  ///< does only every `shards`-th piece of the work, from the `shard`-th on
  bool resume = false;        ///< go on in a folder that holds a part of the same sweep
  Report progress;
};

/// Does the sweep that a scene file describes in [sweep], or a shard of it. Leaves in the folder
/// `sweep.toml`, the finished points, and once all are there: `sweep.csv` (a row per place of the grid) and
/// `starts.csv` (a row per start), or `boundaries.csv`. Tells whether all are there. InputError if the folder
/// holds something else, or the same sweep without `resume` (shards share their folder).
bool run_sweep(const Base& base, const SweepOptions& options);

}  // namespace chute::sweep
