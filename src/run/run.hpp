#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "measure/account.hpp"
#include "measure/steadiness.hpp"
#include "run/run_directory.hpp"
#include "scene/scene.hpp"

namespace chute::run {

struct RunOptions {
  std::filesystem::path directory;
  Existing existing = Existing::refuse;
  int threads = 1;
  double checkpoint_seconds = 300;  ///< of the clock on the wall, between checkpoints at most; 0: any time
  std::string command_line;         ///< for run.json
  /// How to go on once a failure, such as a full disk, is mended: ends its message where a checkpoint stands. Empty: nothing.
  std::string way_on;
  /// Called now and then with the part done, 0 to 1. Returning false stops the run after a checkpoint.
  std::function<bool(double part)> progress;
  /// Told what the user should know, though the run goes on.
  std::function<void(const std::string&)> warn;
};

struct RunResult {
  bool finished;       ///< false: stopped by `progress`; resume to go on
  std::int64_t steps;  ///< done by this call
  std::size_t grains;  ///< that move
  double seconds;      ///< wall time of this call
  std::optional<measure::AccountVerdict> account{};
  std::vector<measure::Flow> starts{};  ///< what became of it, or of each grain that does not feel the others
};

/// Runs a scene into a run directory, or goes on with one: the same scene, seed and build give the same
/// bytes, interrupted or not. Leaves the folder with a checkpoint and run.json telling how it ended if the
/// run leaves physics (WorkError).
RunResult run_scene(const scene::Scene& scene, const RunOptions& options);

/// The resolved scene of a finished run, if the directory holds one that finished; for reusing runs.
bool is_finished_run_of(const std::filesystem::path& directory, const scene::Scene& scene);

}  // namespace chute::run
