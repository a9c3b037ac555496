#pragma once
#include "experiments/experiment.hpp"
#include "run/run.hpp"

namespace chute::experiments {

/// What an experiment gave.
struct Outcome {
  std::vector<Fact> results;
  std::int64_t steps = 0;
  double time = 0;
  // only if recorded:
  std::vector<std::string> columns;
  std::vector<std::vector<double>> series;
  std::vector<double> frame_times;
  std::vector<std::string> frames;  ///< bytes of VTK files

  /// InputError, with the nearest name, if there is no such result.
  double operator[](const std::string& name) const;
};

/// Does the experiment. WorkError if grains do not part. `record` keeps the series, and the frames if asked
/// for.
Outcome perform(const Experiment& experiment, bool record = false);

/// Does it and writes a run directory: scene.toml, run.json, series.csv, result.csv, and frames if asked for.
Outcome run_experiment(const Experiment& experiment, const run::RunOptions& options);

}  // namespace chute::experiments
