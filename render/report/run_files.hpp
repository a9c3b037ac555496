#pragma once
#include <toml++/toml.h>

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "read/table.hpp"

namespace chute::report {

/// A mean with its standard error, as run.json has it; absent where not known.
struct Mean {
  std::optional<double> value, error;
};

/// What became of the flow (src/measure/steadiness.hpp says what the verdicts mean).
struct FlowVerdict {
  std::string verdict;
  double from = 0;  ///< the means count from this time on
  Mean v_x, omega, kinetic;
};

/// What run.json tells.
struct Record {
  std::string version, commit, command, machine, started, clock = "time", end, why;
  std::int64_t seed = 0, steps = 0, threads = 1;
  double seconds = 0, time = 0, time_step = 0;
  std::optional<FlowVerdict> flow;
};

/// A run directory as a report reads it: what made it, what it is, and its tables.
struct RunFiles {
  std::filesystem::path path;
  std::string name;  ///< its folder's, told apart from the others of one page
  std::string title, units, scene_text;
  int dimensions = 2;
  toml::table scene;
  Record record;

  bool is_experiment() const { return scene.contains("experiment"); }
  bool has(const std::string& file) const;
  /// The table of that name, if the run has it and it has rows. InputError if it is damaged.
  std::optional<read::Table> table(const std::string& file) const;
};

/// Reads run.json and scene.toml. InputError, one line that names the file, if the folder is no run or one of them is damaged.
RunFiles read_run(const std::filesystem::path& directory);

/// Several for one page: names that are the same get their parent folder's beside. InputError if they count in different units.
std::vector<RunFiles> read_runs(std::span<const std::string> directories);

}  // namespace chute::report
